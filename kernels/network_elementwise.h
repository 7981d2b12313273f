// Formulas of the learned estimator (docs/network.md) that hold value by value. rpf_network.h includes this text once
// for every type, as numeric.h does with elementwise.h. Hence no include guard.
// NOLINTBEGIN(modernize-*, bugprone-macro-parentheses): this is OpenCL C too

// x held in [low, high]; NaN becomes low. Whatever a network computes is finite after it.
RPF_INLINE RPF_REAL rpf_held(RPF_REAL x, float low, float high) {
  const RPF_REAL above = x > low ? x : low;
  return above < high ? above : high;
}

// ln x of a normal x above 0, within 1e-7 of max(|ln x|, 1/4). x = 2^n m with m in [1/sqrt 2, sqrt 2); polynomial in
// m - 1 (the coefficients of Cephes' logf, S. Moshier); ln 2 in two parts.
RPF_INLINE RPF_REAL rpf_log(RPF_REAL x) {
  const RPF_INT bits = RPF_AS_INT(x);
  const RPF_INT n = (bits - 0x3f3504f3) >> 23;
  const RPF_REAL f = RPF_AS_REAL(bits - n * (1 << 23)) - 1.0f;
  const RPF_REAL exponent = RPF_TO_REAL(n);
  const RPF_REAL square = f * f;
  RPF_REAL p = 7.0376836292e-2f;
  p = p * f - 1.1514610310e-1f;
  p = p * f + 1.1676998740e-1f;
  p = p * f - 1.2420140846e-1f;
  p = p * f + 1.4249322787e-1f;
  p = p * f - 1.6668057665e-1f;
  p = p * f + 2.0000714765e-1f;
  p = p * f - 2.4999993993e-1f;
  p = p * f + 3.3333331174e-1f;
  p = p * f * square;
  p = p + exponent * -2.12194440e-4f;
  p = p - 0.5f * square;
  return (f + p) + exponent * 0.693359375f;
}

// ---- what the network sees ------------------------------------------------------------------------------------------

// c: radiance in the frame's exposure. `exposure` is a power of two; the bound keeps squares and sums of c finite.
RPF_INLINE RPF_REAL rpf_seen_color(RPF_REAL radiance, float exposure) {
  return rpf_held(radiance * exposure, -1.0995116e12f, 1.0995116e12f);  // 2^40
}

// Inputs 0-2, and statistics 0-2 of the mean.
RPF_INLINE RPF_REAL rpf_brightness(RPF_REAL c) {
  return 0.5f * rpf_log(1.0f + 4.0f * rpf_held(c, 0.0f, 1.0995116e12f));
}

// Inputs 3-5. `base`: a of docs/network.md.
RPF_INLINE RPF_REAL rpf_brightness_over(RPF_REAL c, RPF_REAL base) {
  return 0.5f * rpf_log(1.0f + 2.0f * rpf_held(c, 0.0f, 1.0995116e12f) / base);
}

// a: what radiance is divided by. `albedo` in [0, 1], `miss`: input 15.
RPF_INLINE RPF_REAL rpf_albedo_base(RPF_REAL albedo, RPF_REAL miss) { return miss > 0.0f ? 1.0f : albedo + 0.05f; }

RPF_INLINE RPF_REAL rpf_luminance(RPF_REAL r, RPF_REAL g, RPF_REAL b) { return (r + g + b) / 3.0f; }

// ---- moments of a pixel's samples -----------------------------------------------------------------------------------

// d = value - first value of the pixel: the sums of d and of d^2 come before. `share`: 1 / n, rounded; a division takes
// as long as twenty products.
RPF_INLINE RPF_REAL rpf_shifted_mean(RPF_REAL first, RPF_REAL sum, float share) { return first + sum * share; }

RPF_INLINE RPF_REAL rpf_shifted_variance(RPF_REAL sum, RPF_REAL squares, float share) {
  const RPF_REAL mean = sum * share;
  const RPF_REAL variance = squares * share - mean * mean;
  return variance > 0.0f ? variance : 0.0f;
}

// The second S values of a pixel.
RPF_INLINE RPF_REAL rpf_feature_deviation(RPF_REAL variance) { return sqrt(variance + 1e-4f); }

// Statistic 3: q / (1 + q), q = standard error of the luminance over its mean.
RPF_INLINE RPF_REAL rpf_relative_error(RPF_REAL variance, RPF_REAL mean, RPF_REAL samples) {
  const RPF_REAL q = sqrt(variance / samples) / (rpf_held(mean, 0.0f, 1.0995116e12f) + 0.02f);
  return q / (1.0f + q);
}

// ---- layers and weights ---------------------------------------------------------------------------------------------

RPF_INLINE RPF_REAL rpf_leaky(RPF_REAL x) { return x > 0.0f ? x : 0.1f * x; }

// Of a sample, less the file's own weight.
RPF_INLINE RPF_REAL rpf_learned_weight(RPF_REAL logit) { return rpf_exp(rpf_held(logit, -8.0f, 8.0f)); }

// w_ii of a pass.
RPF_INLINE RPF_REAL rpf_own_weight(RPF_REAL logit) { return rpf_exp(rpf_held(logit, -8.0f, 8.0f)); }

// e_ik, k < E; and for the others the factor of a feature's mean.
RPF_INLINE RPF_REAL rpf_embedding(RPF_REAL x) { return rpf_held(x, -1000.0f, 1000.0f); }
RPF_INLINE RPF_REAL rpf_bandwidth(RPF_REAL logit) { return rpf_exp(rpf_held(logit, -6.0f, 6.0f)); }

// b: the share of the ratio in the result.
RPF_INLINE RPF_REAL rpf_blend(RPF_REAL logit) { return 1.0f / (1.0f + rpf_exp(-rpf_held(logit, -20.0f, 20.0f))); }

// What is carried, over the weight that it was summed with; nothing where there is hardly any weight: below, sums are
// no longer exact. (The largest weight of a file is brought to [1, 2).)
#define RPF_LEAST_WEIGHT 8.271806e-25f  // 2^-80
RPF_INLINE RPF_REAL rpf_over_weight(RPF_REAL sum, RPF_REAL weight) {
  return weight >= RPF_LEAST_WEIGHT ? sum / weight : 0.0f;
}

// A channel of the color with albedo: `sum` and `base_sum` after the passes, `plain` the sum over the weight, `albedo`
// and `covered` after the passes of the albedo. Without any albedo nearby: plain.
RPF_INLINE RPF_REAL rpf_blended(RPF_REAL plain, RPF_REAL sum, RPF_REAL base_sum, RPF_REAL albedo, RPF_REAL covered,
                                RPF_REAL blend) {
  const RPF_INT known = (base_sum >= RPF_LEAST_WEIGHT) & (covered >= RPF_LEAST_WEIGHT);
  const RPF_REAL ratio = sum / base_sum * (albedo / covered);
  return known ? fma(blend, ratio - plain, plain) : plain;
}

// NOLINTEND(modernize-*, bugprone-macro-parentheses)
