// Where the values of a pixel's trace stand in one array of floats: written by filter.cl, read by src/opencl.
#ifndef RPF_TRACE_LAYOUT_H
#define RPF_TRACE_LAYOUT_H
// NOLINTBEGIN(modernize-*): this is OpenCL C too

#include "numeric.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

// Index of the first value.
typedef struct {
  uint shift;                                            // [variables], padded to whole RPF_LANES
  uint own_mean, own_deviation, tolerance;               // [features], likewise
  uint mean, inverse_deviation;                          // [variables]
  uint information;                                      // [pairs]
  uint color_weights;                                    // W_c,i^r (3), W_c^r, alpha (3)
  uint feature_fraction_random, fraction_feature, beta;  // [features]
  uint filtered;                                         // [own][carried], before the outlier step
  uint weights;                                          // [own][N], and behind them [N][variables] normalized values
} rpf_trace_layout;

RPF_INLINE uint rpf_pairs(uint random, uint features) { return 3 * (2 + random + features) + features * (2 + random); }

RPF_INLINE rpf_trace_layout rpf_lay_out_trace(uint random, uint features, uint carried, uint own) {
  const uint variables = 5 + random + features;
  const uint padded_features = (features + RPF_LANES - 1) / RPF_LANES * RPF_LANES;
  rpf_trace_layout at;
  at.shift = 0;
  at.own_mean = at.shift + (variables + RPF_LANES - 1) / RPF_LANES * RPF_LANES;
  at.own_deviation = at.own_mean + padded_features;
  at.tolerance = at.own_deviation + padded_features;
  at.mean = at.tolerance + padded_features;
  at.inverse_deviation = at.mean + variables;
  at.information = at.inverse_deviation + variables;
  at.color_weights = at.information + rpf_pairs(random, features);
  at.feature_fraction_random = at.color_weights + 7;
  at.fraction_feature = at.feature_fraction_random + features;
  at.beta = at.fraction_feature + features;
  at.filtered = at.beta + features;
  at.weights = at.filtered + own * carried;
  return at;
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*)
#endif
