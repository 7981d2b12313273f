#include "opencl/target.h"

#include <algorithm>
#include <string>

namespace rpf {
namespace {

/// LLVM's names of processors with AVX-512, the first of which is all of them to Debian's PoCL.
constexpr const char* with_avx512[] = {"skylake-avx512", "x86-64-v4",     "icelake",       "tigerlake", "rocketlake",
                                       "sapphirerapids", "emeraldrapids", "graniterapids", "znver4",    "znver5"};
/// The same of those with AVX2 and no more.
constexpr const char* with_avx2[] = {"haswell",   "broadwell", "skylake", "alderlake",
                                     "x86-64-v3", "znver1",    "znver2",  "znver3"};

/// PoCL says what it compiles for: "OpenCL 3.0 PoCL HSTR: pthread-x86_64-pc-linux-gnu-haswell".
template <std::size_t Count>
bool compiles_for(const cl::Device& device, const char* const (&names)[Count]) {
  const auto version = device.getInfo<CL_DEVICE_VERSION>();
  return std::any_of(std::begin(names), std::end(names),
                     [&](const char* name) { return version.find(name) != std::string::npos; });
}

}  // namespace

bool is_pocl(const cl::Device& device) { return device.getInfo<CL_DEVICE_VERSION>().find("PoCL") != std::string::npos; }

bool has_avx2(const cl::Device& device) {
#ifdef __x86_64__
  return is_pocl(device) && (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0 &&
         (compiles_for(device, with_avx2) || compiles_for(device, with_avx512)) && __builtin_cpu_supports("avx2");
#else
  static_cast<void>(device);
  return false;
#endif
}

bool has_new_avx512(const cl::Device& device) {
#ifdef __x86_64__
  return has_avx2(device) && compiles_for(device, with_avx512) && __builtin_cpu_supports("avx512vpopcntdq") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
#else
  static_cast<void>(device);
  return false;
#endif
}

int floats_a_register(const cl::Device& device) {
  constexpr int of_avx2 = 8;
  const auto native = static_cast<int>(device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());  // PoCL: the processor's
  return is_pocl(device) && !compiles_for(device, with_avx512) ? std::min(native, of_avx2) : native;
}

}  // namespace rpf
