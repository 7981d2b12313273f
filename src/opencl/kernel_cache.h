// Where compiled kernels are kept between runs.
#pragma once

namespace rpf {

/// Gives PoCL a cache folder that works: a folder `pocl` below RPF_CACHE_DIR, XDG_CACHE_HOME/rpf or HOME/.cache/rpf, or
/// where none of these can be written a private one that is removed at the end of the process. Removes damaged kernels
/// in it, which would abort the process. Does nothing where POCL_CACHE_DIR is set or after the first call. Call it
/// before any OpenCL function.
void prepare_kernel_cache();

}  // namespace rpf
