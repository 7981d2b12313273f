// Drivers are asked in a child process before they are used here: one that aborts, hangs or crashes ends that child.
#pragma once

#include <string>

#include "opencl/child.h"

namespace rpf {

/// Whether the drivers can be loaded and list their devices; never remembered. Throws Error(device) where not.
void probe_drivers();

/// The self-test of a device, computed in a child; never remembered. Empty where it passes, and then what failed before
/// is asked again by the next run; else the first disagreement. Throws Error(device).
std::string probe_device(int index);

/// Whether the device that an index or a part of a name stands for works, remembered. Throws Error(device) where not,
/// and what find_device() throws.
void require_working_device(const std::string& wanted);

/// What a child is to compile, and all that decides what becomes of it.
struct KernelBuild {
  int device = 0;
  std::string file, definitions, more;  ///< as Session::program() takes them
  std::string source;
  bool is_kept_by_driver = false;  ///< PoCL: in kernel_cache.h; else in binaries.h
};

/// Compiles a program and runs each of its kernels with nothing to do, in a child, where that is not known to work.
/// Throws Error(device) where it does not.
void require_compiled(const KernelBuild& build, const Check& check);

/// The answer of rpf_probe (src/probe) to a question of the above; runs the driver in this process.
std::string answer_probe(const std::vector<std::string>& question);

}  // namespace rpf
