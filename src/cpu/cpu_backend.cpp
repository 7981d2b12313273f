#include "cpu/cpu_backend.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "cpu/neighborhood.h"
#include "cpu/statistics.h"
#include "cpu/weighting.h"
#include "rpf_math.h"

namespace rpf {
namespace {

/// Everything a thread needs for one pixel, reused for the next.
struct Workspace {
  Neighborhood neighborhood;
  Normalization normalization;
  Dependencies dependencies;
  FilterWeights weights;
  FilterScratch filter;
};

PixelStatistics summarize(const Workspace& w) {
  PixelStatistics s{};
  s.drawn = static_cast<std::uint32_t>(w.neighborhood.candidates.size());
  s.neighbors = w.neighborhood.size();
  s.fraction_random = w.weights.color.fraction_random;
  s.alpha = kernel::rpf_mean(w.weights.color.alpha, 3);
  s.beta = kernel::rpf_mean(w.weights.beta.data(), static_cast<kernel::uint>(w.weights.beta.size()));
  return s;
}

/// Algorithm 1 for one pixel: sections 3 to 7. `out`: [own samples][carried].
void filter_pixel(const Frame& frame, const Plan& plan, int pass, std::uint32_t pixel, const std::vector<float>& colors,
                  Workspace& w, float* out) {
  gather(frame, plan, pass, pixel, w.neighborhood);
  normalize(w.neighborhood, w.normalization);
  measure_dependencies(plan, pass, w.neighborhood, w.dependencies);
  compute_weights(plan, pass, w.dependencies, w.weights);
  filter_samples(plan, w.neighborhood, frame.samples(pixel), w.weights, colors, w.filter, out, nullptr);
  if (plan.outlier_step) replace_outliers(out, frame.samples(pixel), plan.carried);
}

}  // namespace

void CpuBackend::load(const Frame& frame, std::vector<float> colors, const Plan& plan) {
  frame_ = &frame;
  plan_ = &plan;
  colors_ = std::move(colors);
  next_colors_ = colors_;
  statistics_.assign(frame.first_sample.size() - 1, {});
}

void CpuBackend::run(int pass, const Window& tile) {
  tbb::enumerable_thread_specific<Workspace> workspaces;
  const auto width = static_cast<std::size_t>(tile.width);
  arena_.execute([&] {
    tbb::parallel_for(std::size_t{0}, tile.pixel_count(), [&](std::size_t i) {
      const std::size_t x = static_cast<std::size_t>(tile.x) + i % width,
                        y = static_cast<std::size_t>(tile.y) + i / width;
      const auto pixel = static_cast<std::uint32_t>(y * static_cast<std::size_t>(frame_->width) + x);
      if (frame_->samples(pixel) == 0) return;
      Workspace& w = workspaces.local();
      filter_pixel(*frame_, *plan_, pass, pixel, colors_, w,
                   next_colors_.data() + frame_->first_sample[pixel] * plan_->carried);
      statistics_[pixel] = summarize(w);
    });
  });
}

void CpuBackend::end_pass() { colors_.swap(next_colors_); }

PixelTrace CpuBackend::trace(int pass, std::uint32_t pixel) {
  Workspace w;
  PixelTrace t;
  t.pass = pass;
  t.pixel = pixel;
  const std::uint32_t own = frame_->samples(pixel);
  if (own == 0) return t;
  t.colors.resize(own * plan_->carried);
  filter_pixel(*frame_, *plan_, pass, pixel, colors_, w, t.colors.data());
  t.filtered.resize(t.colors.size());
  filter_samples(*plan_, w.neighborhood, own, w.weights, colors_, w.filter, t.filtered.data(), &t.weights);
  t.shift = w.neighborhood.shift;
  t.neighbors = w.neighborhood.neighbors;
  t.own_mean = w.neighborhood.own_mean;
  t.own_deviation = w.neighborhood.own_deviation;
  t.tolerance = w.neighborhood.tolerance;
  t.mean = w.normalization.mean;
  t.inverse_deviation = w.normalization.inverse_deviation;
  t.normalized = w.neighborhood.rows;
  t.bins = w.dependencies.bins;
  t.histograms = w.dependencies.histograms;
  t.mutual_information = w.dependencies.information;
  t.filter_weights = w.weights;
  return t;
}

std::uint64_t CpuBackend::scratch_bytes(const Plan& plan, std::uint64_t /*samples*/) const {
  std::uint64_t neighbors = 0;
  for (const PassPlan& pass : plan.passes) neighbors = std::max<std::uint64_t>(neighbors, pass.max_neighbors);
  const std::uint64_t variables = plan.variables.count();
  // Rows, bins, coordinates, colors and sample numbers; vectors that grow hold up to twice their content.
  return static_cast<std::uint64_t>(threads_) * 2 * neighbors *
         (4 * variables + variables + 4 * (variables + plan.carried) + 8);
}

}  // namespace rpf
