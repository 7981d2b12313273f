#include "explain/layers.h"

#include <algorithm>
#include <cmath>

#include "explain/blur.h"
#include "frame/place_of.h"
#include "rpf/metrics.h"
#include "rpf_math.h"

namespace rpf {
namespace {

/// Of `count` values that are `stride` apart, in the unit of Attribution; not biased.
float variance_of(const float* values, std::uint32_t count, std::size_t stride) {
  double mean = 0, square = 0;
  for (std::uint32_t i = 0; i < count; ++i) mean += static_cast<double>(values[i * stride]) / count;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double off = (values[i * stride] - mean) * attribution_unit;
    square += off * off;
  }
  return static_cast<float>(square / (count - 1));
}

}  // namespace

std::vector<std::string> Layers::names(const Variables& variables, const std::vector<RandomGroup>& groups) {
  std::vector<std::string> names = {"R", "G", "B", "filtered.R", "filtered.G", "filtered.B"};
  for (const char* name : {"normal.X", "normal.Y", "normal.Z", "position.X", "position.Y", "position.Z", "W.R", "W.G",
                           "W.B", "W.mean", "alpha.R", "alpha.G", "alpha.B"})
    names.emplace_back(name);
  for (const std::string& feature : variables.feature_names) names.push_back("beta." + feature);
  for (const RandomGroup& group : groups) names.push_back("information." + group.name);
  names.emplace_back("information.position");
  names.emplace_back("information.features");
  for (const RandomGroup& group : groups) names.push_back("share." + group.name);
  for (const char* name : {"share.explained", "neighborhood.size", "neighborhood.acceptance", "neighborhood.effective",
                           "noise.sample", "noise.mean", "noise.remaining", "noise.relative", "density"})
    names.emplace_back(name);
  return names;
}

Layers::Layers(const PreparedFrame& prepared, const Plan& plan, const std::vector<RandomGroup>& groups)
    : prepared_(prepared),
      plan_(plan),
      groups_(groups),
      names_(names(plan.variables, groups)),
      values_((prepared.frame.first_sample.size() - 1) * names_.size()),
      fraction_random_(channel("W.R")),
      share_(channel("share.explained") - groups.size()),
      neighborhood_(channel("neighborhood.size")),
      noise_(channel("noise.sample")),
      density_(channel("density")) {}

std::size_t Layers::channel(const std::string& name) const { return *place_of(name, names_); }

void Layers::explain_dependencies(const float* information, std::size_t pixel) {
  const std::size_t random = plan_.variables.random_names.size(), features = plan_.variables.feature_names.size();
  kernel::rpf_color_weights color{};
  std::vector<float> of_random(features), of_feature(features), beta(features);
  kernel::rpf_weigh_dependencies(information, static_cast<kernel::uint>(random), static_cast<kernel::uint>(features),
                                 plan_.alpha_factor, plan_.passes[0].growth, &color,
                                 {of_random.data(), of_feature.data(), beta.data()});
  float* to = &value(pixel, fraction_random_);
  to = std::copy_n(color.color_fraction_random, 3, to);
  *to++ = color.fraction_random;
  to = std::copy_n(color.alpha, 3, to);
  to = std::copy(beta.begin(), beta.end(), to);
  for (std::size_t c = 0; c < 3; ++c) {
    const float* row = information + c * (2 + random + features);
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const std::size_t column : groups_[g].columns) to[g] += row[column - Variables::position];
    to[groups_.size()] += kernel::rpf_sum(row, 2);
    to[groups_.size() + 1] += kernel::rpf_sum(row + 2 + random, static_cast<kernel::uint>(features));
  }
}

void Layers::add_tile(const Backend& backend, const Window& tile) {
  const std::size_t pairs = pair_count(plan_.variables);
  const float* explained = backend.explained().data();
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x, explained += pairs + 1) {
      const std::size_t pixel = static_cast<std::size_t>(y) * plan_.width + x;
      if (prepared_.frame.samples(pixel) == 0) continue;
      explain_dependencies(explained, pixel);
      const PixelStatistics& found = backend.statistics()[pixel];
      const auto accepted = static_cast<float>(found.neighbors - prepared_.frame.samples(pixel));
      value(pixel, neighborhood_) = static_cast<float>(found.neighbors);
      value(pixel, neighborhood_ + 1) = found.drawn > 0 ? accepted / static_cast<float>(found.drawn) : 0;
      value(pixel, neighborhood_ + 2) = explained[pairs];
    }
}

void Layers::add_colors(const std::vector<float>& mean, const std::vector<float>& filtered) {
  for (std::size_t pixel = 0; pixel < mean.size() / plan_.carried; ++pixel)
    for (std::size_t c = 0; c < 3; ++c) {
      value(pixel, c) = mean[pixel * plan_.carried + c] / prepared_.facts.radiance_scale;
      value(pixel, 3 + c) = filtered[pixel * plan_.carried + c] / prepared_.facts.radiance_scale;
    }
}

void Layers::add_mean(const std::string& layer, const std::string& feature) {
  const std::optional<std::size_t> place = place_of(feature, plan_.variables.feature_names);
  if (!place) return;
  const std::size_t column = plan_.variables.features() + *place;
  const std::size_t to = channel(layer);
  const Frame& frame = prepared_.frame;
  for (std::size_t pixel = 0; pixel + 1 < frame.first_sample.size(); ++pixel) {
    double sum = 0;
    int count = 0;
    for (std::uint32_t i = frame.first_sample[pixel]; i < frame.first_sample[pixel + 1]; ++i) {
      const float feature_value = frame.record(i)[column];
      if (kernel::rpf_is_missing(feature_value)) continue;
      sum += feature_value;
      ++count;
    }
    if (count > 0) value(pixel, to) = static_cast<float>(sum / count);
  }
}

void Layers::add_features() {
  for (const std::string axis : {"X", "Y", "Z"}) {
    add_mean("normal." + axis, "N." + axis);
    add_mean("position." + axis, "P." + axis);
  }
}

std::vector<float> Layers::kept_variance(const std::vector<float>& filtered) const {
  const Frame& frame = prepared_.frame;
  std::vector<float> kept(frame.first_sample.size() - 1), count(kept.size());
  for (std::size_t pixel = 0; pixel < kept.size(); ++pixel) {
    const std::uint32_t samples = frame.samples(pixel);
    if (samples < 2) continue;
    count[pixel] = 1;
    const float* first = filtered.data() + frame.first_sample[pixel] * plan_.carried;
    for (std::size_t c = 0; c < 3; ++c) kept[pixel] += variance_of(first + c, samples, plan_.carried);
  }
  blur(kept, frame.width, frame.height, attribution_sigma);
  blur(count, frame.width, frame.height, attribution_sigma);
  for (std::size_t pixel = 0; pixel < kept.size(); ++pixel) kept[pixel] /= std::max(count[pixel], 1e-6F);
  return kept;
}

double Layers::estimate_noise(std::size_t pixel, double variance, double kept) {
  const std::uint32_t samples = prepared_.frame.samples(pixel);
  float* noise = &value(pixel, noise_);
  noise[0] = static_cast<float>(std::sqrt(variance));
  if (samples == 0) return 0;
  const double remaining = variance / value(pixel, neighborhood_ + 2) + kept / samples;
  double square = 0;
  for (std::size_t c = 3; c < 6; ++c) square += static_cast<double>(value(pixel, c)) * value(pixel, c) / 3;
  const double relative = std::sqrt(remaining / (square + relmse_floor));
  const double values[] = {std::sqrt(variance / samples), std::sqrt(remaining), relative};
  std::copy(std::begin(values), std::end(values), noise + 1);
  return relative;
}

/// Proportional to what remains, with as many samples in all as there are; pixels without samples get the mean.
void Layers::suggest_density(const std::vector<double>& relative) {
  double sum = 0, measured = 0;
  for (std::size_t pixel = 0; pixel < relative.size(); ++pixel) {
    sum += relative[pixel];
    measured += prepared_.frame.samples(pixel) > 0 ? 1 : 0;
  }
  const double mean = measured > 0 ? static_cast<double>(prepared_.frame.sample_count()) / measured : 1;
  for (std::size_t pixel = 0; pixel < relative.size(); ++pixel) {
    const bool known = sum > 0 && prepared_.frame.samples(pixel) > 0;
    value(pixel, density_) = static_cast<float>(known ? mean * measured * relative[pixel] / sum : mean);
  }
}

void Layers::add_noise(const Attribution& attribution, const std::vector<float>& filtered) {
  const double unit = static_cast<double>(prepared_.facts.radiance_scale) * attribution_unit;  // of a record's radiance
  const std::vector<float> kept = kept_variance(filtered);
  std::vector<double> relative(kept.size());
  for (std::size_t pixel = 0; pixel < relative.size(); ++pixel) {
    for (std::size_t g = 0; g < groups_.size(); ++g) value(pixel, share_ + g) = attribution.share(g, pixel);
    value(pixel, share_ + groups_.size()) = attribution.explained(pixel);
    relative[pixel] =
        estimate_noise(pixel, attribution.variance[pixel] / 3 / unit / unit, kept[pixel] / 3 / unit / unit);
  }
  suggest_density(relative);
}

Image Layers::take(Image geometry) {
  geometry.channels = std::move(names_);
  geometry.pixels = std::move(values_);
  return geometry;
}

}  // namespace rpf
