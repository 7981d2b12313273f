#include "frame/pixel_planes.h"

#include <algorithm>
#include <cmath>

namespace rpf {
namespace {

using Values = std::vector<double>;  ///< [pixel]

/// Pixels to each side over which variances are compared with the halves' difference.
constexpr int comparison_reach = 10;

/// Sums over the pixels within `reach`, as far as the picture goes.
Values box_sums(const Values& values, int width, int height, int reach) {
  Values rows(values.size()), sums(values.size());
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + x; };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int i = std::max(x - reach, 0); i <= std::min(x + reach, width - 1); ++i) rows[at(x, y)] += values[at(i, y)];
  for (int y = 0; y < height; ++y)
    for (int i = std::max(y - reach, 0); i <= std::min(y + reach, height - 1); ++i)
      for (int x = 0; x < width; ++x) sums[at(x, y)] += rows[at(x, i)];
  return sums;
}

class Pixels {
 public:
  explicit Pixels(const PreparedFrame& prepared)
      : frame_(prepared.frame),
        colors_(prepared.colors),
        carried_(prepared.facts.carried),
        variables_(prepared.facts.variables),
        spread_(prepared.facts.feature_spread) {}

  std::size_t count() const { return frame_.first_sample.size() - 1; }

  float value(const PixelPlane& plane, std::size_t pixel) const {
    const std::uint32_t samples = frame_.samples(pixel);
    switch (plane.quantity) {
      case PixelQuantity::mean:
        return mean(pixel, plane.channel, 0, 1);
      case PixelQuantity::first_half:
        return mean(pixel, plane.channel, 0, 2);
      case PixelQuantity::second_half:
        return mean(pixel, plane.channel, samples > 1 ? 1 : 0, 2);
      case PixelQuantity::feature:
        return static_cast<float>(feature_mean(pixel, plane.channel) / plane.unit);
      case PixelQuantity::feature_variance:
        return static_cast<float>(feature_variance(pixel, plane.channel) / (plane.unit * plane.unit));
      case PixelQuantity::known:
        return knows_group(pixel, group_of_variable(variables_.feature_names[plane.channel])) ? 1 : 0;
      case PixelQuantity::known_mean:
        return static_cast<float>(known_mean(pixel, plane));
      case PixelQuantity::least_positive:
        return static_cast<float>(least_positive(pixel, plane.channel) / plane.unit);
      case PixelQuantity::any_positive:
        return least_positive(pixel, plane.channel) > 0 ? 1 : 0;
      case PixelQuantity::zero:
        return 0;
      case PixelQuantity::mask:
        return samples > 0 ? 1 : 0;
      case PixelQuantity::count:
        return static_cast<float>(samples);
      case PixelQuantity::first_count:
        return static_cast<float>((samples + 1) / 2);
      default:
        return static_cast<float>(std::max(samples / 2, std::min(samples, 1U)));
    }
  }

  double feature_mean(std::size_t pixel, std::size_t feature) const {
    double sum = 0;
    for (std::uint32_t i = frame_.first_sample[pixel]; i < frame_.first_sample[pixel + 1]; ++i)
      sum += feature_at(i, feature);
    return sum / std::max(frame_.samples(pixel), 1U);
  }

  /// 0 for a pixel that does not know.
  double feature_variance(std::size_t pixel, std::size_t feature) const {
    if (frame_.samples(pixel) < 2) return 0;
    return variance_of(pixel, [&](std::uint32_t i) { return feature_at(i, feature); });
  }

  /// In its unit, from its origin on.
  double known_mean(std::size_t pixel, const PixelPlane& plane) const {
    double sum = 0, known = 0;
    for (std::uint32_t i = frame_.first_sample[pixel]; i < frame_.first_sample[pixel + 1]; ++i) {
      const double value = frame_.record(i)[variables_.features() + plane.channel];
      if (std::isnan(value)) continue;
      sum += value;
      ++known;
    }
    return known > 0 ? (sum / known - plane.origin) / plane.unit : 0;
  }

  bool knows_group(std::size_t pixel, const std::string& group) const {
    for (std::size_t k = 0; k < variables_.feature_names.size(); ++k) {
      if (group_of_variable(variables_.feature_names[k]) != group) continue;
      bool known = false;
      for (std::uint32_t i = frame_.first_sample[pixel]; i < frame_.first_sample[pixel + 1]; ++i)
        known = known || !std::isnan(frame_.record(i)[variables_.features() + k]);
      if (!known) return false;
    }
    return true;
  }

  double least_positive(std::size_t pixel, std::size_t feature) const {
    double least = 0;
    for (std::uint32_t i = frame_.first_sample[pixel]; i < frame_.first_sample[pixel + 1]; ++i) {
      const double value = frame_.record(i)[variables_.features() + feature];
      if (value > 0 && (least == 0 || value < least)) least = value;
    }
    return least;
  }

  /// (9.2): of the mean of a color channel; a pixel with a single sample has the frame's mean variance.
  Values variances_of_means(std::size_t channel) const {
    Values variances(count());
    double sum = 0, known = 0;
    for (std::size_t p = 0; p < count(); ++p)
      if (frame_.samples(p) > 1) {
        sum += variances[p] = variance_of(p, [&](std::uint32_t i) { return at(i, channel); });
        ++known;
      }
    for (std::size_t p = 0; p < count(); ++p) {
      if (frame_.samples(p) == 1) variances[p] = sum / std::max(known, 1.0);
      variances[p] /= std::max(frame_.samples(p), 1U);
    }
    return variances;
  }

  /// (9.3): the same scaled by what the halves differ by around the pixel: samples that are spread evenly have means
  /// that vary less than chance.
  Values scaled_half_variances(std::size_t channel) const {
    Values variances = variances_of_means(channel), known(count()), differences(count());
    for (double& variance : variances) variance *= 2;
    for (std::size_t p = 0; p < count(); ++p) {
      if (frame_.samples(p) < 2) continue;
      const double off =
          value({PixelQuantity::first_half, channel, 1}, p) - value({PixelQuantity::second_half, channel, 1}, p);
      differences[p] = off * off / 2;
      known[p] = variances[p];
    }
    known = box_sums(known, frame_.width, frame_.height, comparison_reach);
    differences = box_sums(differences, frame_.width, frame_.height, comparison_reach);
    for (std::size_t p = 0; p < count(); ++p)
      if (known[p] > 0) variances[p] *= differences[p] / known[p];
    return variances;
  }

 private:
  /// (9.1): the variance of one sample, of a pixel that has two.
  template <typename Value>
  double variance_of(std::size_t pixel, const Value& value) const {
    const std::uint32_t first = frame_.first_sample[pixel], end = frame_.first_sample[pixel + 1];
    double sum = 0, squares = 0;
    for (std::uint32_t i = first; i < end; ++i) sum += value(i);
    for (std::uint32_t i = first; i < end; ++i) {
      const double off = value(i) - sum / (end - first);
      squares += off * off;
    }
    return squares / (end - first - 1);
  }

  double feature_at(std::size_t sample, std::size_t feature) const {
    const float value = frame_.record(sample)[variables_.features() + feature];
    return std::isnan(value) ? spread_[feature].mean : value;
  }

  double at(std::size_t sample, std::size_t channel) const { return colors_[sample * carried_ + channel]; }

  /// Over every `step`-th sample from `first` on; the plain mean where none of them has a weight.
  float mean(std::size_t pixel, std::size_t channel, std::uint32_t first, std::uint32_t step) const {
    double sum = 0, total = 0, plain = 0;
    std::uint32_t samples = 0;
    for (std::uint32_t i = frame_.first_sample[pixel] + first; i < frame_.first_sample[pixel + 1]; i += step) {
      const double weight = frame_.weights.empty() ? 1 : frame_.weights[i];
      sum += weight * at(i, channel);
      total += weight;
      plain += at(i, channel);
      ++samples;
    }
    return static_cast<float>(total > 0 ? sum / total : plain / std::max(samples, 1U));
  }

  const Frame& frame_;
  const std::vector<float>& colors_;
  std::size_t carried_;
  const Variables& variables_;
  const std::vector<FeatureSpread>& spread_;
};

}  // namespace

std::vector<float> pixel_planes(const PreparedFrame& prepared, const std::vector<PixelPlane>& planes,
                                std::size_t room) {
  const Pixels pixels(prepared);
  std::vector<float> values;
  values.reserve(std::max(room, planes.size()) * pixels.count());
  for (const PixelPlane& plane : planes) {
    const bool halves = plane.quantity == PixelQuantity::half_variance;
    if (halves || plane.quantity == PixelQuantity::variance)
      for (const double variance :
           halves ? pixels.scaled_half_variances(plane.channel) : pixels.variances_of_means(plane.channel))
        values.push_back(static_cast<float>(variance));
    else
      for (std::size_t p = 0; p < pixels.count(); ++p) values.push_back(pixels.value(plane, p));
  }
  return values;
}

std::vector<float> pixel_means(const PreparedFrame& prepared) {
  std::vector<PixelPlane> planes;
  for (std::size_t c = 0; c < prepared.facts.carried; ++c) planes.push_back({PixelQuantity::mean, c});
  return pixel_planes(prepared, planes, planes.size());
}

}  // namespace rpf
