// The numeric contract: what every backend computes with, in the common subset of C++17 and OpenCL C 1.2.
//
// The same text is compiled by the host compiler and by the OpenCL compiler, and the results are equal bit for bit:
//  1. float, int and uint; values and private pointers only.
//  2. + - * / sqrt, comparisons and integer operations; the only transcendental is rpf_exp below.
//     Logarithms and Gaussians are tables that the host builds (src/tables.h).
//  3. No contraction: a * b + c is two roundings. The pragma below and -ffp-contract=off see to it, a test proves it.
//  4. A sum over samples has one shape: RPF_LANES interleaved partial sums, combined by the tree in rpf_lanes_total.
//     A 16-wide vector register and a scalar loop give the same bits.
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
#define RPF_INLINE static inline
#endif

// ---- missing values -------------------------------------------------------------------------------------------------

// A missing feature or random parameter is a NaN; no other NaN enters the filter.
RPF_INLINE int rpf_is_missing(float x) { return x != x; }

// ---- exponential ----------------------------------------------------------------------------------------------------

#define RPF_EXP_UNDERFLOW -87.0f  // below: 0. exp(-87) is 1.6e-38, just above the smallest normal float.

// exp(x) for x <= 0, 0 below RPF_EXP_UNDERFLOW (so the result is never subnormal), within 1 ULP; rpf_exp(0) is
// exactly 1. x = n ln 2 + r with |r| <= ln 2 / 2; ln 2 in two parts so that n * hi is exact; Taylor-like minimax
// polynomial in r (the coefficients of Cephes' expf, S. Moshier).
RPF_INLINE float rpf_exp(float x) {
  const int representable = x >= RPF_EXP_UNDERFLOW;
  const float y = representable ? x : RPF_EXP_UNDERFLOW;
  const float shifted = y * 1.44269504f + 12582912.0f;  // 1.5 * 2^23: the sum's last bit has the value 1
  const float n = shifted - 12582912.0f;
  const float r = (y - n * 0.693359375f) - n * -2.12194440e-4f;
  float p = 1.9875691500e-4f;
  p = p * r + 1.3981999507e-3f;
  p = p * r + 8.3334519073e-3f;
  p = p * r + 4.1665795894e-2f;
  p = p * r + 1.6666665459e-1f;
  p = p * r + 5.0000001201e-1f;
  p = p * (r * r) + r;
  const float result = (p + 1.0f) * as_float(((int)n + 127) << 23);
  return representable ? result : 0.0f;
}

// ---- sums -----------------------------------------------------------------------------------------------------------

#define RPF_LANES 16

// Partial sums of a sequence: element j belongs to lane j mod RPF_LANES. Start with all lanes 0.
typedef struct {
  float lane[RPF_LANES];
} rpf_lanes;

RPF_INLINE void rpf_lanes_clear(rpf_lanes* sum) {
  for (int l = 0; l < RPF_LANES; ++l) sum->lane[l] = 0.0f;
}

RPF_INLINE void rpf_lanes_add(rpf_lanes* sum, uint j, float value) { sum->lane[j % RPF_LANES] += value; }

// The fixed tree: halves are added until one is left, lane l with lane l + width.
RPF_INLINE float rpf_lanes_total(const rpf_lanes* sum) {
  float lane[RPF_LANES];
  for (int l = 0; l < RPF_LANES; ++l) lane[l] = sum->lane[l];
  for (int width = RPF_LANES / 2; width > 0; width /= 2)
    for (int l = 0; l < width; ++l) lane[l] += lane[l + width];
  return lane[0];
}

// ---- random numbers -------------------------------------------------------------------------------------------------

// Three independent 32-bit words.
typedef struct {
  uint x, y, z;
} rpf_words;

// pcg3d: a counter-based generator, three words in, three out (Jarzynski and Olano, "Hash Functions for GPU Rendering",
// JCGT 9(3), 2020). No state: the draws do not depend on the order in which pixels are visited.
RPF_INLINE rpf_words rpf_hash(uint x, uint y, uint z) {
  x = x * 1664525u + 1013904223u;
  y = y * 1664525u + 1013904223u;
  z = z * 1664525u + 1013904223u;
  x += y * z;
  y += z * x;
  z += x * y;
  x ^= x >> 16;
  y ^= y >> 16;
  z ^= z >> 16;
  x += y * z;
  y += z * x;
  z += x * y;
  rpf_words words;
  words.x = x;
  words.y = y;
  words.z = z;
  return words;
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, bugprone-macro-parentheses)
#endif
