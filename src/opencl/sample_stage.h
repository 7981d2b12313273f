// What the learned estimator does with samples: seeing them, and summing them up once their weights are known.
#pragma once

#include <functional>
#include <vector>

#include "frame/frame.h"
#include "network_launch.h"
#include "opencl/network_program.h"

namespace rpf {

/// Rows of a grid on the device.
struct DeviceGrid {
  cl::Buffer buffer;
  kernel::rpf_grid rows{};
  int stored = 0;  ///< floats a cell, or planes
};

/// What a backend was given to estimate.
struct EstimateJob {
  const Frame& frame;
  const EstimatePlan& plan;
  Window window;
};

/// Values of the window's samples, where all stages are kept.
struct SampleTrace {
  std::vector<float> inputs, sample1, sample2, weights;
};

/// Goes through the samples of some rows.
class SampleStage {
 public:
  using Progress = std::function<void(double share)>;  ///< shares of the rows sum to 1

  /// `trace` may be null.
  SampleStage(Session& session, const NetworkProgram& program, const EstimateJob& job, std::size_t items,
              SampleTrace* trace);

  /// What see() makes of the pixels of some rows.
  struct SeenGrids {
    const DeviceGrid &enter, &guides, &albedo;
    const DeviceGrid& kept;   ///< what sum() will need of their samples
    const DeviceGrid& pixel;  ///< what the first layer reads; both without rows where nobody wants them
  };
  void see(const kernel::rpf_area& rows, const SeenGrids& out, const Progress& progress);
  /// Sums of their weighted samples, from what the head says before the passes.
  void sum(const kernel::rpf_area& rows, const DeviceGrid& heads, const DeviceGrid& kept, const DeviceGrid& sums,
           const Progress& progress);

 private:
  /// Rows, and what there is of the frame for them.
  struct Rows {
    kernel::rpf_samples launch;
    cl::Buffer records, others, weights, first_sample;
  };
  using Launch = std::function<void(const Rows&)>;

  /// Of a pixel of the window; those behind it follow.
  const std::uint32_t& first_sample(int row, int column) const;
  /// Rows area.first .. area.end - 1 of the window, whose samples are there.
  Rows rows_of(const kernel::rpf_area& area) const;
  /// Has the samples of rows first .. end - 1 of the window be there, or of the first of these: Frame::bring().
  int bring(int first, int end, bool again);
  /// Launches that together take all parts of the rows. `again`: whether the samples will be asked for once more.
  void for_launches(const kernel::rpf_area& rows, bool again, const Progress& progress, const Launch& launch);
  /// The end of the parts from `first` on that are one launch.
  int end_of_launch(const kernel::rpf_area& area, int first) const;
  std::uint32_t samples_in(const kernel::rpf_area& area, int part) const;
  kernel::rpf_area in_parts(kernel::rpf_area rows) const;
  /// A kernel that begins with what is computed of samples, and their features.
  template <typename... More>
  void launch_on_samples(cl::Kernel& kernel, const Rows& rows, const More&... more);
  /// Floats of a sample that see() tells of it, where all stages are kept.
  std::size_t traced_floats() const;
  void keep_seen(const Rows& rows, const cl::Buffer& trace);
  cl::Buffer trace_of(const Rows& rows, std::size_t floats) const;

  Session& session_;
  const NetworkProgram& program_;
  EstimateJob job_;
  std::size_t items_;
  SampleTrace* trace_;
  cl::Kernel see_, sum_;
  std::vector<int> columns_;  ///< of the inputs from the seventh live one on
  cl::Buffer columns_buffer_, guide_columns_, base_columns_;
};

}  // namespace rpf
