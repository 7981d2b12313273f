#include "opencl/trace_reader.h"

#include <algorithm>

#include "rpf_math.h"

namespace rpf {
namespace {

kernel::uint random_count(const Plan& plan) { return static_cast<kernel::uint>(plan.variables.random_names.size()); }
kernel::uint feature_count(const Plan& plan) { return static_cast<kernel::uint>(plan.variables.feature_names.size()); }

std::size_t bin_count(const Plan& plan) { return 2 * static_cast<std::size_t>(plan.half_bins) + 1; }

}  // namespace

PixelTrace empty_trace(int pass, std::uint32_t pixel) {
  PixelTrace t;
  t.pass = pass;
  t.pixel = pixel;
  return t;
}

TraceReader::TraceReader(Session& session, const Plan& plan, int pass, std::uint32_t pixel, std::uint32_t own)
    : session_(session),
      plan_(plan),
      pass_(pass),
      pixel_(pixel),
      own_(own),
      at_(kernel::rpf_lay_out_trace(random_count(plan), feature_count(plan), static_cast<kernel::uint>(plan.carried),
                                    own)) {
  const std::size_t neighbors = std::max(plan.passes[static_cast<std::size_t>(pass)].max_neighbors, own);
  const std::size_t cells =
      kernel::rpf_pairs(random_count(plan), feature_count(plan)) * bin_count(plan) * bin_count(plan);
  values_ = session.copy(std::vector<float>(at_.weights + (own + plan.variables.count()) * neighbors, 0.0F));
  histograms_ = session.copy(std::vector<std::uint32_t>(cells, 0));
}

std::vector<float> TraceReader::part(const std::vector<float>& values, std::uint32_t at, std::size_t count) const {
  return {values.begin() + at, values.begin() + at + static_cast<std::ptrdiff_t>(count)};
}

std::vector<std::uint8_t> TraceReader::bins(const Scratch& scratch, std::uint32_t neighbors) {
  constexpr std::uint8_t in_no_bin = 255;
  const std::size_t variables = plan_.variables.count(), count = bin_count(plan_);
  const std::size_t words = kernel::rpf_plane_words(neighbors);
  const std::size_t stride = kernel::rpf_bin_vectors(static_cast<kernel::uint>(count)) * RPF_BINS_AT_ONCE;
  const auto planes = session_.read<std::uint64_t>(scratch.planes, 0, variables * words * stride);
  std::vector<std::uint8_t> bins(neighbors * variables, in_no_bin);
  for (std::uint32_t j = 0; j < neighbors; ++j)
    for (std::size_t v = 0; v < variables; ++v) {
      const std::uint64_t* bins_of_word = planes.data() + (v * words + j / RPF_WORD_BITS) * stride;
      for (std::size_t bin = 0; bin < count; ++bin)
        if ((bins_of_word[bin] >> kernel::rpf_plane_bit(j, static_cast<kernel::uint>(count)) & 1U) != 0)
          bins[j * variables + v] = static_cast<std::uint8_t>(bin);
    }
  return bins;
}

PixelTrace TraceReader::read(const Scratch& scratch, std::uint32_t neighbors, std::vector<float> colors) {
  const std::vector<float> values =
      session_.read<float>(values_, 0, at_.weights + (own_ + plan_.variables.count()) * neighbors);
  PixelTrace t = empty_trace(pass_, pixel_);
  t.neighbors = session_.read<std::uint32_t>(scratch.neighbors, 0, neighbors);
  if (plan_.method == Method::rpf) read_statistics(scratch, values, t);
  t.filtered = part(values, at_.filtered, own_ * plan_.carried);
  t.weights = part(values, at_.weights, std::size_t{own_} * neighbors);
  t.colors = std::move(colors);
  return t;
}

void TraceReader::read_statistics(const Scratch& scratch, const std::vector<float>& values, PixelTrace& t) {
  const std::size_t variables = plan_.variables.count(), features = feature_count(plan_);
  const auto neighbors = static_cast<std::uint32_t>(t.neighbors.size());
  t.shift = part(values, at_.shift, variables);
  t.own_mean = part(values, at_.own_mean, features);
  t.own_deviation = part(values, at_.own_deviation, features);
  t.tolerance = part(values, at_.tolerance, features);
  t.mean = part(values, at_.mean, variables);
  t.inverse_deviation = part(values, at_.inverse_deviation, variables);
  t.normalized = part(values, at_.weights + own_ * neighbors, variables * neighbors);
  t.bins = bins(scratch, neighbors);
  t.histograms = session_.read<std::uint32_t>(
      histograms_, 0,
      kernel::rpf_pairs(random_count(plan_), feature_count(plan_)) * bin_count(plan_) * bin_count(plan_));
  t.mutual_information = part(values, at_.information, at_.color_weights - at_.information);
  const std::vector<float> color = part(values, at_.color_weights, 7);
  std::copy_n(color.begin(), 3, t.filter_weights.color.color_fraction_random);
  t.filter_weights.color.fraction_random = color[3];
  std::copy_n(color.begin() + 4, 3, t.filter_weights.color.alpha);
  t.filter_weights.feature_fraction_random = part(values, at_.feature_fraction_random, features);
  t.filter_weights.fraction_feature = part(values, at_.fraction_feature, features);
  t.filter_weights.beta = part(values, at_.beta, features);
}

}  // namespace rpf
