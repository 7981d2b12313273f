#include "run/progress_meter.h"

#include <algorithm>

#include "rpf/error.h"

namespace rpf {
namespace {

/// The fixed cost of a pixel (histograms of all pairs) in units of a neighbor's cost.
constexpr double fixed_cost = 100;

/// Weights, an own sample times a neighbor each, that cost as much as a neighbor.
constexpr double weights_per_neighbor = 50;

double cost_of(const PassPlan& pass) {
  return fixed_cost + pass.max_neighbors + static_cast<double>(pass.fixed_weights) / weights_per_neighbor;
}

}  // namespace

std::size_t tile_pixels(const PassPlan& pass, int threads) {
  // A neighbor costs about 0.5 microseconds in the scalar reference.
  constexpr double neighbors_per_tile = 1e6;
  constexpr std::size_t most_tiles = 1000;  // a thousandth of a pass is progress enough
  const auto by_cost = static_cast<std::size_t>(std::max(1.0, threads * neighbors_per_tile / cost_of(pass)));
  return std::max(by_cost, pass.region.pixel_count() / most_tiles);
}

ProgressMeter::ProgressMeter(const Plan& plan, const Control& control)
    : control_(control), passes_(static_cast<int>(plan.passes.size())) {
  for (const PassPlan& pass : plan.passes) {
    pixel_cost_.push_back(cost_of(pass));
    total_ += pixel_cost_.back() * static_cast<double>(pass.region.pixel_count());
  }
}

double ProgressMeter::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ProgressMeter::add(int pass, std::size_t pixels) {
  done_ += pixel_cost_[static_cast<std::size_t>(pass)] * static_cast<double>(pixels);
  tell(pass);
}

void ProgressMeter::add_part(double part) {
  done_ += part;
  tell(0);
}

void ProgressMeter::check_compiling() { tell(pass_, true); }

void ProgressMeter::tell(int pass, bool compiling) {
  pass_ = pass;
  if (!control_.progress) return;
  Progress progress;
  progress.pass = pass;
  progress.passes = passes_;
  progress.compiling = compiling;
  progress.fraction = std::min(done_ / total_, 1.0);
  progress.seconds = seconds();
  progress.seconds_left = progress.fraction > 0.01 ? progress.seconds * (1 / progress.fraction - 1) : -1;
  if (!control_.progress(progress)) throw Error(ErrorKind::cancelled, "cancelled; nothing was written");
}

}  // namespace rpf
