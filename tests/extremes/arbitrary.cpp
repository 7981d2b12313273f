#include "arbitrary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "streaming.h"

namespace rpf::test {
namespace {

constexpr const char* colors[] = {"R", "G", "B"};

// The seed is fixed so that a run can be repeated; RC_PARAMS in the environment asks for others (docs/stability.md).
const int fixed_seed = ::setenv("RC_PARAMS", "seed=1 max_success=20", 0);

int count_of(const SampleBuffer& samples, int pixel) {
  return static_cast<int>(samples.first_sample[static_cast<std::size_t>(pixel) + 1] -
                          samples.first_sample[static_cast<std::size_t>(pixel)]);
}

/// Whether every frame is filtered once more as if it did not fit into memory: RPF_TEST_STREAMING.
bool streams_under_test() { return std::getenv("RPF_TEST_STREAMING") != nullptr; }

std::string compare(const std::vector<float>& actual, const std::vector<float>& expected, int width,
                    const std::function<bool(int x, int y)>& counts) {
  if (actual.size() != expected.size()) return "images of different sizes";
  for (std::size_t i = 0; i < actual.size(); ++i) {
    const int x = static_cast<int>(i / 3) % width, y = static_cast<int>(i / 3) / width;
    if (counts(x, y) && std::memcmp(&actual[i], &expected[i], sizeof(float)) != 0)
      return fmt::format("pixel {},{} channel {}: {:a} instead of {:a}", x, y, i % 3, actual[i], expected[i]);
  }
  return "";
}

}  // namespace

SampleBuffer any_uniform_frame() {
  return defocused_edge({24, 16, 4, static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30))});
}

SampleBuffer any_frame() {
  const int samples = *rc::gen::element(4, 0);
  return defocused_edge({24, 16, samples, static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30))});
}

Settings settings_of(Profile profile) {
  Settings settings = small_settings();
  settings.profile = profile;
  settings.box_widths = {7, 3};
  settings.seed = static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30));
  return settings;
}

Settings any_settings() { return settings_of(*rc::gen::element(Profile::thesis, Profile::paper)); }

std::uint32_t any_sample(const SampleBuffer& samples) {
  return static_cast<std::uint32_t>(*rc::gen::inRange<int>(0, static_cast<int>(samples.sample_count())));
}

int pixel_of(const SampleBuffer& samples, std::uint32_t sample) {
  const auto behind = std::upper_bound(samples.first_sample.begin(), samples.first_sample.end(), sample);
  return static_cast<int>(behind - samples.first_sample.begin()) - 1;
}

float any_finite_float(Dice& dice) {
  for (;;) {
    const auto high = static_cast<std::uint32_t>(dice() * 65536), low = static_cast<std::uint32_t>(dice() * 65536);
    const std::uint32_t bits = high << 16 | low;
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) return value;
  }
}

Result run(const SampleBuffer& samples, const Settings& settings) {
  Result result = filter(samples, settings);
  EXPECT_EQ(result.report.backend.rfind(backend_under_test(), 0), 0U) << result.report.backend;
  if (streams_under_test()) {
    EXPECT_EQ(difference_when_streamed(samples, settings, result), "");
  }
  return result;
}

std::vector<float> filtered(const SampleBuffer& samples, const Settings& settings) {
  return run(samples, settings).image.pixels;
}

std::string difference(const std::vector<float>& actual, const std::vector<float>& expected, int width) {
  return compare(actual, expected, width, [](int, int) { return true; });
}

std::string difference_beyond_reach(const std::vector<float>& actual, const std::vector<float>& expected, int width,
                                    int pixel) {
  return compare(actual, expected, width, [&](int x, int y) {
    return std::abs(x - pixel % width) > reach || std::abs(y - pixel / width) > reach;
  });
}

std::string not_finite(const std::vector<float>& pixels) {
  const auto bad = std::find_if(pixels.begin(), pixels.end(), [](float v) { return !std::isfinite(v); });
  return bad == pixels.end() ? "" : fmt::format("value {} is {}", bad - pixels.begin(), *bad);
}

std::string outside_hull(const std::vector<float>& pixels, const SampleBuffer& samples) {
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t column = *samples.layout.find(colors[c]);
    float least = INFINITY, largest = -INFINITY;
    for (std::size_t i = 0; i < samples.sample_count(); ++i) {
      least = std::min(least, samples.record(i)[column]);
      largest = std::max(largest, samples.record(i)[column]);
    }
    for (int pixel = 0; pixel < static_cast<int>(pixels.size() / 3); ++pixel) {
      const float value = pixels[3 * static_cast<std::size_t>(pixel) + c];
      if (count_of(samples, pixel) > 0 && !(value >= least && value <= largest))
        return fmt::format("pixel {} channel {}: {} is not between {} and {}", pixel, c, value, least, largest);
    }
  }
  return "";
}

SampleBuffer without(const SampleBuffer& samples, std::uint32_t sample) {
  SampleBuffer rest = samples;
  const auto stride = static_cast<std::ptrdiff_t>(samples.layout.size()), begin = sample * stride;
  rest.values.erase(rest.values.begin() + begin, rest.values.begin() + begin + stride);
  for (auto p = static_cast<std::size_t>(pixel_of(samples, sample)) + 1; p < rest.first_sample.size(); ++p)
    --rest.first_sample[p];
  return rest;
}

void snap_positions(SampleBuffer& samples, float unit) {
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"feature.P.X", "feature.P.Y", "feature.P.Z"})
      value_of(samples, i, slot) = std::round(value_of(samples, i, slot) * 256) * unit;
}

void move_world(SampleBuffer& samples, float x, float y, float z) {
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    value_of(samples, i, "feature.P.X") += x;
    value_of(samples, i, "feature.P.Y") += y;
    value_of(samples, i, "feature.P.Z") += z;
  }
}

}  // namespace rpf::test
