// The seam: what the driver asks of a backend. Coarse enough for a device, small enough to read.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "frame/frame.h"
#include "learned/estimate_plan.h"
#include "pass.h"
#include "plan/light_field.h"
#include "plan/pixel_columns.h"
#include "plan/pixel_plan.h"
#include "plan/plan.h"
#include "seam/trace.h"

namespace rpf {

/// What the filter found at a pixel in the latest pass.
using PixelStatistics = kernel::rpf_pixel_statistics;

class Backend {
 public:
  virtual ~Backend() = default;

  /// Its name, with the device it runs on, for example "opencl (pthread-skylake-avx512)".
  virtual std::string description() const = 0;
  /// Gets ready what the plan needs, such as compiled kernels, without taking anything; load() does it where nobody
  /// did. Throws Error(device) where that fails, and what `check` throws, which is called now and then.
  virtual void get_ready(const Frame& /*frame*/, const Plan& /*plan*/, const std::function<void()>& /*check*/) {}
  /// Called once, before anything else. Frame and plan outlive the backend; `colors` is c' of the first pass,
  /// [sample][carried].
  virtual void load(const Frame& frame, std::vector<float> colors, const Plan& plan) = 0;
  /// Calls `check` while run() and trace() work, on the thread that called them, several times a second however long a
  /// pixel takes; what it throws ends them.
  void watch(std::function<void()> check) { check_ = std::move(check); }
  /// Filters the pixels of a tile (frame coordinates, inside the pass's region). Tiles of a pass do not overlap.
  virtual void run(int pass, const Window& tile) = 0;
  /// Ends a pass: its result becomes the input c' of the next.
  virtual void end_pass() = 0;
  /// The samples' colors as after the latest ended pass, scaled radiance: [sample][carried].
  virtual const std::vector<float>& colors() const = 0;
  /// The same, given away: nothing can be run after it.
  virtual std::vector<float> take_colors() = 0;
  /// [pixel], of the latest pass run.
  virtual const std::vector<PixelStatistics>& statistics() const = 0;
  /// Of the latest tile run where Plan::explain asks for it: for every pixel, row by row, the mutual information of all
  /// pairs (in the order of PixelTrace::mutual_information), then rpf_effective_samples(). 0 where there are no
  /// samples.
  virtual const std::vector<float>& explained() const = 0;
  /// Peak bytes of the backend's own memory beside frame and result, for a frame of so many samples.
  virtual std::uint64_t scratch_bytes(const Plan& plan, std::uint64_t samples) const = 0;
  /// All intermediate values of one pixel, from the state before end_pass(). Changes nothing.
  virtual PixelTrace trace(int pass, std::uint32_t pixel) = 0;
  /// Peak bytes of the weights in trace(), of a pixel with so many own samples and so many neighbors.
  virtual std::uint64_t trace_bytes(std::uint64_t own, std::uint64_t neighbors) const = 0;

  // The learned estimator, in place of all of the above.

  /// get_ready() for a plan that will be loaded.
  virtual void get_ready_estimate(const EstimatePlan& /*plan*/, const std::function<void()>& /*check*/) {}
  /// Called once, before all but that. Frame and plan outlive the backend, which calls Frame::bring() before it reads
  /// samples.
  virtual void load_estimate(const Frame& frame, const EstimatePlan& plan) = 0;
  /// The result of a region (frame coordinates): [pixel of the region, row by row][carried], scaled radiance.
  virtual std::vector<float> estimate(const Window& region, const EstimateProgress& progress) = 0;
  /// All stages of the same.
  virtual std::vector<EstimateStage> trace_estimate(const Window& region) = 0;
  /// Peak bytes of the backend's own memory in estimate(), of a window (window_around()) with so many samples.
  virtual std::uint64_t estimate_bytes(const EstimatePlan& plan, const Window& window, std::uint64_t samples) const = 0;

  // A method that filters pixels, in place of all of the above.

  /// run_steps() compiles nothing afterwards; `check` is called now and then. Throws Error(device).
  virtual void get_ready_steps(const std::function<void()>& /*check*/) {}
  /// All planes after the plan's steps, [plane][pixel]; `planes` are the plan's inputs. Calls `progress` between
  /// bounded pieces of work with the part of the whole that each was.
  virtual std::vector<float> run_steps(const PixelPlan& plan, std::vector<float> planes,
                                       const EstimateProgress& progress) = 0;
  /// Bytes that run_steps() takes beside the planes.
  virtual std::uint64_t step_bytes(const PixelPlan& plan) const = 0;

  // The light field, in place of all of the above.

  /// see_views() compiles nothing afterwards; `check` is called now and then. Throws Error(device).
  virtual void get_ready_views(const std::function<void()>& /*check*/) {}
  /// What all views see, LightField::sums(): [carried][pixel] the sum of how far it is off from the pixel's mean, then
  /// [pixel] the number of views that see something. Calls `progress` as run_steps() does.
  virtual std::vector<float> see_views(const LightField& light, const EstimateProgress& progress) = 0;

  // Columns of pixels in the space of the samples, in place of all of the above.

  /// integrate_columns() compiles nothing afterwards; `check` is called now and then. Throws Error(device).
  virtual void get_ready_columns(const std::function<void()>& /*check*/) {}
  /// What all points take, PixelColumns::sums(), as see_views() has it.
  virtual std::vector<float> integrate_columns(const PixelColumns& columns, const EstimateProgress& progress) = 0;

 protected:
  std::function<void()> check_;  ///< empty: nobody watches
};

}  // namespace rpf
