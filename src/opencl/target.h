// Which processor a device compiles for.
#pragma once

#include "opencl/opencl.h"

namespace rpf {

bool is_pocl(const cl::Device& device);

/// Whether this is PoCL that compiles for AVX2 at least.
bool has_avx2(const cl::Device& device);

/// Whether this is PoCL that compiles for an AVX-512 that counts bits in vectors; target.cl says what for. Not every
/// PoCL on such a processor does: POCL_KERNELLIB_NAME=avx2 has Debian's take the code of older ones.
bool has_new_avx512(const cl::Device& device);

/// Floats in a register of what the device compiles for.
int floats_a_register(const cl::Device& device);

}  // namespace rpf
