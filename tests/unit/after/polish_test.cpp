// The polish by hand, and against its definition in double precision.
#include "after/polish.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

constexpr float missing = std::numeric_limits<float>::quiet_NaN();

/// A frame with features N.X, P.X and albedo.G, and its pixels.
struct PolishFrame {
  Frame frame;
  Plan plan;
  std::vector<float> pixels;

  PolishFrame(int width, int height, const std::vector<std::uint32_t>& samples, std::size_t carried = 3) {
    frame.width = plan.width = width;
    frame.height = plan.height = height;
    plan.variables.feature_names = {"N.X", "P.X", "albedo.G"};
    plan.carried = carried;
    plan.polish = 1;
    plan.polished = {0, 0, width, height};
    frame.first_sample = {0};
    for (const std::uint32_t n : samples) frame.first_sample.push_back(frame.first_sample.back() + n);
    frame.variables = plan.variables.count();
    frame.records.assign(frame.sample_count() * frame.variables, 0.0F);
    pixels.assign(samples.size() * carried, 0.0F);
  }

  float& feature(std::size_t sample, std::size_t k) {
    return frame.records[sample * frame.variables + plan.variables.features() + k];
  }
  void set(std::size_t pixel, float value) {
    std::fill_n(pixels.begin() + static_cast<std::ptrdiff_t>(pixel * plan.carried), plan.carried, value);
  }
  std::vector<float> polished(float floor, int threads = 1) const {
    std::vector<float> result = pixels;
    polish(frame, plan, {floor, threads, {}}, result);
    return result;
  }
};

std::vector<std::uint32_t> all(std::size_t pixels, std::uint32_t samples) { return {std::vector(pixels, samples)}; }

/// A frame of noise with everything in it: counts from 0 to 4, missing values, a step in each feature, alpha.
PolishFrame noise(int width, int height) {
  test::Dice dice(5);
  std::vector<std::uint32_t> counts;
  for (int p = 0; p < width * height; ++p) counts.push_back(static_cast<std::uint32_t>(dice() * 5));
  PolishFrame f(width, height, counts, 4);
  for (std::size_t p = 0; p < counts.size(); ++p) {
    const float side = p % static_cast<std::size_t>(width) > 8 ? 1.0F : 0.0F;
    for (std::size_t i = f.frame.first_sample[p]; i < f.frame.first_sample[p + 1]; ++i)
      for (std::size_t k = 0; k < 3; ++k) f.feature(i, k) = dice() < 0.2F ? missing : side + 0.5F * dice();
    for (std::size_t c = 0; c < 4; ++c) f.pixels[4 * p + c] = 1 + side + 0.5F * dice() - (c == 2 ? 1.25F : 0.0F);
  }
  f.plan.polish = 0.4F;
  return f;
}

/// The definition in polish.h, word by word.
class Definition {
 public:
  Definition(const PolishFrame& f, double floor) : f_(f), floor_(floor) {}

  double value(int x, int y, std::size_t channel) const {
    double sum = 0, weights = 0;
    for (int v = y - 3; v <= y + 3; ++v)
      for (int u = x - 3; u <= x + 3; ++u) {
        if (!takes_part(u, v)) continue;
        const double w = std::exp(-std::max({color_distance(x, y, u, v), feature_distance(x, y, u, v), 0.0}));
        sum += w * color(u, v, channel);
        weights += w;
      }
    return sum / weights;
  }

 private:
  std::size_t pixel(int x, int y) const { return static_cast<std::size_t>(y) * f_.frame.width + x; }
  bool takes_part(int x, int y) const {
    return x >= 0 && y >= 0 && x < f_.frame.width && y < f_.frame.height && f_.frame.samples(pixel(x, y)) > 0;
  }
  double color(int x, int y, std::size_t c) const { return f_.pixels[pixel(x, y) * f_.plan.carried + c]; }

  double color_distance(int x, int y, int u, int v) const {
    double sum = 0, count = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (!takes_part(x + dx, y + dy) || !takes_part(u + dx, v + dy)) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          const double p = color(x + dx, y + dy, c), q = color(u + dx, v + dy, c);
          sum += std::pow((p - q) / ((std::abs(p) + std::abs(q)) / 2 + floor_), 2);
          ++count;
        }
      }
    return sum / count / (2 * std::pow(f_.plan.polish, 2));
  }

  struct Moments {
    double mean = 0, variance = 0;
  };
  std::optional<Moments> moments(std::size_t p, std::size_t k) const {
    std::vector<double> values;
    for (std::size_t i = f_.frame.first_sample[p]; i < f_.frame.first_sample[p + 1]; ++i)
      if (const float value = f_.frame.record(i)[5 + k]; !std::isnan(value)) values.push_back(value);
    if (values.empty()) return std::nullopt;
    const auto n = static_cast<double>(values.size());
    Moments m;
    for (const double value : values) m.mean += value / n;
    for (const double value : values)
      if (n > 1) m.variance += std::pow(value - m.mean, 2) / (n - 1) / n;
    return m;
  }
  double feature_distance(int x, int y, int u, int v) const {
    double largest = 0;
    for (const std::size_t k : {0, 2}) {  // P does not guard
      const auto p = moments(pixel(x, y), k), q = moments(pixel(u, v), k);
      if (!p || !q) continue;
      const double variance = p->variance + q->variance;
      largest = std::max(largest, (std::pow(p->mean - q->mean, 2) - variance) / (1e-3 + variance));
    }
    return largest;
  }

  const PolishFrame& f_;
  double floor_;
};

TEST(Polish, AveragesTwoPixelsByHand) {
  PolishFrame f(2, 1, all(2, 1));
  f.set(0, 1);
  f.set(1, 2);
  // Relative difference 1 / (1.5 + 0.5), H = 1: the weight is exp(-0.25 / 2).
  const std::vector<float> pixels = f.polished(0.5F);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(pixels[c], 1.46879063, test::tolerance::formula);
    EXPECT_NEAR(pixels[3 + c], 1.53120937, test::tolerance::formula);
  }
}

TEST(Polish, IsItsDefinition) {
  const PolishFrame f = noise(270, 19);  // wider and higher than a tile
  const double floor = 0.0625;
  const std::vector<float> pixels = f.polished(static_cast<float>(floor));
  EXPECT_EQ(f.polished(static_cast<float>(floor), 3), pixels);
  const Definition definition(f, floor);
  for (int y = 0; y < 19; ++y)
    for (int x = 0; x < 270; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * 270 + x;
      for (std::size_t c = 0; c < 4; ++c) {
        const double expected = f.frame.samples(pixel) > 0 ? definition.value(x, y, c) : f.pixels[4 * pixel + c];
        ASSERT_NEAR(pixels[4 * pixel + c], expected, test::tolerance::polish * 2.5) << x << "," << y << " " << c;
      }
    }
}

TEST(Polish, ChangesOnlyTheWantedPixels) {
  PolishFrame f = noise(40, 30);
  const std::vector<float> whole = f.polished(0.1F);
  f.plan.polished = {7, 11, 20, 9};
  const std::vector<float> part = f.polished(0.1F);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const std::size_t x = i / 4 % 40, y = i / 160;
    const bool wanted = x >= 7 && x < 27 && y >= 11 && y < 20;
    ASSERT_EQ(part[i], wanted ? whole[i] : f.pixels[i]) << x << "," << y;
  }
}

TEST(Polish, KeepsAnEdgeThatAGuideShowsAndNoOther) {
  for (const std::size_t k : {0, 1, 2}) {  // N.X, P.X, albedo.G
    PolishFrame f(12, 5, all(60, 2));
    for (std::size_t p = 0; p < 60; ++p) {
      const bool right = p % 12 >= 6;
      f.set(p, right ? 0.11F : 0.1F);
      for (const std::size_t i : {2 * p, 2 * p + 1}) f.feature(i, k) = right ? 1.0F : 0.0F;
    }
    if (k == 1)
      EXPECT_NE(f.polished(0.005F), f.pixels);
    else
      EXPECT_EQ(f.polished(0.005F), f.pixels) << k;
  }
}

TEST(Polish, LetsNoiseOfAGuideThrough) {
  PolishFrame f(6, 1, all(6, 2));
  for (std::size_t p = 0; p < 6; ++p) {
    f.set(p, p == 2 ? 1.2F : 1.0F);
    f.feature(2 * p, 0) = p == 2 ? 1.0F : 0.0F;  // 0.5 on average, give or take 0.5
  }
  EXPECT_LT(f.polished(0.05F)[6], 1.15F);
}

TEST(Polish, LeavesOutEmptyPixels) {
  PolishFrame f(5, 1, {1, 0, 1, 1, 0});
  for (const std::size_t p : {0, 2, 3}) f.set(p, 1);
  f.set(1, 77);
  f.set(4, -3);
  EXPECT_EQ(f.polished(0.1F), f.pixels);
}

TEST(Polish, DoesNothingToADarkFrameOrASinglePixelOrWhenOff) {
  PolishFrame f = noise(9, 9);
  EXPECT_EQ(f.polished(0), f.pixels);
  f.plan.polish = 0;
  EXPECT_EQ(f.polished(1), f.pixels);
  PolishFrame one(1, 1, {3});
  one.set(0, 0.3F);
  EXPECT_EQ(one.polished(0.1F), one.pixels);
}

TEST(Polish, HasAFloorOfAPartOfTheMeanRadiance) {
  PolishFrame f(3, 1, {1, 0, 2}, 4);
  f.pixels = {1, 2, 3, 1, 90, 90, 90, 1, 3, 4, 5, 1};
  EXPECT_EQ(polish_floor(f.frame, f.pixels, 4), 0.15F);
  for (float& value : f.pixels) value = -value;
  EXPECT_EQ(polish_floor(f.frame, f.pixels, 4), 0.0F);
}

}  // namespace
}  // namespace rpf
