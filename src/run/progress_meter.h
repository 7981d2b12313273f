// How far a run is, how long it will take, and whether it shall stop.
#pragma once

#include <chrono>

#include "plan/plan.h"
#include "rpf/filter.h"

namespace rpf {

/// Pixels for one call of the backend: about half a second of work in this pass if all were as crowded as the most
/// crowded one, and more where that would be thousands of calls.
std::size_t tile_pixels(const PassPlan& pass, int threads);

class ProgressMeter {
 public:
  ProgressMeter(const Plan& plan, const Control& control);
  /// Of a learned estimate.
  explicit ProgressMeter(const Control& control) : control_(control), passes_(1), total_(1) {}

  /// Counts pixels of a pass as done and tells the caller. Throws Error(cancelled) where the caller wants to stop.
  void add(int pass, std::size_t pixels);
  /// Counts a part of a learned estimate, which is 1 as a whole.
  void add_part(double part);
  /// Only tells the caller again, in the middle of something long.
  void check() { tell(pass_); }
  /// The same while kernels are compiled.
  void check_compiling();
  double seconds() const;

 private:
  void tell(int pass, bool compiling = false);

  const Control& control_;
  int pass_ = 0, passes_ = 0;
  std::vector<double> pixel_cost_;  ///< [pass] relative
  double total_ = 0, done_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace rpf
