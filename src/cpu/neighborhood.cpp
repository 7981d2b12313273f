#include "cpu/neighborhood.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "rpf_math.h"

namespace rpf {
namespace {

/// Draws candidates for one pixel of one pass.
class Sampler {
 public:
  Sampler(const Frame& frame, const Plan& plan, int pass, std::uint32_t pixel)
      : frame_(frame),
        plan_(plan),
        offsets_(plan.passes[static_cast<std::size_t>(pass)].offsets),
        key_(kernel::rpf_draw_key(plan.seed, static_cast<kernel::uint>(pass), pixel)),
        x_(static_cast<int>(pixel) % frame.width),
        y_(static_cast<int>(pixel) / frame.width) {}

  /// The sample of one draw; nothing when every attempt left the image or met an empty pixel.
  std::optional<std::uint32_t> draw(std::uint32_t number) const {
    for (std::uint32_t attempt = 0; attempt < plan_.attempts; ++attempt) {
      const kernel::rpf_words words = kernel::rpf_draw_words(key_, number, attempt);
      const int dx = offsets_[words.x & 0xFFFFU], dy = offsets_[words.x >> 16];
      const int x = x_ + dx, y = y_ + dy;
      if ((dx == 0 && dy == 0) || x < 0 || x >= frame_.width || y < 0 || y >= frame_.height) continue;
      const std::size_t pixel = static_cast<std::size_t>(y) * frame_.width + x;
      const std::uint32_t samples = frame_.samples(pixel);
      if (samples > 0) return frame_.first_sample[pixel] + kernel::rpf_choose(words.y, samples);
    }
    return std::nullopt;
  }

 private:
  const Frame& frame_;
  const Plan& plan_;
  const std::vector<std::int8_t>& offsets_;
  kernel::rpf_words key_;
  int x_, y_;
};

/// The variables of the first own sample that has them, missing where none has.
void set_shift(const Frame& frame, std::uint32_t first, std::uint32_t own, std::vector<float>& shift) {
  shift.assign(frame.record(first), frame.record(first) + frame.variables);
  for (std::uint32_t i = 1; frame.has_missing && i < own; ++i)
    for (std::size_t v = 0; v < shift.size(); ++v)
      if (kernel::rpf_is_missing(shift[v])) shift[v] = frame.record(first + i)[v];
}

void append(Neighborhood& n, std::uint32_t sample, const float* record) {
  const std::size_t variables = n.shift.size(), end = n.rows.size();
  n.neighbors.push_back(sample);
  n.rows.resize(end + variables);
  for (std::size_t v = 0; v < variables; ++v) n.rows[end + v] = record[v] - n.shift[v];
}

/// Mean (relative to the shift) and standard deviation of one variable over the rows so far; missing values left out.
struct Moments {
  float mean = 0, deviation = 0;
  std::uint32_t count = 0;
};

Moments own_moments(const Neighborhood& n, std::size_t variable) {
  const std::size_t stride = n.shift.size();
  Moments m;
  kernel::rpf_lanes sum;
  kernel::rpf_lanes_clear(&sum);
  for (std::uint32_t j = 0; j < n.size(); ++j) {
    const float value = n.rows[j * stride + variable];
    if (kernel::rpf_is_missing(value)) continue;
    kernel::rpf_lanes_add(&sum, j, value);
    ++m.count;
  }
  if (m.count == 0) return m;
  m.mean = kernel::rpf_lanes_total(&sum) / static_cast<float>(m.count);
  kernel::rpf_lanes_clear(&sum);
  for (std::uint32_t j = 0; j < n.size(); ++j) {
    const float off = n.rows[j * stride + variable] - m.mean;
    if (!kernel::rpf_is_missing(off)) kernel::rpf_lanes_add(&sum, j, off * off);
  }
  m.deviation = kernel::sqrt(kernel::rpf_lanes_total(&sum) / static_cast<float>(m.count));
  return m;
}

/// Section 3, step 3: one tolerance a feature from the pixel's own samples.
void set_tolerances(const Plan& plan, Neighborhood& n) {
  const std::size_t features = plan.variables.feature_names.size();
  n.own_mean.resize(features);
  n.own_deviation.resize(features);
  n.tolerance.resize(features);
  for (std::size_t k = 0; k < features; ++k) {
    const Moments m = own_moments(n, plan.variables.features() + k);
    n.own_mean[k] = m.mean;
    n.own_deviation[k] = m.deviation;
    const float unlimited = std::numeric_limits<float>::infinity();
    n.tolerance[k] = m.count == 0
                         ? unlimited
                         : kernel::rpf_tolerance(plan.rejection_factor[k], m.deviation, plan.minimum_tolerance[k]);
  }
}

bool is_accepted(const Neighborhood& n, const float* record, std::size_t first_feature) {
  for (std::size_t k = 0; k < n.tolerance.size(); ++k) {
    const std::size_t v = first_feature + k;
    if (kernel::rpf_rejects(record[v] - n.shift[v], n.own_mean[k], n.tolerance[k])) return false;
  }
  return true;
}

/// Section 3, step 2: draws begin .. end - 1 first, so that the records are on the way from memory when they are
/// tested.
void draw_candidates(const Frame& frame, const Plan& plan, const Sampler& sampler, std::uint32_t begin,
                     std::uint32_t end, Neighborhood& n) {
  n.candidates.clear();
  for (std::uint32_t number = begin; number < end; ++number) {
    const std::optional<std::uint32_t> candidate = sampler.draw(number);
    if (!candidate) continue;
    n.candidates.push_back(*candidate);
    __builtin_prefetch(frame.record(*candidate) + plan.variables.features());
  }
  n.drawn += static_cast<std::uint32_t>(n.candidates.size());
}

/// What no own sample has is shifted by the first neighbor that has it, by 0 where none has.
void settle_shift(const Frame& frame, Neighborhood& n) {
  const std::size_t variables = n.shift.size();
  for (std::size_t v = 0; v < variables; ++v) {
    if (!kernel::rpf_is_missing(n.shift[v])) continue;
    for (std::uint32_t j = 0; j < n.size() && kernel::rpf_is_missing(n.shift[v]); ++j)
      n.shift[v] = frame.record(n.neighbors[j])[v];
    n.shift[v] = kernel::rpf_or_zero(n.shift[v]);
    for (std::uint32_t j = 0; j < n.size(); ++j)
      n.rows[j * variables + v] = frame.record(n.neighbors[j])[v] - n.shift[v];
  }
}

}  // namespace

void gather(const Frame& frame, const Plan& plan, int pass, std::uint32_t pixel, Neighborhood& n) {
  const std::uint32_t first = frame.first_sample[pixel], own = frame.samples(pixel);
  n.neighbors.clear();
  n.rows.clear();
  set_shift(frame, first, own, n.shift);
  for (std::uint32_t i = 0; i < own; ++i) append(n, first + i, frame.record(first + i));
  set_tolerances(plan, n);

  const PassPlan& p = plan.passes[static_cast<std::size_t>(pass)];
  const Sampler sampler(frame, plan, pass, pixel);
  const std::uint32_t draws = p.neighborhood.draws(own);
  n.drawn = 0;
  for (std::uint32_t begin = 0; begin < draws; begin += RPF_DRAWN_AT_ONCE) {
    draw_candidates(frame, plan, sampler, begin, std::min(begin + RPF_DRAWN_AT_ONCE, draws), n);
    for (const std::uint32_t candidate : n.candidates) {
      const float* record = frame.record(candidate);
      if (is_accepted(n, record, plan.variables.features())) append(n, candidate, record);
    }
  }
  settle_shift(frame, n);
}

}  // namespace rpf
