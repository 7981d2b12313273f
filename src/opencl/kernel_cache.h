// Where compiled kernels are kept between runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rpf {

/// Gives PoCL a cache folder that works: a folder `pocl` below RPF_CACHE_DIR, XDG_CACHE_HOME/rpf or HOME/.cache/rpf, or
/// where none of these can be written a private one that is removed at the end of the process. Does nothing where
/// POCL_CACHE_DIR is set or after the first call. Call it before any OpenCL function.
void prepare_kernel_cache();

/// The folder that prepare_kernel_cache() chose; empty where POCL_CACHE_DIR was set.
std::filesystem::path kernel_cache_folder();

/// The environment for a child that is to choose the same folder in the same way.
std::vector<std::string> environment_with_our_cache();

/// Where what is known of drivers is kept, and binaries.h those of drivers other than PoCL; empty for nowhere.
std::filesystem::path verdict_folder();
std::filesystem::path binary_folder();

/// Removes damaged kernels, which would abort the process: those of this source, or all where the cache does not know
/// the source yet. `source` is all that decides what is compiled. Call it before a program is built.
void check_kernels(const std::string& source);

/// Records what was compiled from this source, so that later damage is noticed. Call it after each of its kernels ran
/// for the first time.
void keep_compiled_kernels(const std::string& source);

/// Whether what was compiled from this source is there; true where PoCL's cache is not ours.
bool has_compiled_kernels(const std::string& source);

/// Removes the oldest programs of all drivers where there are too many. Call it after something was added.
void prune_programs();

}  // namespace rpf
