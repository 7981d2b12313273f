// The learned estimator's steps on a device: which rows are made and kept, and what must not matter.
#include "opencl/opencl.h"  // first: it configures the OpenCL header

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "conformance/random_network.h"
#include "frame/prepare.h"
#include "learned/observe.h"
#include "opencl/estimate_steps.h"
#include "opencl/opencl_backend.h"
#include "rpf/error.h"
#include "test_frames.h"

namespace rpf {
namespace {

EstimatePlan plan_of(const NetworkShape& shape, const Window& frame) {
  EstimatePlan plan;
  plan.network = random_network(1, shape);
  plan.width = frame.width;
  plan.height = frame.height;
  plan.has_albedo = true;
  return plan;
}

/// Goes through the steps with grids that only remember which row stands where.
class RowsOnly {
 public:
  RowsOnly(EstimateSteps& steps, const NetworkShape& network) : steps_(steps), network_(network) {}

  void run() {
    steps_.pipeline.run([&](int number, int first, int end) {
      const EstimateStep& step = steps_.steps[static_cast<std::size_t>(number)];
      for (int row = first; row < end; ++row) {
        for (const int grid : step.in) read(step, grid, row);
        for (const int grid : step.out) rows_[grid][place(grid, row)] = row;
      }
    });
  }

 private:
  int place(int grid, int row) const { return row % steps_.pipeline.rows(grid); }
  const EstimateGrid& grid(int number) const { return steps_.grids[static_cast<std::size_t>(number)]; }

  /// What the kernels read for a row.
  void read(const EstimateStep& step, int from, int row) {
    const int height = grid(from).height, own = grid(step.out.front()).height;
    if (step.kind == EstimateStep::Kind::halve) {
      for (int y = 2 * row; y < std::min(2 * row + 2, height); ++y) must_be_there(from, y);
    } else if (step.kind == EstimateStep::Kind::pass || step.kind == EstimateStep::Kind::weigh) {
      const int dilation = network_.dilation(step.number);
      const bool weighs = step.kind == EstimateStep::Kind::weigh, weighs_with = from != step.in.front();
      for (int j = weighs ? 0 : -2; j <= (weighs_with ? 0 : 2); ++j)
        if (row + j * dilation >= 0 && row + j * dilation < height) must_be_there(from, row + j * dilation);
    } else if (step.kind == EstimateStep::Kind::layer && step.number > 2) {
      const bool coarse = step.in.size() > 1 && from == step.in.front();
      for (int j = -1; j <= 1; ++j) must_be_there(from, std::clamp(row + j, 0, own - 1) >> (coarse ? 1 : 0));
    } else {
      must_be_there(from, row);
    }
  }

  void must_be_there(int from, int row) {
    const auto found = rows_[from].find(place(from, row));
    ASSERT_TRUE(found != rows_[from].end()) << grid(from).name << ": row " << row << " was never made";
    ASSERT_EQ(found->second, row) << grid(from).name << ": another row stands in its place";
  }

  EstimateSteps& steps_;
  const NetworkShape& network_;
  std::map<int, std::map<int, int>> rows_;  ///< [grid][place] -> row
};

TEST(EstimateSteps, FindEveryRowThatTheyRead) {
  const NetworkShape networks[] = {{8, {8}, 4},
                                   {8, {8, 8}, 4},
                                   {8, {8, 8, 8, 8}, 4},
                                   {8, {8, 8, 8, 8, 8, 8, 8}, 4},
                                   {8, {8, 8}, 4, {1}, {8, 8, 8}},
                                   {8, {8, 8, 8}, 4, {1, 8, 3, 5}, {1}}};
  for (const NetworkShape& shape : networks)
    for (const int height : {1, 2, 7, 64, 65, 301, 1080}) {
      const Window window{0, 0, 20, height};
      for (const int first : {0, height / 2, height - 1}) {
        for (const int row_samples : {0, 1}) {
          EstimateSteps steps(plan_of(shape, window), window, 20.0 * height, first, height, false, row_samples);
          ASSERT_EQ(steps.kept >= 0, row_samples > 0);
          RowsOnly(steps, shape).run();
          if (testing::Test::HasFailure()) FAIL() << shape.levels() << " levels, rows " << first << " to " << height;
        }
      }
    }
}

TEST(EstimateSteps, KeepNoMoreOfATallFrameThanOfAnother) {
  const auto bytes = [](int height) {
    const Window window{0, 0, 640, height};
    return EstimateSteps(plan_of({8, {8, 16, 24}, 4}, window), window, 640.0 * height, 0, height, false).bytes();
  };
  EXPECT_EQ(bytes(1080), bytes(100000));
  EXPECT_LT(bytes(1080), bytes(360) * 2);
}

TEST(EstimateSteps, KeepNothingOfSamplesWhereARowHasMostOfThemOrTheyAreTooMany) {
  const Window window{0, 0, 20, 300};
  const auto keeps = [&](double samples, int row_samples) {
    return EstimateSteps(plan_of({8, {8, 8}, 4}, window), window, samples, 0, 300, false, row_samples).kept >= 0;
  };
  EXPECT_TRUE(keeps(300 * 80, 80));
  EXPECT_FALSE(keeps(300 * 80, 20000));
  EXPECT_FALSE(keeps(3e8, 1000000));
}

TEST(EstimateSteps, DoNotMakeWhatACropDoesNotNeed) {
  const Window window{0, 0, 20, 1000};
  EstimateSteps whole(plan_of({8, {8, 8}, 4}, window), window, 20000, 0, 1000, false);
  EstimateSteps part(plan_of({8, {8, 8}, 4}, window), window, 20000, 500, 501, false);
  EXPECT_LT(part.work(), 0.2 * whole.work());
}

/// A frame on a device.
class DeviceEstimate {
 public:
  DeviceEstimate(const OpenClOptions& options, const std::vector<int>& channels)
      : observed_(observe(test::every_input({37, 29, 0, 1}), settings(), random_network(3, {12, channels, 5}))),
        device_(options) {
    device_.load_estimate(observed_.prepared.frame, observed_.plan);
  }

  std::vector<float> run(const EstimateProgress& progress) {
    return device_.estimate(observed_.prepared.facts.crop, progress);
  }

 private:
  static Settings settings() {
    Settings s;
    s.method = Method::learned;
    return s;
  }

  Observed observed_;
  OpenClBackend device_;
};

TEST(DeviceEstimate, HasTheSameBitsHoweverLayersAreCutForRegisters) {
  const auto silent = [](double /*part*/) {};
  OpenClOptions narrow, wide;
  narrow.blocking = Blocking{8, 16};
  wide.blocking = Blocking{16, 32};
  const std::vector<int> channels = {8, 32, 72};
  const std::vector<float> expected = DeviceEstimate(narrow, channels).run(silent);
  EXPECT_EQ(DeviceEstimate(wide, channels).run(silent), expected);
  wide.threads = 5;
  EXPECT_EQ(DeviceEstimate(wide, channels).run(silent), expected);
}

TEST(DeviceEstimate, TellsItsProgressAndCanBeStopped) {
  DeviceEstimate estimate({}, {8, 8});
  double sum = 0;
  estimate.run([&](double part) { sum += part; });
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_THROW(estimate.run([](double /*part*/) { throw Error(ErrorKind::cancelled, "enough"); }), Error);
}

}  // namespace
}  // namespace rpf
