// The numeric contract: what every backend computes with, in the common subset of C++17 and OpenCL C 1.2.
// (Two things more are asked of the OpenCL compiler, which every compiler that is built on clang has: overloads, and
// __builtin_shufflevector.)
//
// The same text is compiled by the host compiler and by the OpenCL compiler, and the results are equal bit for bit:
//  1. float, int and uint; values and private pointers only.
//  2. + - * / sqrt, comparisons and integer operations; the only transcendental is rpf_exp below.
//     Logarithms and Gaussians are tables that the host builds (src/plan/tables.h).
//  3. No contraction: a * b + c is two roundings. The pragma below and -ffp-contract=off see to it, a test proves it.
//  4. A sum over samples has one shape: RPF_LANES interleaved partial sums, combined by the tree in rpf_lanes_total.
//     A 16-wide vector register and a scalar loop give the same bits. Weighted sums are taken in stretches of
//     RPF_STRETCH elements a lane, which are added to a total: thousands of equal weights would all be rounded the same
//     way, and the error would grow with their number.
#ifndef RPF_NUMERIC_H
#define RPF_NUMERIC_H
// NOLINTBEGIN(modernize-*, bugprone-macro-parentheses): this is OpenCL C too

#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#include <cstring>
// The names of OpenCL C that C++ lacks. fabs and sqrt have float overloads in <cmath>.
#define RPF_INLINE inline
namespace rpf::kernel {
using std::fabs;
using std::sqrt;
using uint = std::uint32_t;
inline float as_float(int bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}
inline uint mul_hi(uint a, uint b) { return static_cast<uint>((std::uint64_t{a} * b) >> 32); }
#else
#pragma OPENCL FP_CONTRACT OFF
#define RPF_INLINE static inline __attribute__((overloadable))
#endif

#define RPF_LANES 16
#define RPF_STRETCH 32

// ---- formulas for one value, and for RPF_LANES values at once -------------------------------------------------------

#define RPF_REAL float
#define RPF_INT int
#define RPF_UINT uint
#define RPF_SUMS rpf_lanes
#define RPF_WORDS rpf_words
#define RPF_TO_INT(x) ((int)(x))
#define RPF_TO_REAL(x) ((float)(x))
#define RPF_AS_REAL(x) as_float(x)
#include "elementwise.h"

#ifndef __cplusplus  // the reference is scalar
#undef RPF_REAL
#undef RPF_INT
#undef RPF_UINT
#undef RPF_SUMS
#undef RPF_WORDS
#undef RPF_TO_INT
#undef RPF_TO_REAL
#undef RPF_AS_REAL
#define RPF_REAL float16
#define RPF_INT int16
#define RPF_UINT uint16
#define RPF_SUMS rpf_lanes16
#define RPF_WORDS rpf_words16
#define RPF_TO_INT(x) convert_int16(x)
#define RPF_TO_REAL(x) convert_float16(x)
#define RPF_AS_REAL(x) as_float16(x)
#include "elementwise.h"
#endif

// sum + value as a link of a sum in a loop. The same number, but compilers leave it in its place: Intel's takes the
// additions of such a loop in another order, whatever it is told.
RPF_INLINE float rpf_added(float sum, float value) {
#ifdef __cplusplus
  return sum + value;
#else
  return fma(value, 1.0f, sum);
#endif
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, bugprone-macro-parentheses)
#endif
