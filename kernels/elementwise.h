// Formulas that hold value by value. numeric.h includes this text once for every type: RPF_REAL is float, and in OpenCL
// C also float16, so that a scalar loop and a vector unit compute from the same lines. Hence no include guard.
//
// A comparison is 0 or 1 for a float and 0 or -1 per lane for a float16: use it in `?:` and with bit operations only.
// NOLINTBEGIN(modernize-*, bugprone-macro-parentheses): this is OpenCL C too

// ---- missing values -------------------------------------------------------------------------------------------------

// A missing feature or random parameter is a NaN; no other NaN enters the filter.
RPF_INLINE RPF_INT rpf_is_missing(RPF_REAL x) { return x != x; }

RPF_INLINE RPF_REAL rpf_or_zero(RPF_REAL x) { return rpf_is_missing(x) ? 0.0f : x; }

// ---- sums -----------------------------------------------------------------------------------------------------------

// Partial sums of a sequence: element j belongs to lane j mod RPF_LANES. Start with all lanes 0.
typedef struct {
  RPF_REAL lane[RPF_LANES];
} RPF_SUMS;

RPF_INLINE void rpf_lanes_clear(RPF_SUMS* sum) {
  for (int l = 0; l < RPF_LANES; ++l) sum->lane[l] = 0.0f;
}

RPF_INLINE void rpf_lanes_add(RPF_SUMS* sum, uint j, RPF_REAL value) { sum->lane[j % RPF_LANES] += value; }

// The fixed tree: halves are added until one is left, lane l with lane l + width.
RPF_INLINE RPF_REAL rpf_lanes_total(const RPF_SUMS* sum) {
  RPF_REAL lane[RPF_LANES];
  for (int l = 0; l < RPF_LANES; ++l) lane[l] = sum->lane[l];
  for (int width = RPF_LANES / 2; width > 0; width /= 2)
    for (int l = 0; l < width; ++l) lane[l] += lane[l + width];
  return lane[0];
}

// ---- exponential ----------------------------------------------------------------------------------------------------

#define RPF_EXP_UNDERFLOW -87.0f  // below: 0. exp(-87) is 1.6e-38, just above the smallest normal float.

// exp(x) for x <= 0, 0 below RPF_EXP_UNDERFLOW (so the result is never subnormal), within 1 ULP; rpf_exp(0) is
// exactly 1. x = n ln 2 + r with |r| <= ln 2 / 2; ln 2 in two parts so that n * hi is exact; Taylor-like minimax
// polynomial in r (the coefficients of Cephes' expf, S. Moshier).
RPF_INLINE RPF_REAL rpf_exp(RPF_REAL x) {
  const RPF_REAL y = x >= RPF_EXP_UNDERFLOW ? x : -88.0f;  // whose n is -127: the last factor is 0
  const RPF_REAL shifted = y * 1.44269504f + 12582912.0f;  // 1.5 * 2^23: the sum's last bit has the value 1
  const RPF_REAL n = shifted - 12582912.0f;
  const RPF_REAL r = (y - n * 0.693359375f) - n * -2.12194440e-4f;
  RPF_REAL p = 1.9875691500e-4f;
  p = p * r + 1.3981999507e-3f;
  p = p * r + 8.3334519073e-3f;
  p = p * r + 4.1665795894e-2f;
  p = p * r + 1.6666665459e-1f;
  p = p * r + 5.0000001201e-1f;
  p = p * (r * r) + r;
  return (p + 1.0f) * RPF_AS_REAL((RPF_TO_INT(n) + 127) << 23);
}

// ---- random numbers -------------------------------------------------------------------------------------------------

// Three independent 32-bit words.
typedef struct {
  RPF_UINT x, y, z;
} RPF_WORDS;

// pcg3d: a counter-based generator, three words in, three out (Jarzynski and Olano, "Hash Functions for GPU Rendering",
// JCGT 9(3), 2020). No state: the draws do not depend on the order in which pixels are visited.
RPF_INLINE RPF_WORDS rpf_hash(RPF_UINT x, RPF_UINT y, RPF_UINT z) {
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
  RPF_WORDS words;
  words.x = x;
  words.y = y;
  words.z = z;
  return words;
}

// ---- section 3: neighborhood ----------------------------------------------------------------------------------------

// The random words of one attempt of one draw: x indexes the offset table (low half: dx, high half: dy), y picks the
// sample. A draw has at most RPF_MAX_ATTEMPTS attempts, so that the counters of two draws never meet.
#define RPF_MAX_ATTEMPTS 16u
RPF_INLINE RPF_WORDS rpf_draw_words(rpf_words key, RPF_UINT draw, uint attempt) {
  return rpf_hash(key.x ^ (draw * RPF_MAX_ATTEMPTS + attempt), key.y, key.z);
}

// The one tolerance that the two conditions of the rejection test come to for H >= 1: max(H s, a).
RPF_INLINE RPF_REAL rpf_tolerance(RPF_REAL rejection_factor, RPF_REAL own_deviation, RPF_REAL minimum) {
  const RPF_REAL scaled = rejection_factor * own_deviation;
  return scaled > minimum ? scaled : minimum;
}

// A candidate is rejected when this holds for any feature. `value` and `own_mean` are both relative to the same shift.
// Missing values compare false and so never reject.
RPF_INLINE RPF_INT rpf_rejects(RPF_REAL value, RPF_REAL own_mean, RPF_REAL tolerance) {
  return fabs(value - own_mean) > tolerance;
}

// ---- section 4: normalization ---------------------------------------------------------------------------------------

#define RPF_FLAT_SPREAD 1e-6f  // a smaller standard deviation, relative to the values, is 0

// Mean 0, standard deviation 1. `value` and `mean` are relative to the same shift. What is missing stays missing here,
// and counts as 0 from then on.
RPF_INLINE RPF_REAL rpf_normalize(RPF_REAL value, RPF_REAL mean, RPF_REAL inverse_deviation) {
  return (value - mean) * inverse_deviation;
}

// 1 / standard deviation, or 0 where the variable counts as constant. `largest`: largest magnitude of the unshifted
// values.
RPF_INLINE RPF_REAL rpf_inverse_deviation(RPF_REAL variance, RPF_REAL largest) {
  const RPF_REAL deviation = sqrt(variance);
  return deviation > RPF_FLAT_SPREAD * largest ? 1.0f / deviation : 0.0f;
}

// ---- section 5: bins ------------------------------------------------------------------------------------------------

// Bin of a normalized value less K, -K .. K: nearest integer, half away from zero, clamped to [-K, K]. What is added
// before truncation is the largest number below 1/2: with 1/2 itself the largest number below 1/2 would round up to 1.
RPF_INLINE RPF_INT rpf_signed_bin(RPF_REAL normalized, int half_bins) {
  const float limit = (float)half_bins, below_half = 0.49999997f;
  const RPF_REAL magnitude = fabs(normalized) < limit ? fabs(normalized) : limit;
  const RPF_INT nearest = RPF_TO_INT(magnitude + below_half);
  return normalized < 0.0f ? -nearest : nearest;
}

// ---- section 6: weights ---------------------------------------------------------------------------------------------

// w_ij (T 5.3 with 5.10) from the sum of squared scaled differences.
RPF_INLINE RPF_REAL rpf_weight(RPF_REAL squared_distance) { return rpf_exp(-squared_distance); }

// ---- section 8: fixed weights ---------------------------------------------------------------------------------------

// A value less its center; a missing value is at the center.
RPF_INLINE RPF_REAL rpf_centered(RPF_REAL value, float center) { return rpf_or_zero(value - center); }

// NOLINTEND(modernize-*, bugprone-macro-parentheses)
