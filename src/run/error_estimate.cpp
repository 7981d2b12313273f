#include "run/error_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "frame/sums_around.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "rpf/methods.h"
#include "rpf/metrics.h"
#include "run/driver.h"
#include "run/memory.h"

namespace rpf {
namespace {

/// Pixels to each side over which an estimate is averaged: that of one pixel knows next to nothing.
constexpr int around = 4;

constexpr std::size_t colors = 3;

/// Samples 0, 2, 4, ... of each pixel from `first` = 0, or 1, 3, 5, ...
SampleBuffer half_of(const SampleBuffer& samples, std::uint32_t first) {
  SampleBuffer half;
  half.data_window = samples.data_window;
  half.display_window = samples.display_window;
  half.layout = samples.layout;
  half.metadata = samples.metadata;
  half.half_slots = samples.half_slots;
  half.first_sample = {0};
  half.values.reserve((samples.values.size() / samples.layout.size() + samples.data_window.pixel_count()) / 2 *
                      (samples.layout.size() + spare_columns));
  for (std::size_t p = 0; p < samples.data_window.pixel_count(); ++p) {
    for (std::uint32_t s = samples.first_sample[p] + first; s < samples.first_sample[p + 1]; s += 2)
      half.values.insert(half.values.end(), samples.record(s), samples.record(s) + samples.layout.size());
    half.first_sample.push_back(static_cast<std::uint32_t>(half.values.size() / samples.layout.size()));
  }
  return half;
}

/// No pass at all: the plain mean.
Settings for_mean(const Settings& settings) {
  Settings mean;
  mean.box_widths = {};
  mean.clamp_negative = settings.clamp_negative;
  mean.clamp_infinite = settings.clamp_infinite;
  mean.crop = settings.crop;
  mean.threads = settings.threads;
  return mean;
}

/// A part of the work, told as one of the whole.
Control part_of(const Control& control, double done, double share) {
  Control part = control;
  if (control.progress)
    part.progress = [&control, done, share](Progress progress) {
      progress.fraction = done + share * progress.fraction;
      progress.seconds_left = -1;
      return control.progress(progress);
    };
  return part;
}

/// What is left of a half's mean where its filtered picture is taken off, and that picture.
struct Half {
  Image filtered, mean;
};

Half filtered_half(SampleBuffer half, Settings settings, const Control& control) {
  settings.estimate_error = settings.filter_features = false;
  Half result;
  result.mean = run_filter(half, for_mean(settings), {}, {}).image;
  result.filtered = run_filter(std::move(half), settings, control, {}).image;
  return result;
}

/// Which pixels of the image both halves have samples in.
std::vector<double> pixels_in_both(const SampleBuffer& samples, const Window& image) {
  std::vector<double> both;
  const Window& frame = samples.data_window;
  for (int y = image.y - frame.y; y < image.y - frame.y + image.height; ++y)
    for (int x = image.x - frame.x; x < image.x - frame.x + image.width; ++x) {
      const std::size_t p = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + std::size_t(x);
      both.push_back(samples.first_sample[p + 1] - samples.first_sample[p] > 1 ? 1 : 0);
    }
  return both;
}

/// Variance of the filtered frame and the square of its bias, relative to the image: (10.1) and (10.2).
struct Parts {
  double variance = 0, bias = 0;
};

Parts parts_of(const Half& a, const Half& b, const Image& image, std::size_t pixel) {
  Parts parts;
  for (std::size_t c = 0; c < colors; ++c) {
    const double fa = a.filtered.pixel(pixel)[c], fb = b.filtered.pixel(pixel)[c], color = image.pixel(pixel)[c];
    const double brightness = colors * (color * color + relmse_floor);
    parts.variance += (fa - fb) * (fa - fb) / 4 / brightness;
    parts.bias += (fa - a.mean.pixel(pixel)[c]) * (fb - b.mean.pixel(pixel)[c]) / brightness;
  }
  return parts;
}

/// Of means around pixels: sums, and how many pixels count. 0 for what is below 0, and where none does.
std::vector<float> roots(const std::vector<double>& sums, const std::vector<double>& pixels) {
  std::vector<float> errors(sums.size());
  for (std::size_t p = 0; p < sums.size(); ++p)
    errors[p] = static_cast<float>(std::sqrt(std::max(sums[p], 0.0) / std::max(pixels[p], 1.0)));
  return errors;
}

/// Of a sum of `count` numbers what is more than chance: the sum, less what its own variance, from the sum of their
/// squares, is of it; 0 for what is below.
double beyond_chance(double sum, double squares, double count) {
  if (sum <= 0 || count < 2) return 0;
  const double variance = (squares - sum * sum / count) * count / (count - 1);
  return std::max(sum - variance / sum, 0.0);
}

/// (10.3).
std::vector<float> errors_of(const Half& a, const Half& b, const Image& image, const std::vector<double>& both) {
  const std::size_t count = both.size();
  std::vector<double> variance(count), bias(count);
  for (std::size_t p = 0; p < count; ++p) {
    const Parts parts = both[p] > 0 ? parts_of(a, b, image, p) : Parts{};
    if (std::isfinite(parts.variance)) variance[p] = parts.variance;
    if (std::isfinite(parts.bias)) bias[p] = parts.bias;
  }
  std::vector<double> squares(bias);
  for (double& value : squares) value *= value;
  const auto sums = [&, &window = image.data_window](const std::vector<double>& values) {
    return sums_around(values, window.width, window.height, around);
  };
  variance = sums(variance);
  bias = sums(bias);
  squares = sums(squares);
  const std::vector<double> pixels = sums(both);
  for (std::size_t p = 0; p < count; ++p) variance[p] += beyond_chance(bias[p], squares[p], pixels[p]);
  return roots(variance, pixels);
}

/// Behind the features, or alone.
void add_error(Result& result, const std::vector<float>& errors) {
  Image with = result.image;  // its windows and metadata
  with.channels = result.features.channels;
  with.channels.emplace_back("error");
  with.pixels.clear();
  const std::size_t before = result.features.channel_count();
  for (std::size_t p = 0; p < errors.size(); ++p) {
    if (before > 0) with.pixels.insert(with.pixels.end(), result.features.pixel(p), result.features.pixel(p) + before);
    with.pixels.push_back(errors[p]);
  }
  result.features = std::move(with);
}

}  // namespace

void check_halves(const FrameSize& size, Method method) {
  const std::uint32_t least = filters_pixels(method) && method != Method::axis_aligned ? 4 : 2;
  if (size.max_samples_per_pixel < least)
    throw Error(ErrorKind::input,
                fmt::format("no pixel has {} samples, which two halves need to tell the error; render "
                            "with as many, or leave --error out",
                            least));
}

Result filter_with_error(SampleBuffer samples, const Settings& settings, const Control& control) {
  samples.validate();
  check_halves(frame_size(samples), settings.method);
  constexpr double share = 0.25;  // of a half; the whole has as much work as both
  const Half a = filtered_half(half_of(samples, 0), settings, part_of(control, 0, share));
  const Half b = filtered_half(half_of(samples, 1), settings, part_of(control, share, share));
  std::vector<double> both = pixels_in_both(samples, a.mean.data_window);
  Settings whole = settings;
  whole.estimate_error = false;
  Result result = run_filter(std::move(samples), whole, part_of(control, 2 * share, 2 * share), {});
  add_error(result, errors_of(a, b, result.image, both));
  return result;
}

}  // namespace rpf
