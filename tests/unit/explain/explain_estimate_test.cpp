// explain_estimate(): the shares that it tells are those that the picture was made with. In a suite EveryMethod*, which
// runs on both backends.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rpf/error.h"
#include "rpf/explain.h"
#include "temporary_folder.h"
#include "test_frames.h"
#include "test_networks.h"
#include "tolerances.h"

namespace rpf {
namespace {

class EveryMethodExplained : public testing::Test {
 protected:
  Settings with_network(std::uint32_t seed) {
    test::NetworkOptions options;
    options.seed = seed;
    Settings settings;
    settings.backend = test::backend_under_test();
    settings.method = Method::learned;
    settings.model = test::write_network(test::random_network(options), folder_.file("random.rpfnet"));
    return settings;
  }

  TemporaryFolder folder_;
};

SampleBuffer frame(std::uint32_t seed, int samples) {
  test::FrameOptions options;
  options.width = 41;
  options.height = 37;
  options.samples = samples;
  options.seed = seed;
  return test::every_input(options);
}

/// What the shares make of the samples' colors.
std::array<double, 3> remade(const ExplainedEstimate& explained) {
  std::array<double, 3> color{};
  for (const Contribution& sample : explained.samples)
    for (std::size_t c = 0; c < 3; ++c)
      color.at(c) += static_cast<double>(sample.share) * sample.color.at(c) * explained.factor.at(c);
  return color;
}

void expect_same_color(const ExplainedEstimate& explained, const SampleBuffer& samples, const Settings& settings) {
  const Image picture = filter(samples, settings).image;
  const Window& w = picture.data_window;
  const float* pixel =
      picture.pixel(static_cast<std::size_t>(explained.position.y - w.y) * w.width + explained.position.x - w.x);
  const std::array<double, 3> color = remade(explained);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_FLOAT_EQ(explained.result.at(c), pixel[c]);
    EXPECT_NEAR(color.at(c), pixel[c], test::tolerance::remade_pixel * std::abs(pixel[c])) << "channel " << c;
  }
}

TEST_F(EveryMethodExplained, ExplainedSharesMakeThePixelOfThePicture) {
  for (const std::uint32_t seed : {1U, 2U, 3U})
    for (const int samples : {4, 0, 90}) {  // 0: varying; of many the own mean is a part
      const SampleBuffer buffer = frame(seed, samples);
      const Settings settings = with_network(seed);
      for (const PixelPosition& at : {PixelPosition{20, 18}, {0, 0}, {40, 36}, {3, 30}}) {
        const auto number = static_cast<std::size_t>(at.y * buffer.data_window.width + at.x);
        if (buffer.first_sample[number] == buffer.first_sample[number + 1]) continue;
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", pixel " << at.x << "," << at.y);
        const ExplainedEstimate explained = explain_estimate(buffer, settings, at);
        expect_same_color(explained, buffer, settings);
        double all = 0, of_samples = 0;
        for (const float share : explained.shares) all += share;
        for (const Contribution& sample : explained.samples) of_samples += sample.share;
        EXPECT_NEAR(all, 1, test::tolerance::remade_pixel);
        EXPECT_NEAR(of_samples, 1, test::tolerance::remade_pixel);
      }
    }
}

TEST_F(EveryMethodExplained, ExplainedSharesReachNoFurtherThanThePasses) {
  const ExplainedEstimate explained = explain_estimate(frame(1, 4), with_network(1), {39, 2});
  EXPECT_EQ(explained.window.x, 9);  // 2 (8 + 4 + 2 + 1) pixels to the left
  EXPECT_EQ(explained.window.width, 32);
  EXPECT_EQ(explained.window.y, 0);
  EXPECT_EQ(explained.window.height, 33);
  EXPECT_GE(explained.effective_samples, 1);
  for (const Contribution& sample : explained.samples) EXPECT_GE(sample.pixel.x, 9);
}

TEST_F(EveryMethodExplained, ExplainedEstimateRefusesWhatIsNoNetwork) {
  Settings settings = with_network(1);
  settings.method = Method::rpf;
  EXPECT_THROW(explain_estimate(frame(1, 4), settings, {1, 1}), Error);
  EXPECT_THROW(explain_estimate(frame(1, 4), with_network(1), {41, 1}), Error);
}

}  // namespace
}  // namespace rpf
