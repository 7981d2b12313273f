// Spreading spikes, on small frames by hand.
#include "after/spikes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "after/resolve.h"
#include "rpf/filter.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

/// A frame with so many samples in each pixel, and c' that is `color` in R, G and B of all of them.
struct SpikeFrame {
  Frame frame;
  std::vector<float> colors;
  std::size_t carried = 3;

  SpikeFrame(int width, int height, const std::vector<std::uint32_t>& samples, float color, std::size_t carried_ = 3)
      : carried(carried_) {
    frame.width = width;
    frame.height = height;
    frame.first_sample = {0};
    for (const std::uint32_t n : samples) frame.first_sample.push_back(frame.first_sample.back() + n);
    colors.assign(frame.sample_count() * carried, color);
  }

  std::vector<float> pixels() const { return resolve(frame, colors, carried); }
  void set(std::size_t pixel, const std::vector<float>& color) {
    for (std::size_t i = frame.first_sample[pixel]; i < frame.first_sample[pixel + 1]; ++i)
      std::copy(color.begin(), color.end(), colors.begin() + static_cast<std::ptrdiff_t>(i * carried));
  }
  void spread() { spread_spikes(frame, carried, colors); }
};

std::vector<std::uint32_t> all(std::size_t pixels, std::uint32_t samples) { return {std::vector(pixels, samples)}; }

double energy(const std::vector<float>& pixels) {
  double sum = 0;
  for (const float value : pixels) sum += value;
  return sum;
}

TEST(Spikes, ShareTheirExcessWithTheSquareAroundThem) {
  SpikeFrame f(9, 7, all(63, 2), 1);
  f.set(3 * 9 + 4, {26, 51, 1});  // 78 in place of 3: keeps 1/26 of (26, 51, 1)
  f.spread();
  const std::vector<float> pixels = f.pixels();
  const float share = (1 - 1.0F / 26) / 25;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 9; ++x) {
      const bool near = std::abs(x - 4) <= 2 && std::abs(y - 3) <= 2, center = x == 4 && y == 3;
      const float spike[] = {26, 51, 1};
      for (int c = 0; c < 3; ++c) {
        const float expected = (center ? spike[c] / 26 : 1) + (near ? share * spike[c] : 0);
        EXPECT_NEAR(pixels[static_cast<std::size_t>((y * 9 + x) * 3 + c)], expected,
                    test::tolerance::formula * expected)
            << x << "," << y << " " << c;
      }
    }
  EXPECT_NEAR(energy(pixels), 63 * 3 + 75, test::tolerance::pixel_mean * 264);
}

TEST(Spikes, AreFoundBeforeAnyIsSpread) {
  SpikeFrame f(6, 1, all(6, 1), 0);
  const auto gray = [](float value) { return std::vector<float>(3, value); };
  f.set(0, gray(4));
  f.set(1, gray(1));
  f.set(2, gray(9));
  f.set(3, gray(3));
  // Pixel 0 keeps 1 and spreads 3 over three pixels, pixel 2 keeps 3 and spreads 6 over five.
  f.spread();
  const std::vector<float> expected = {3.2F, 3.2F, 5.2F, 4.2F, 1.2F, 0};
  const std::vector<float> pixels = f.pixels();
  for (std::size_t p = 0; p < expected.size(); ++p)
    EXPECT_NEAR(pixels[3 * p], expected[p], test::tolerance::formula * 9) << p;
}

TEST(Spikes, LeaveOutEmptyPixelsAndRespectCountsAndWeights) {
  SpikeFrame f(3, 1, {2, 0, 3}, 1);
  f.set(2, {5, 5, 5});
  f.spread();  // its only neighbor is empty
  EXPECT_EQ(f.pixels(), (std::vector<float>{1, 1, 1, 0, 0, 0, 5, 5, 5}));

  SpikeFrame g(3, 1, {2, 1, 3}, 1, 4);
  g.set(2, {5, 5, 5, 0.5F});
  g.frame.weights = {1, 3, 1, 0, 2, 1};
  g.colors[3 * 4] = 1000;  // a sample without weight: the mean is 5 without it
  g.spread();              // 4 are spread over three pixels
  const std::vector<float> pixels = g.pixels();
  const float third = 4.0F / 3;
  for (std::size_t p = 0; p < 3; ++p) EXPECT_NEAR(pixels[4 * p], 1 + third, test::tolerance::formula * 5) << p;
  EXPECT_EQ(pixels[3], 1.0F);  // alpha is not light
  EXPECT_EQ(pixels[11], 0.5F);
}

TEST(Spikes, AreNotInAFlatNorInADarkImageNorAlone) {
  for (const float color : {0.3F, 0.0F, -2.0F}) {
    SpikeFrame f(5, 4, all(20, 3), color);
    const std::vector<float> before = f.colors;
    f.spread();
    EXPECT_EQ(f.colors, before);
  }
  SpikeFrame one(1, 1, {2}, 7);
  one.spread();
  EXPECT_EQ(one.pixels(), (std::vector<float>{7, 7, 7}));
  SpikeFrame negative(3, 1, all(3, 1), -1);
  negative.set(1, {-0.5F, -0.5F, -0.5F});  // brighter than its neighbors, but no light
  negative.spread();
  EXPECT_EQ(negative.pixels()[3], -0.5F);
}

TEST(Spikes, LoseAllTheirLightAmongNegativeNeighborsNotMore) {
  SpikeFrame f(3, 1, all(3, 1), -1);
  f.set(1, {6, 6, 6});
  f.spread();
  EXPECT_EQ(f.pixels(), (std::vector<float>{1, 1, 1, 2, 2, 2, 1, 1, 1}));
}

}  // namespace
}  // namespace rpf
