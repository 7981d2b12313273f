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
  kernel::rpf_grid rows;
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

/// Goes through the samples of some rows in chunks that stay in the processor's caches.
class SampleStage {
 public:
  using Progress = std::function<void(double share)>;  ///< shares of the rows sum to 1

  /// `trace` may be null.
  SampleStage(Session& session, const NetworkProgram& program, const EstimateJob& job, std::size_t items,
              SampleTrace* trace);

  /// Values, guides and albedo of the pixels of rows first .. end - 1 of the window.
  void see(int first, int end, const DeviceGrid& pixel, const DeviceGrid& guides, const DeviceGrid& albedo,
           const Progress& progress);
  /// Sums of their weighted samples, from what the head says before the passes.
  void sum(int first, int end, const DeviceGrid& heads, const DeviceGrid& sums, const Progress& progress);

  /// Bytes on the device beside the frame.
  static std::uint64_t bytes(const Network& network);

 private:
  /// Some pixels, and what there is of the frame for them.
  struct Chunk {
    kernel::rpf_chunk launch;
    std::size_t samples;
    cl::Buffer records, others, weights, first_sample;
  };

  std::uint32_t samples(int pixel) const;
  /// The end of the chunk that begins with a pixel: its samples lie side by side in the frame.
  int end_of_chunk(int first, int end) const;
  Chunk chunk(int first, int end) const;
  /// Has the samples of rows first .. end - 1 of the window be there, or of the first of these: Frame::bring().
  int bring(int first, int end, bool again);
  /// `again`: whether the samples will be asked for once more.
  void for_chunks(int first, int end, bool again, const Progress& progress,
                  const std::function<void(const Chunk&)>& body);
  void reserve(std::size_t samples);
  kernel::rpf_layer rows_of_samples(const DeviceLayer& layer, std::size_t samples) const;
  /// A kernel that begins with what is computed of a chunk's samples, and their features.
  template <typename... More>
  void launch_on_samples(cl::Kernel& kernel, const Chunk& chunk, const More&... more);
  template <typename... Values>
  void launch(cl::Kernel& kernel, const Values&... values);
  void keep(std::vector<float>& to, const cl::Buffer& from, std::size_t samples, int stride, int values);
  void keep_seen(const Chunk& chunk);

  Session& session_;
  const NetworkProgram& program_;
  EstimateJob job_;
  std::size_t items_;
  SampleTrace* trace_;
  cl::Kernel see_samples_, see_pixels_, weigh_samples_, sum_samples_;
  std::vector<int> columns_;  ///< of the inputs from the seventh live one on
  cl::Buffer columns_buffer_, guide_columns_, base_columns_;
  std::size_t capacity_ = 0;  ///< samples that the following have room for
  cl::Buffer seen_, hidden_, features_, weighed_, weights_;
};

}  // namespace rpf
