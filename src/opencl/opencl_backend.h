// The OpenCL backend: the kernels of kernels/filter.cl or kernels/box.cl, band by band. The same bits as the reference.
#pragma once

#include <memory>
#include <optional>

#include "opencl/band.h"
#include "opencl/network_program.h"
#include "opencl/scratch.h"
#include "opencl/session.h"
#include "seam/backend.h"

namespace rpf {

/// How a device is used; the defaults are for users, the rest for tests and benchmarks.
struct OpenClOptions {
  std::string device;                     ///< index or part of a name; empty: the first
  int threads = 1;                        ///< compute units to keep busy, on a device that is a CPU
  std::uint64_t band_bytes = 0;           ///< most bytes of a band; 0: what the device has
  std::optional<Blocking> blocking = {};  ///< of the learned estimator's layers; by default what is best for the device
  std::uint64_t weights_at_once = std::uint64_t{1} << 28;  ///< own samples times neighbors in one launch, about
  int phases = 0;  ///< only the first phases of a pixel: draw, gather, prepare, information, weights; 0: all
};

class OpenClBackend : public Backend {
 public:
  /// Throws Error(device) where the device is missing or does not keep the numeric contract.
  explicit OpenClBackend(const OpenClOptions& options);

  std::string description() const override;
  void get_ready(const Frame& frame, const Plan& plan, const std::function<void()>& check) override;
  void load(const Frame& frame, std::vector<float> colors, const Plan& plan) override;
  void run(int pass, const Window& tile) override;
  void end_pass() override;
  const std::vector<float>& colors() const override { return colors_; }
  std::vector<float> take_colors() override { return std::move(colors_); }
  const std::vector<PixelStatistics>& statistics() const override { return statistics_; }
  const std::vector<float>& explained() const override { return explained_; }
  std::uint64_t scratch_bytes(const Plan& plan, std::uint64_t samples) const override;
  PixelTrace trace(int pass, std::uint32_t pixel) override;
  std::uint64_t trace_bytes(std::uint64_t own, std::uint64_t neighbors) const override {
    return 3 * sizeof(float) * own * neighbors;  // on the device, as they are read, and in the trace
  }
  void get_ready_estimate(const EstimatePlan& plan, const std::function<void()>& check) override;
  void load_estimate(const Frame& frame, const EstimatePlan& plan) override;
  std::vector<float> estimate(const Window& region, const EstimateProgress& progress) override;
  std::vector<EstimateStage> trace_estimate(const Window& region) override;
  std::uint64_t estimate_bytes(const EstimatePlan& plan, const Window& window, std::uint64_t samples) const override;
  void get_ready_steps(const std::function<void()>& check) override;
  std::vector<float> run_steps(const PixelPlan& plan, std::vector<float> planes,
                               const EstimateProgress& progress) override;
  std::uint64_t step_bytes(const PixelPlan& plan) const override;
  void get_ready_views(const std::function<void()>& check) override;
  std::vector<float> see_views(const LightField& light, const EstimateProgress& progress) override;
  void get_ready_columns(const std::function<void()>& check) override;
  std::vector<float> integrate_columns(const PixelColumns& columns, const EstimateProgress& progress) override;

 private:
  /// What stays on the device for a pass: the plan's tables, or the coordinates of fixed weights.
  struct PassTables {
    cl::Buffer offsets, draws, entropy;
    cl::Buffer variables, scales;
  };

  /// A program of kernels/, and what is compiled into it.
  struct KernelProgram {
    std::string file, definitions;
  };

  KernelProgram program_for(const Frame& frame, const Plan& plan) const;

  /// What a launch writes. Without a trace its buffers are null.
  struct Results {
    cl::Buffer next_colors, statistics, explained, trace_values, trace_histograms;
  };

  const PassTables& tables(int pass);
  BandLimit device_limit() const;  ///< what a band may take at most
  BandLimit band_limit() const;    ///< what it shall take at most where it can be smaller
  const Band& band_for(int pass, const Rows& needed);
  bool has_fixed_weights() const { return plan_->method != Method::rpf; }  ///< box.cl in place of filter.cl
  void lay_out(const Band& band);
  /// The arguments of filter_tile or filter_box, without the last one.
  std::vector<cl::Buffer> buffers(int pass, const Band& band, const Results& results);
  kernel::rpf_pass arguments(int pass, const Window& tile, const Band& band) const;
  std::size_t explained_floats(const Window& tile) const;
  /// What the pixels of a tile are explained in, zeros; null where the plan does not ask for it.
  cl::Buffer explanation_buffer(const Window& tile);
  void launch(const kernel::rpf_pass& arguments, const Band& band, std::size_t items, const Results& results);
  /// The same in launches that are not too long, for a tile that the band holds.
  void launch_pieces(int pass, const Window& tile, const Band& band);
  void launch_piece(int pass, const Window& piece, const Band& band);
  /// Some pixels of which one has too many weights for one launch: an item each.
  void launch_long_pixels(int pass, const Window& piece, const Band& band, const Results& results);
  /// What launch_piece() explained goes to its place in the tile.
  void keep_explained(const Window& piece, const cl::Buffer& explained);
  /// run() of a tile or, where it reads more rows than the device can hold, of its halves.
  void run_part(int pass, const Window& tile);
  void run_halves(int pass, const Window& tile);
  /// Makes what a launch wrote for a tile visible in next_colors_ and statistics_.
  void collect(const Window& tile, const Band& band);

  Session& session_;
  std::uint64_t band_bytes_, weights_at_once_;
  std::string phases_;  ///< definition for kernels/filter.cl
  std::size_t items_;   ///< work-items that run at once
  const Frame* frame_ = nullptr;
  const Plan* plan_ = nullptr;
  const EstimatePlan* estimate_plan_ = nullptr;
  const EstimatePlan* ready_for_ = nullptr;  ///< that network_ was made for, and is yet to be loaded
  std::optional<Blocking> blocking_;
  std::unique_ptr<NetworkProgram> network_;
  std::vector<float> colors_, next_colors_;  ///< c' and c'': [sample][carried]
  std::vector<PixelStatistics> statistics_;  ///< [pixel]
  Window tile_;                              ///< of the latest run()
  std::vector<float> explained_;             ///< [pixel of the tile][pairs + 1]

  cl::Kernel kernel_, layout_kernel_;
  cl::Buffer rejection_factor_, minimum_tolerance_, centers_;
  std::vector<PassTables> tables_;  ///< of the passes so far
  std::unique_ptr<Scratch> scratch_;
  std::unique_ptr<Band> band_;  ///< last: it refers to the colors
};

}  // namespace rpf
