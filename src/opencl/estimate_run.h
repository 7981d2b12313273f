// The learned estimator on a device, for one window.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "opencl/estimate_steps.h"
#include "opencl/sample_stage.h"

namespace rpf {

class EstimateRun {
 public:
  /// Of rows first .. end - 1 of the window. `items`: work-items at once. Where `keep_all` is set, for trace().
  EstimateRun(Session& session, const NetworkProgram& program, const EstimateJob& job, int first, int end,
              std::size_t items, bool keep_all);

  /// The result, columns x .. x + width - 1 of the window's rows: [pixel][carried].
  std::vector<float> run(int x, int width, const EstimateProgress& progress);
  /// All stages (estimate_plan.h).
  std::vector<EstimateStage> trace();

 private:
  using Part = std::function<void(double share)>;

  void run_step(const EstimateStep& step, int first, int end, const Part& part);
  void run_layer(const EstimateStep& step, const DeviceLayer& layer, int first, int end);
  void run_halve(const EstimateStep& step, int first, int end);
  void run_embed(const EstimateStep& step, int first, int end);
  void run_weigh(const EstimateStep& step, int first, int end);
  void run_pass(const EstimateStep& step, int first, int end);
  void run_finish(const EstimateStep& step, int first, int end);
  /// Makes the picture in result_.
  void make(const EstimateProgress& progress);
  void abandon();
  template <typename... Values>
  void launch(cl::Kernel& kernel, const Values&... values);
  kernel::rpf_area area(const EstimateStep& step, int first, int end) const;
  const DeviceGrid& grid(int number) const { return grids_[static_cast<std::size_t>(number)]; }
  /// Without rows where there is none.
  const DeviceGrid& optional_grid(int number) const { return number < 0 ? no_grid_ : grid(number); }
  std::vector<float> values_of(int grid);
  EstimateStage stage(int grid, const std::string& name);
  EstimateStage head_stage();

  Session& session_;
  const NetworkProgram& program_;
  EstimateJob job_;
  std::size_t items_;
  SampleTrace sample_trace_;
  EstimateSteps steps_;
  std::vector<DeviceGrid> grids_;
  DeviceGrid no_grid_;
  SampleStage samples_;
  cl::Kernel halve_, embed_, weigh_pixels_, filter_pass_, finish_;
  int first_, end_;
  cl::Buffer result_;  ///< [pixel][carried], the host's memory while run() makes it
  kernel::rpf_region region_{};
};

}  // namespace rpf
