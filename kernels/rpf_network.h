// The learned estimator (docs/network.md): its numbers, and its formulas, for every backend. numeric.h is the contract,
// with one addition: a sum of products is a chain of fma(), each rounded once, in the order that docs/network.md gives.
#ifndef RPF_NETWORK_H
#define RPF_NETWORK_H
// NOLINTBEGIN(modernize-*, bugprone-macro-parentheses): this is OpenCL C too

#include "numeric.h"

#ifdef __cplusplus
namespace rpf::kernel {
using std::fma;
inline int as_int(float value) {
  int bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
#endif

#undef RPF_REAL
#undef RPF_INT
#undef RPF_TO_REAL
#undef RPF_AS_REAL
#define RPF_REAL float
#define RPF_INT int
#define RPF_TO_REAL(x) ((float)(x))
#define RPF_AS_REAL(x) as_float(x)
#define RPF_AS_INT(x) as_int(x)
#include "network_elementwise.h"

#ifndef __cplusplus  // the reference is scalar
#undef RPF_REAL
#undef RPF_INT
#undef RPF_TO_REAL
#undef RPF_AS_REAL
#undef RPF_AS_INT
#define RPF_REAL float16
#define RPF_INT int16
#define RPF_TO_REAL(x) convert_float16(x)
#define RPF_AS_REAL(x) as_float16(x)
#define RPF_AS_INT(x) as_int16(x)
#include "network_elementwise.h"
#endif

// ---- inputs of a sample ---------------------------------------------------------------------------------------------

#define RPF_INPUTS 30
#define RPF_INPUT_BRIGHTNESS 0       // 3
#define RPF_INPUT_BRIGHTNESS_OVER 3  // 3: over a
#define RPF_INPUT_NORMAL 6           // 3. From here on inputs are columns of the frame's records, or 0
#define RPF_INPUT_ALBEDO 9           // 3
#define RPF_INPUT_POSITION 12        // 3
#define RPF_INPUT_MISS 15            // 1
#define RPF_INPUT_NORMAL2 16         // 3
#define RPF_INPUT_DISTANCE2 19       // 1
#define RPF_INPUT_HIT2 20            // 1
#define RPF_INPUT_LENS 21            // 2
#define RPF_INPUT_TIME 23            // 1
#define RPF_INPUT_FILM 24            // 2
#define RPF_INPUT_LIGHT 26           // 2
#define RPF_INPUT_BSDF 28            // 2

// Means of so many inputs, from RPF_INPUT_NORMAL on, guide the passes: normal, albedo, position, miss.
#define RPF_GUIDES 10

// ---- a pixel: S means, S deviations, statistics ---------------------------------------------------------------------

#define RPF_STATISTICS 18
#define RPF_STATISTIC_BRIGHTNESS 0  // 3
#define RPF_STATISTIC_ERROR 3       // 1
#define RPF_STATISTIC_GUIDES 4      // RPF_GUIDES means
#define RPF_STATISTIC_SPREADS 14    // 3: of normal, albedo, position
#define RPF_STATISTIC_SAMPLES 17    // 1: 1 / sqrt(n)

RPF_INLINE uint rpf_pixel_values(uint sample_features) { return 2 * sample_features + RPF_STATISTICS; }

// ---- head -----------------------------------------------------------------------------------------------------------

#define RPF_CONTEXT 8           // values from 0 on
#define RPF_HEAD_BLEND 8        // 1
#define RPF_PASS_REACH 2        // 5 x 5 taps, in dilations
#define RPF_WEIGHT_FEATURES 16  // outputs of weight1

// Where a pass stands in the head: E embedding values, the log own weight, RPF_GUIDES log bandwidths. Behind the last
// one ends the head.
RPF_INLINE uint rpf_head_pass(uint pass, uint embedding) {
  return RPF_HEAD_BLEND + 1 + pass * (embedding + 1 + RPF_GUIDES);
}

// ---- sums of a pixel ------------------------------------------------------------------------------------------------

#define RPF_SUM_RADIANCE 0  // 3
#define RPF_SUM_BASE 3      // 3: of a
#define RPF_SUM_WEIGHT 6    // 1
#define RPF_SUM_OTHERS 7    // of the carried values from the fourth on
RPF_INLINE uint rpf_sums(uint carried) { return RPF_SUM_OTHERS + carried - 3; }

// The albedo's own: 3 means of a, and 1 where there are samples.
#define RPF_ALBEDO_SUMS 4

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, bugprone-macro-parentheses)
#endif
