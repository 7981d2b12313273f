#include "cpu/cpu_backend.h"

#include <algorithm>
#include <chrono>
#include <future>

#include "cpu/box.h"
#include "cpu/neighborhood.h"
#include "cpu/statistics.h"
#include "cpu/weighting.h"
#include "rpf_math.h"

namespace rpf {

/// Everything a thread needs for one pixel, reused for the next.
struct CpuBackend::Workspace {
  Neighborhood neighborhood;
  Normalization normalization;
  Dependencies dependencies;
  FilterWeights weights;
  FilterScratch filter;
};

namespace {

using Workspace = CpuBackend::Workspace;

PixelStatistics summarize(const Workspace& w) {
  PixelStatistics s{};
  s.drawn = w.neighborhood.drawn;
  s.neighbors = w.neighborhood.size();
  s.fraction_random = w.weights.color.fraction_random;
  s.alpha = kernel::rpf_mean(w.weights.color.alpha, 3);
  s.beta = kernel::rpf_mean(w.weights.beta.data(), static_cast<kernel::uint>(w.weights.beta.size()));
  return s;
}

/// Sections 3 and 4.
void fill_neighborhood(const Frame& frame, const Plan& plan, int pass, std::uint32_t pixel, Workspace& w) {
  if (plan.method != Method::rpf) return gather_box(frame, plan, pass, pixel, w.neighborhood);
  gather(frame, plan, pass, pixel, w.neighborhood);
  normalize(w.neighborhood, w.normalization);
}

/// Section 5, for the neighborhood in the workspace.
void measure(const Plan& plan, int pass, Workspace& w) {
  if (plan.method != Method::rpf) return;
  measure_dependencies(plan, pass, w.neighborhood, w.dependencies);
  compute_weights(plan, pass, w.dependencies, w.weights);
}

/// Section 6 or 8, likewise. `out`: [own samples][carried].
void average_samples(const Frame& frame, const Plan& plan, int pass, std::uint32_t own,
                     const std::vector<float>& colors, Workspace& w, float* out, std::vector<float>* weights_out) {
  if (plan.method == Method::rpf)
    filter_samples(plan, w.neighborhood, own, w.weights, colors, w.filter, out, weights_out);
  else
    filter_box(frame, plan, pass, w.neighborhood, own, colors, w.filter, out, weights_out);
}

/// The same with section 7.
void average_and_replace(const Frame& frame, const Plan& plan, int pass, std::uint32_t pixel,
                         const std::vector<float>& colors, Workspace& w, float* out) {
  average_samples(frame, plan, pass, frame.samples(pixel), colors, w, out, nullptr);
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

void CpuBackend::filter_pixel(int pass, std::uint32_t pixel, const Window& tile, Workspace& w) {
  if (frame_->samples(pixel) == 0 || must_stop()) return;
  fill_neighborhood(*frame_, *plan_, pass, pixel, w);
  measure(*plan_, pass, w);
  average_and_replace(*frame_, *plan_, pass, pixel, colors_, w,
                      next_colors_.data() + frame_->first_sample[pixel] * plan_->carried);
  statistics_[pixel] = summarize(w);
  if (plan_->explain) keep_explanation(tile, pixel, w);
}

void CpuBackend::keep_explanation(const Window& tile, std::uint32_t pixel, const Workspace& w) {
  const int x = static_cast<int>(pixel) % frame_->width, y = static_cast<int>(pixel) / frame_->width;
  const std::vector<float>& information = w.dependencies.information;
  const std::size_t place = static_cast<std::size_t>(y - tile.y) * tile.width + x - tile.x;
  float* to = explained_.data() + place * (information.size() + 1);
  *std::copy(information.begin(), information.end(), to) =
      effective_samples(frame_->samples(pixel), w.neighborhood.size(), w.filter);
}

void CpuBackend::run(int pass, const Window& tile) {
  if (plan_->explain) explained_.assign(tile.pixel_count() * (pair_count(plan_->variables) + 1), 0.0F);
  std::vector<Workspace> workspaces(static_cast<std::size_t>(threads_));
  run_watched(tile.pixel_count(), [&](std::size_t i, std::size_t worker) {
    const int place = static_cast<int>(i), x = tile.x + place % tile.width, y = tile.y + place / tile.width;
    filter_pixel(pass, static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(frame_->width) + x, tile,
                 workspaces[worker]);
  });
}

void CpuBackend::run_watched(std::size_t count, const Workers::Body& body) {
  constexpr auto between_checks = std::chrono::milliseconds(100);
  Workers workers(threads_);
  const auto work = [&] { workers.for_all(0, count, body); };
  if (!check_) return work();
  std::future<void> done = std::async(std::launch::async, work);
  try {
    while (done.wait_for(between_checks) != std::future_status::ready) check_();
  } catch (...) {
    workers.stop();
    done.wait();
    throw;
  }
  done.get();
}

void CpuBackend::end_pass() { colors_.swap(next_colors_); }

PixelTrace CpuBackend::trace(int pass, std::uint32_t pixel) {
  PixelTrace t;
  run_watched(1, [&](std::size_t, std::size_t) { t = trace_here(pass, pixel); });
  return t;
}

PixelTrace CpuBackend::trace_here(int pass, std::uint32_t pixel) const {
  Workspace w;
  PixelTrace t;
  t.pass = pass;
  t.pixel = pixel;
  const std::uint32_t own = frame_->samples(pixel);
  if (own == 0) return t;
  fill_neighborhood(*frame_, *plan_, pass, pixel, w);
  measure(*plan_, pass, w);
  t.colors.resize(own * plan_->carried);
  average_and_replace(*frame_, *plan_, pass, pixel, colors_, w, t.colors.data());
  t.filtered.resize(t.colors.size());
  average_samples(*frame_, *plan_, pass, own, colors_, w, t.filtered.data(), &t.weights);
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
