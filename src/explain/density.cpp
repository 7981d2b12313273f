#include "rpf/density.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "frame/sums_around.h"
#include "rpf/error.h"
#include "rpf/metrics.h"

namespace rpf {
namespace {

using Values = std::vector<double>;  ///< [pixel]

/// Pixels to each side over which noise and brightness are averaged: a few samples of one pixel know little, and counts
/// that follow a pixel's own samples would bias its mean. Near, an edge of noise is seen; far, there are samples
/// enough.
constexpr int near_pixel = 1, around = 3;

/// Part of the noise around a pixel that there is at least.
constexpr double least_part = 0.01;

/// What is known of one color: sums over the pixels.
struct Noise {
  Values squares;  ///< of samples around their pixel's mean
  Values free;     ///< how many of these are independent
  Values mean;     ///< of a pixel, 0 without samples
  Values pixels;   ///< 1 where it has samples
};

Noise noise_of(const SampleBuffer& frame, std::size_t column) {
  const std::size_t count = frame.data_window.pixel_count();
  Noise noise{Values(count), Values(count), Values(count), Values(count)};
  for (std::size_t p = 0; p < count; ++p) {
    double sum = 0, squares = 0, samples = 0;
    for (std::uint32_t i = frame.first_sample[p]; i < frame.first_sample[p + 1]; ++i) {
      const double value = frame.record(i)[column];
      if (!std::isfinite(value)) continue;
      ++samples;
      const double off = value - sum;  // sum is the mean so far (Welford)
      sum += off / samples;
      squares += off * (value - sum);
    }
    noise.squares[p] = squares;
    noise.free[p] = std::max(samples - 1, 0.0);
    noise.mean[p] = sum;
    noise.pixels[p] = samples > 0 ? 1 : 0;
  }
  return noise;
}

/// What relMSE has of one sample at each pixel, for each of `reaches`: variance over brightness, each of the pixels
/// within it, mean of the colors.
template <std::size_t N>
std::array<Values, N> relative_variances(const SampleBuffer& frame, const std::array<int, N>& reaches) {
  std::array<Values, N> relative;
  relative.fill(Values(frame.data_window.pixel_count()));
  for (const char* name : {"R", "G", "B"}) {
    const Noise noise = noise_of(frame, *frame.layout.find(name));
    for (std::size_t i = 0; i < N; ++i) {
      const auto sums = [&](const Values& values) {
        return sums_around(values, frame.data_window.width, frame.data_window.height, reaches[i]);
      };
      const Values squares = sums(noise.squares), free = sums(noise.free);
      const Values means = sums(noise.mean), pixels = sums(noise.pixels);
      for (std::size_t p = 0; p < relative[i].size(); ++p) {
        const double brightness = means[p] / std::max(pixels[p], 1.0);
        relative[i][p] += squares[p] / std::max(free[p], 1.0) / (brightness * brightness + relmse_floor) / 3;
      }
    }
  }
  return relative;
}

/// Sum of v / n is least for a given sum of n where n is in proportion to the root of v. v is the geometric mean of
/// what is near and what is around.
Values wanted_samples(const SampleBuffer& frame) {
  auto [wanted, wide] = relative_variances<2>(frame, {near_pixel, around});
  for (std::size_t p = 0; p < wanted.size(); ++p)
    wanted[p] = std::sqrt(std::sqrt(std::max(wanted[p], least_part * wide[p]) * wide[p]));
  return std::move(wanted);
}

/// Of an estimate without a number anywhere, or with one below 0, nothing follows.
void check_errors(const Image& estimate, std::size_t column) {
  const auto width = static_cast<std::size_t>(estimate.data_window.width);
  bool is_any_finite = false;
  for (std::size_t p = 0; p < estimate.data_window.pixel_count(); ++p) {
    const float error = estimate.pixel(p)[column];
    is_any_finite |= std::isfinite(error);
    if (error < 0)
      throw Error(ErrorKind::input,
                  fmt::format("density: the estimate's error is {} at pixel {},{}; relative errors from 0 on are "
                              "expected, as --aov FILE --error writes them",
                              error, estimate.data_window.x + static_cast<int>(p % width),
                              estimate.data_window.y + static_cast<int>(p / width)));
  }
  if (!is_any_finite)
    throw Error(ErrorKind::input, "density: the estimate's error is finite nowhere; write it with --aov FILE --error");
}

/// The same for the method's own error e of its picture from n samples a pixel: e^2 falls as v / n, and e is a part of
/// its mean at least.
Values wanted_for(const Image& estimate, const Values& counts) {
  const auto column = estimate.find("error");
  if (!column)
    throw Error(ErrorKind::input, "density: the estimate has no channel error; write it with --aov FILE --error");
  check_errors(estimate, *column);
  Values wanted;
  double sum = 0;
  for (std::size_t p = 0; p < counts.size(); ++p) {
    const double error = estimate.pixel(p)[*column];
    wanted.push_back(std::isfinite(error) ? std::max(error, 0.0) * std::sqrt(std::max(counts[p], 1.0)) : 0.0);
    sum += wanted.back();
  }
  for (double& value : wanted) value = std::max(value, least_part * sum / static_cast<double>(counts.size()));
  return wanted;
}

void check_window(const SampleBuffer& frame, const Image& estimate) {
  if (estimate.data_window == frame.data_window) return;
  throw Error(ErrorKind::input,
              fmt::format("density: the estimate has the data window {}, the samples have {}; equal ones are expected",
                          text_of(estimate.data_window), text_of(frame.data_window)));
}

/// Of the samples from `begin` to `end`.
std::size_t count_finite(const SampleBuffer& frame, std::size_t begin, std::size_t end) {
  const std::size_t colors[] = {*frame.layout.find("R"), *frame.layout.find("G"), *frame.layout.find("B")};
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; ++i)
    count += std::all_of(std::begin(colors), std::end(colors),
                         [&](std::size_t c) { return std::isfinite(frame.record(i)[c]); })
                 ? 1
                 : 0;
  return count;
}

void check_noise_is_told(const SampleBuffer& frame) {
  frame.validate();
  for (std::size_t p = 0; p + 1 < frame.first_sample.size(); ++p)
    if (count_finite(frame, frame.first_sample[p], frame.first_sample[p + 1]) > 1) return;
  throw Error(ErrorKind::input,
              "density: no pixel has two samples of finite R, G and B, which are needed to tell noise; render with 2 "
              "samples a pixel or more");
}

/// Further samples for a level: totals are in proportion to `wanted`, and no pixel gets less than one more.
double further(const Values& wanted, const Values& counts, double level, Values* each) {
  double sum = 0;
  for (std::size_t p = 0; p < wanted.size(); ++p) {
    const double more = std::max(level * wanted[p] - counts[p], 1.0);
    sum += more;
    if (each) (*each)[p] = more;
  }
  return sum;
}

/// Real numbers, 1 or more, with this sum.
Values shared_out(const Values& wanted, const Values& counts, double sum) {
  Values each(wanted.size(), sum / static_cast<double>(wanted.size()));
  const double most = *std::max_element(wanted.begin(), wanted.end());
  if (most <= 0) return each;
  double low = 0, high = 1 / most;
  while (further(wanted, counts, high, nullptr) < sum) high *= 2;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (further(wanted, counts, middle, nullptr) < sum ? low : high) = middle;
  }
  further(wanted, counts, high, &each);
  return each;
}

/// Whole numbers of the same sum: along a line that runs to and fro through the rows, each is what the rounded sum
/// grows by. So a number is at most one off, what is lost in one pixel is given to the next, and 1 stays 1.
std::vector<float> rounded(const Values& each, int width, double sum) {
  std::vector<float> whole(each.size());
  double exact = 0, given = 0;
  for (std::size_t i = 0; i < each.size(); ++i) {
    const std::size_t y = i / static_cast<std::size_t>(width), x = i % static_cast<std::size_t>(width);
    const std::size_t pixel =
        y * static_cast<std::size_t>(width) + (y % 2 == 0 ? x : static_cast<std::size_t>(width) - 1 - x);
    exact += each[pixel];
    const double next = i + 1 == each.size() ? sum : std::floor(exact + 0.5);
    whole[pixel] = static_cast<float>(next - given);
    given = next;
  }
  return whole;
}

void check(const SampleBuffer& frame, int samples) {
  check_noise_is_told(frame);
  if (samples < 1)
    throw Error(ErrorKind::usage, fmt::format("density: {} samples a pixel; 1 or more are expected", samples));
}

Values counts_of(const SampleBuffer& frame) {
  Values counts;
  for (std::size_t p = 0; p + 1 < frame.first_sample.size(); ++p)
    counts.push_back(frame.first_sample[p + 1] - frame.first_sample[p]);
  return counts;
}

Image density_of(const SampleBuffer& frame, const Values& wanted, const Values& counts, int samples) {
  const double sum = static_cast<double>(samples) * static_cast<double>(wanted.size());
  Image density;
  density.data_window = frame.data_window;
  density.display_window = frame.display_window;
  density.channels = {"Y"};
  density.pixels = rounded(shared_out(wanted, counts, sum), frame.data_window.width, sum);
  return density;
}

}  // namespace

Image sample_density(const SampleBuffer& frame, int samples) {
  check(frame, samples);
  return density_of(frame, wanted_samples(frame), counts_of(frame), samples);
}

Image sample_density(const SampleBuffer& frame, int samples, const Image& estimate) {
  check(frame, samples);
  check_window(frame, estimate);
  const Values counts = counts_of(frame), for_method = wanted_for(estimate, counts);
  Values wanted = wanted_samples(frame);
  for (std::size_t p = 0; p < wanted.size(); ++p) wanted[p] = std::sqrt(wanted[p] * for_method[p]);
  return density_of(frame, wanted, counts, samples);
}

std::size_t count_not_finite(const SampleBuffer& frame) {
  return frame.sample_count() - count_finite(frame, 0, frame.sample_count());
}

double mean_error(const SampleBuffer& frame) {
  check_noise_is_told(frame);
  const auto [relative] = relative_variances<1>(frame, {around});
  double sum = 0, pixels = 0;
  for (std::size_t p = 0; p < relative.size(); ++p) {
    const std::uint32_t count = frame.first_sample[p + 1] - frame.first_sample[p];
    if (count == 0) continue;
    sum += relative[p] / count;
    ++pixels;
  }
  return sum / pixels;
}

}  // namespace rpf
