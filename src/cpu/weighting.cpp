#include "cpu/weighting.h"

#include <algorithm>

#include "parallel/workers.h"
#include "rpf_math.h"

namespace rpf {
namespace {

/// Adds one column: the variable's normalized values times `scale`. A scale of 0 takes no part in any distance.
void add_coordinate(const Neighborhood& n, std::size_t variable, float scale, FilterScratch& scratch) {
  if (!(scale > 0)) return;
  const std::size_t stride = n.shift.size();
  scratch.coordinates.resize((scratch.active + 1) * scratch.padded, 0.0F);
  float* column = scratch.coordinates.data() + scratch.active * scratch.padded;
  for (std::uint32_t j = 0; j < n.size(); ++j) column[j] = n.rows[j * stride + variable] * scale;
  ++scratch.active;
}

/// Only variables with a weight above 0 become coordinates: colors first, then features.
void set_coordinates(const Plan& plan, const Neighborhood& n, float sharpness, const FilterWeights& weights,
                     FilterScratch& scratch) {
  scratch.start(n.size(), 0);
  for (std::size_t i = 0; i < 3; ++i)
    add_coordinate(n, Variables::color + i, kernel::rpf_distance_scale(sharpness, weights.color.alpha[i]), scratch);
  for (std::size_t k = 0; k < weights.beta.size(); ++k)
    add_coordinate(n, plan.variables.features() + k, kernel::rpf_distance_scale(sharpness, weights.beta[k]), scratch);
}

void collect_colors(std::size_t carried, const Neighborhood& n, const std::vector<float>& colors,
                    FilterScratch& scratch) {
  scratch.colors.assign(carried * scratch.padded, 0.0F);
  for (std::uint32_t j = 0; j < n.size(); ++j)
    for (std::size_t c = 0; c < carried; ++c)
      scratch.colors[c * scratch.padded + j] = colors[n.neighbors[j] * carried + c];
  scratch.smallest.resize(carried);
  scratch.largest.resize(carried);
  for (std::size_t c = 0; c < carried; ++c) {
    const float* column = scratch.colors.data() + c * scratch.padded;
    const auto range = std::minmax_element(column, column + n.size());
    scratch.smallest[c] = *range.first;
    scratch.largest[c] = *range.second;
  }
}

/// The weights of RPF_LANES neighbors from `begin` for own sample i; 0 behind the last neighbor.
void block_weights(const FilterScratch& scratch, std::uint32_t i, std::uint32_t begin, std::uint32_t neighbors,
                   float* weight) {
  float distance[RPF_LANES] = {};
  for (std::size_t a = 0; a < scratch.active; ++a) {
    const float* column = scratch.coordinates.data() + a * scratch.padded;
    const float own = column[i];
    for (int l = 0; l < RPF_LANES; ++l) {
      const float difference = own - column[begin + static_cast<std::uint32_t>(l)];
      distance[l] += difference * difference;
    }
  }
  for (int l = 0; l < RPF_LANES; ++l) weight[l] = kernel::rpf_weight(distance[l]);
  for (std::uint32_t l = neighbors - begin; l < RPF_LANES; ++l) weight[l] = 0.0F;
}

/// Weighted sums over the neighborhood, or a stretch of it, for one own sample.
struct WeightedSums {
  kernel::rpf_lanes weight;
  std::vector<kernel::rpf_lanes> colors;  ///< [carried]

  void clear(std::size_t carried) {
    kernel::rpf_lanes_clear(&weight);
    colors.assign(carried, weight);
  }
  void add(const WeightedSums& stretch) {
    for (int l = 0; l < RPF_LANES; ++l) weight.lane[l] += stretch.weight.lane[l];
    for (std::size_t c = 0; c < colors.size(); ++c)
      for (int l = 0; l < RPF_LANES; ++l) colors[c].lane[l] += stretch.colors[c].lane[l];
  }
  void add(const float* block, const FilterScratch& scratch, std::uint32_t begin) {
    for (int l = 0; l < RPF_LANES; ++l) weight.lane[l] += block[l];
    for (std::size_t c = 0; c < colors.size(); ++c) {
      const float* column = scratch.colors.data() + c * scratch.padded + begin;
      for (int l = 0; l < RPF_LANES; ++l) colors[c].lane[l] += block[l] * column[l];
    }
  }
};

/// The sums of the stretch from neighbor `first` on for own sample i. `row`, if not null, receives its weights: [N].
void sum_stretch(const FilterScratch& scratch, std::uint32_t i, std::uint32_t first, std::uint32_t neighbors,
                 float* row, WeightedSums& sums) {
  const std::uint32_t last = std::min<std::uint32_t>(first + RPF_GROUP, neighbors);
  float block[RPF_LANES];
  sums.clear(sums.colors.size());
  for (std::uint32_t begin = first; begin < last; begin += RPF_LANES) {
    block_weights(scratch, i, begin, neighbors, block);
    sums.add(block, scratch, begin);
    if (row) std::copy_n(block, std::min<std::uint32_t>(RPF_LANES, neighbors - begin), row + begin);
  }
}

/// Mean and standard deviation of one channel of a pixel's filtered samples. The mean is relative to `shift`: with two
/// samples both are exactly one standard deviation off, and only differences tell that from more.
struct ChannelMoments {
  float shift = 0, mean = 0, deviation = 0;
};

ChannelMoments channel_moments(const float* filtered, std::uint32_t samples, std::size_t carried, int channel,
                               float shift) {
  ChannelMoments m;
  m.shift = shift;
  kernel::rpf_lanes sum;
  kernel::rpf_lanes_clear(&sum);
  for (std::uint32_t i = 0; i < samples; ++i) kernel::rpf_lanes_add(&sum, i, filtered[i * carried + channel] - shift);
  m.mean = kernel::rpf_lanes_total(&sum) / static_cast<float>(samples);
  kernel::rpf_lanes_clear(&sum);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const float off = (filtered[i * carried + channel] - shift) - m.mean;
    kernel::rpf_lanes_add(&sum, i, off * off);
  }
  m.deviation = kernel::sqrt(kernel::rpf_lanes_total(&sum) / static_cast<float>(samples));
  return m;
}

}  // namespace

void FilterScratch::start(std::uint32_t neighbors, std::size_t active_) {
  active = active_;
  padded = (neighbors + RPF_LANES - 1) / RPF_LANES * RPF_LANES;
  coordinates.assign(active * padded, 0.0F);
}

void filter_samples(const Plan& plan, const Neighborhood& n, std::uint32_t own, const FilterWeights& weights,
                    const std::vector<float>& colors, FilterScratch& scratch, float* out,
                    std::vector<float>* weights_out) {
  set_coordinates(plan, n, kernel::rpf_sharpness(weights.color.fraction_random, plan.noise, own), weights, scratch);
  average(plan.carried, n, own, colors, scratch, out, weights_out);
}

void average(std::size_t carried, const Neighborhood& n, std::uint32_t own, const std::vector<float>& colors,
             FilterScratch& scratch, float* out, std::vector<float>* weights_out) {
  collect_colors(carried, n, colors, scratch);
  scratch.inverse_total.resize(own);
  if (weights_out) weights_out->assign(std::size_t{own} * n.size(), 0.0F);
  const std::uint32_t apart = kernel::rpf_groups(own) * RPF_GROUP;
  WeightedSums sums, stretch;
  for (std::uint32_t i = 0; i < own && !must_stop(); ++i) {
    sums.clear(carried);
    stretch.clear(carried);
    float* row = weights_out ? weights_out->data() + std::size_t{i} * n.size() : nullptr;
    for (std::uint32_t first = i / RPF_GROUP * RPF_GROUP; first < n.size(); first += apart) {
      sum_stretch(scratch, i, first, n.size(), row, stretch);
      sums.add(stretch);
    }
    const float total = kernel::rpf_lanes_total(&sums.weight);
    scratch.inverse_total[i] = 1.0F / total;
    for (std::size_t c = 0; c < carried; ++c)
      out[i * carried + c] = kernel::rpf_filtered(kernel::rpf_lanes_total(&sums.colors[c]), total, scratch.smallest[c],
                                                  scratch.largest[c]);
  }
}

float effective_samples(std::uint32_t own, std::uint32_t neighbors, const FilterScratch& scratch) {
  kernel::rpf_lanes squares;
  kernel::rpf_lanes_clear(&squares);
  float block[RPF_LANES];
  for (std::uint32_t begin = 0; begin < neighbors && !must_stop(); begin += RPF_LANES) {
    float share[RPF_LANES] = {};
    const std::uint32_t end = kernel::rpf_group_end(own, begin);
    for (std::uint32_t i = kernel::rpf_group_begin(own, begin); i < end; ++i) {
      block_weights(scratch, i, begin, neighbors, block);
      for (int l = 0; l < RPF_LANES; ++l) share[l] += block[l] * scratch.inverse_total[i];
    }
    for (int l = 0; l < RPF_LANES; ++l) squares.lane[l] += share[l] * share[l];
  }
  return kernel::rpf_effective_samples(own, kernel::rpf_lanes_total(&squares));
}

void replace_outliers(float* filtered, std::uint32_t samples, std::size_t carried) {
  ChannelMoments before[3];
  for (int c = 0; c < 3; ++c) before[c] = channel_moments(filtered, samples, carried, c, filtered[c]);
  for (std::uint32_t i = 0; i < samples; ++i) {
    float* sample = filtered + i * carried;
    bool outlier = false;
    for (int c = 0; c < 3; ++c)
      outlier = outlier || kernel::rpf_is_outlier(sample[c] - before[c].shift, before[c].mean, before[c].deviation);
    for (int c = 0; outlier && c < 3; ++c) sample[c] = before[c].shift + before[c].mean;
  }
  for (int c = 0; c < 3; ++c) {
    const float taken = before[c].mean - channel_moments(filtered, samples, carried, c, before[c].shift).mean;
    for (std::uint32_t i = 0; i < samples; ++i) filtered[i * carried + c] += taken;
  }
}

}  // namespace rpf
