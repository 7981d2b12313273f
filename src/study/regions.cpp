#include "study/regions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "rpf/metrics.h"

namespace rpf::study {
namespace {

std::size_t pixel_number(const Image& image, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.data_window.width) + static_cast<std::size_t>(x);
}

/// Of an image whose first channels are R, G, B.
double luminance(const float* pixel) { return 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]; }

std::vector<double> luminances(const Image& image, const Window& part) {
  std::vector<double> values;
  for (int y = part.y; y < part.y + part.height; ++y)
    for (int x = part.x; x < part.x + part.width; ++x)
      values.push_back(luminance(image.pixel(pixel_number(image, x, y))));
  return values;
}

std::vector<double> column_means(const Image& image, const Window& part) {
  const std::vector<double> all = luminances(image, part);
  std::vector<double> means(static_cast<std::size_t>(part.width), 0);
  for (std::size_t i = 0; i < all.size(); ++i) means[i % means.size()] += all[i] / part.height;
  return means;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The part of a square around (x, y) that is inside the frame.
Window square_around(int x, int y, int radius, const Window& frame) {
  const int left = std::max(x - radius, 0), top = std::max(y - radius, 0);
  return {left, top, std::min(x + radius + 1, frame.width) - left, std::min(y + radius + 1, frame.height) - top};
}

/// Luminances less what is around them.
std::vector<double> details(const Image& image, const Window& part) {
  const int radius = std::max(image.data_window.width / 32, 1);
  std::vector<double> values = luminances(image, part);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int x = part.x + static_cast<int>(i) % part.width, y = part.y + static_cast<int>(i) / part.width;
    values[i] -= mean(luminances(image, square_around(x, y, radius, image.data_window)));
  }
  return values;
}

double slope(const std::vector<double>& image, const std::vector<double>& reference) {
  const double a = mean(image), b = mean(reference);
  double covariance = 0, variance = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    covariance += (image[i] - a) * (reference[i] - b);
    variance += (reference[i] - b) * (reference[i] - b);
  }
  return variance > 0 ? covariance / variance : std::nan("");
}

}  // namespace

Window window_of(const Region& region, const Window& frame) {
  const auto pixel = [&](double position, int size) {
    return std::clamp(static_cast<int>(std::lround(size / 2.0 + position * frame.width)), 0, size - 1);
  };
  const int left = pixel(region.x, frame.width), top = pixel(region.y, frame.height);
  const int right = pixel(region.x + region.width, frame.width), bottom = pixel(region.y + region.height, frame.height);
  return {left, top, std::max(right - left, 1), std::max(bottom - top, 1)};
}

double region_error(const Image& image, const Image& reference, const Region& region) {
  const Image errors = relative_error_map(image, reference);
  const Window part = window_of(region, reference.data_window);
  double sum = 0;
  for (int y = part.y; y < part.y + part.height; ++y)
    for (int x = part.x; x < part.x + part.width; ++x) sum += errors.pixels[pixel_number(errors, x, y)];
  return sum / static_cast<double>(part.pixel_count());
}

double kept_detail(const Image& image, const Image& reference, const Region& region) {
  const Window part = window_of(region, reference.data_window);
  return slope(details(image, part), details(reference, part));
}

double kept_step(const Image& image, const Image& reference, const Region& region) {
  const Window part = window_of(region, reference.data_window);
  return slope(column_means(image, part), column_means(reference, part));
}

}  // namespace rpf::study
