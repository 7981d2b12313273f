// The formulas of Random Parameter Filtering, one function each, for every backend (numeric.h is the contract; those
// that hold value by value stand in elementwise.h).
// "section n" and "(T n)" are the sections and equation numbers of docs/algorithm.md; T is Van Campenhout's thesis.
#ifndef RPF_MATH_H
#define RPF_MATH_H
// NOLINTBEGIN(modernize-*): this is OpenCL C too

#include "numeric.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

#define RPF_EPSILON 1e-10f  // of (T 5.4) to (T 5.6)
#define RPF_OUTLIER_THRESHOLD \
  1.00001f  // section 7: 1 standard deviation; the excess keeps equality from flipping by rounding

// ---- section 3: neighborhood ----------------------------------------------------------------------------------------

// The key of a pixel's draws in one pass. Every pass and every seed draws anew.
RPF_INLINE rpf_words rpf_draw_key(uint seed, uint pass, uint pixel) { return rpf_hash(seed, pass, pixel); }

// A uniform choice among `count` samples.
RPF_INLINE uint rpf_choose(uint word, uint count) { return mul_hi(word, count); }

// Candidates are drawn in portions of so many.
#define RPF_DRAWN_AT_ONCE 256u

// ---- section 5: mutual information ----------------------------------------------------------------------------------

// Vectors of RPF_LANES neighbors that hold them all.
RPF_INLINE uint rpf_blocks(uint neighbors) { return (neighbors + RPF_LANES - 1) / RPF_LANES; }

// Words of a bit plane with one bit a neighbor (statistics.cl has the layout).
#define RPF_WORD_BITS 64u
RPF_INLINE uint rpf_plane_words(uint neighbors) { return (neighbors + RPF_WORD_BITS - 1) / RPF_WORD_BITS; }

// Bits of a word that hold one neighbor's bin while planes are made: 32 / that many neighbors come from one word, and
// neighbor i of word k goes to bit rpf_bin_field(bins) * i + k of its half of a plane's word.
RPF_INLINE uint rpf_bin_field(uint bins) { return bins > 15 ? 8 : 4; }
RPF_INLINE uint rpf_plane_bit(uint neighbor, uint bins) {
  const uint field = rpf_bin_field(bins), in_half = neighbor % 32;
  return neighbor % RPF_WORD_BITS / 32 * 32 + field * (in_half % (32 / field)) + in_half / (32 / field);
}

// Bins are counted together in vectors of so many; the last vector may have bins that no value falls into.
#define RPF_BINS_AT_ONCE 8
RPF_INLINE uint rpf_bin_vectors(uint bins) { return (bins + RPF_BINS_AT_ONCE - 1) / RPF_BINS_AT_ONCE; }

// Bin of a normalized value, 0 .. 2K.
RPF_INLINE int rpf_bin(float normalized, int half_bins) { return rpf_signed_bin(normalized, half_bins) + half_bins; }

// I(X,Y) in nats from units = S * (sum h_xy log2 h_xy - sum h_x log2 h_x - sum h_y log2 h_y + N log2 N), an integer sum
// over the table of src/plan/tables.h. Every entry is off by at most half a unit, so a sum of `slack` units or less is
// indistinguishable from 0 and counts as 0: exactly independent variables have no mutual information.
// `nats_per_unit` = ln 2 / S; `bias`: what is subtracted times 1/N (0, or (B-1)^2 / 2 with the bias correction).
RPF_INLINE float rpf_mutual_information(int units, int slack, float nats_per_unit, float bias, float neighbors) {
  if (units <= slack) return 0.0f;
  const float information = ((float)units * nats_per_unit - bias) / neighbors;
  return information > 0.0f ? information : 0.0f;
}

// W_c,i^r (T 5.4) and W_f,k^r (T 5.5): the share of the random parameters in what a variable depends on.
RPF_INLINE float rpf_fraction_random(float on_random, float on_position) {
  return on_random / (on_random + on_position + RPF_EPSILON);
}

// W_c^{f,k} (T 5.6): the share of feature k in what the color depends on.
RPF_INLINE float rpf_fraction_feature(float on_feature, float on_random, float on_position, float on_features) {
  return on_feature / (on_random + on_position + on_features + RPF_EPSILON);
}

RPF_INLINE float rpf_not_negative(float x) { return x > 0.0f ? x : 0.0f; }

// alpha_i (T 5.9). `growth` = 1 + 0.1 t of pass t; `factor`: the 2 of the thesis.
RPF_INLINE float rpf_alpha(float factor, float growth, float color_fraction_random) {
  return rpf_not_negative(1.0f - factor * growth * color_fraction_random);
}

// beta_k (T 5.9).
RPF_INLINE float rpf_beta(float fraction_feature, float growth, float feature_fraction_random) {
  return fraction_feature * rpf_not_negative(1.0f - growth * feature_fraction_random);
}

// What section 5 ends with for the color.
typedef struct {
  float color_fraction_random[3];  // W_c,i^r
  float fraction_random;           // W_c^r
  float alpha[3];
} rpf_color_weights;

// And for the features: one value each.
typedef struct {
  float* fraction_random;   // W_f,k^r
  float* fraction_feature;  // W_c^{f,k}
  float* beta;
} rpf_feature_weights;

// The sum of `count` values, one after the other.
RPF_INLINE float rpf_sum(const float* values, uint count) {
  float sum = 0.0f;
  for (uint i = 0; i < count; ++i) sum += values[i];
  return sum;
}

RPF_INLINE float rpf_mean(const float* values, uint count) {
  return count == 0 ? 0.0f : rpf_sum(values, count) / (float)count;
}

// Section 5, second half: mutual information to W, alpha and beta. `information`: every color with 2 position
// coordinates, the random parameters and the features, then every feature with position and random parameters.
RPF_INLINE void rpf_weigh_dependencies(const float* information, uint random, uint features, float alpha_factor,
                                       float growth, rpf_color_weights* color, rpf_feature_weights feature) {
  float on_position = 0.0f, on_random = 0.0f, on_features = 0.0f;
  for (uint k = 0; k < features; ++k) feature.fraction_feature[k] = 0.0f;  // D_c^{f,k} until W_c^{f,k} takes its place
  for (int i = 0; i < 3; ++i) {
    const float color_on_position = rpf_sum(information, 2);
    const float color_on_random = rpf_sum(information + 2, random);
    information += 2 + random;
    for (uint k = 0; k < features; ++k) feature.fraction_feature[k] += information[k];
    on_features += rpf_sum(information, features);
    information += features;
    on_position += color_on_position;
    on_random += color_on_random;
    color->color_fraction_random[i] = rpf_fraction_random(color_on_random, color_on_position);
    color->alpha[i] = rpf_alpha(alpha_factor, growth, color->color_fraction_random[i]);
  }
  color->fraction_random = rpf_sum(color->color_fraction_random, 3) / 3.0f;
  for (uint k = 0; k < features; ++k) {
    feature.fraction_random[k] = rpf_fraction_random(rpf_sum(information + 2, random), rpf_sum(information, 2));
    feature.fraction_feature[k] =
        rpf_fraction_feature(feature.fraction_feature[k], on_random, on_position, on_features);
    feature.beta[k] = rpf_beta(feature.fraction_feature[k], growth, feature.fraction_random[k]);
    information += 2 + random;
  }
}

// ---- section 6: filter ----------------------------------------------------------------------------------------------

// What multiplies the squared distances in the exponent: (1 - W_c^r)^2 / (2 sigma^2), with sigma^2 = 8 noise / s
// (T 5.10).
RPF_INLINE float rpf_sharpness(float fraction_random, float noise, uint samples) {
  const float certain = 1.0f - fraction_random;
  return certain * certain * (float)samples / (16.0f * noise);
}

// A normalized coordinate times this can be subtracted, squared and summed: its coefficient (alpha_i or beta_k) and the
// sharpness are both inside. One multiplication a neighbor instead of one a pair of samples.
RPF_INLINE float rpf_distance_scale(float sharpness, float coefficient) { return sqrt(sharpness * coefficient); }

// Own samples are weighed in groups of so many, or the last of fewer, so that the cost follows the samples, not their
// square: of G groups, group g takes stretch g, g + G, g + 2 G, ... of the neighborhood, of as many neighbors each.
#define RPF_GROUP (RPF_STRETCH * RPF_LANES)
RPF_INLINE uint rpf_groups(uint own) { return (own + RPF_GROUP - 1) / RPF_GROUP; }

// As many own samples at most are weighed with one neighbor.
RPF_INLINE uint rpf_group_size(uint own) { return own < RPF_GROUP ? own : RPF_GROUP; }

// The own samples that are weighed with a neighbor: from here to rpf_group_end().
RPF_INLINE uint rpf_group_begin(uint own, uint neighbor) { return neighbor / RPF_GROUP % rpf_groups(own) * RPF_GROUP; }
RPF_INLINE uint rpf_group_end(uint own, uint neighbor) {
  const uint begin = rpf_group_begin(own, neighbor);
  return begin + rpf_group_size(own - begin);
}

// c''_i (T 5.11), held inside the range of the colors it averages: rounding cannot leave the convex hull.
RPF_INLINE float rpf_filtered(float weighted_sum, float weight_sum, float smallest, float largest) {
  const float mean = weighted_sum / weight_sum;
  if (mean < smallest) return smallest;
  return mean > largest ? largest : mean;
}

// How many equally weighted samples would average as much noise away as a pixel's mean of filtered samples does: 1 /
// sum_j v_j^2, where v_j is the share of neighbor j in it. `squares`: sum_j (s v_j)^2.
RPF_INLINE float rpf_effective_samples(uint samples, float squares) {
  return (float)samples * (float)samples / squares;
}

// ---- section 7: outliers --------------------------------------------------------------------------------------------

RPF_INLINE int rpf_is_outlier(float value, float mean, float deviation) {
  return fabs(value - mean) > RPF_OUTLIER_THRESHOLD * deviation;
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*)
#endif
