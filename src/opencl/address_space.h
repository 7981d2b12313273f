// PoCL aborts or hangs where memory cannot be mapped, so `ulimit -v` is asked first.
#pragma once

namespace rpf {

/// Throws Error(device) where a limited address space leaves too little for an OpenCL driver with a compiler in it to
/// start and to compile: PoCL takes 450 MB and a stack for each core, then its compiler up to 400 MB.
void check_address_space_to_start();
/// The same for compiling a kernel, with the driver running.
void check_address_space_to_compile();

}  // namespace rpf
