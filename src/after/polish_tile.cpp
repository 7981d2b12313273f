#include "after/polish_tile.h"

#include <algorithm>
#include <limits>

#include "plan/regions.h"
#include "rpf_math.h"

namespace rpf {
namespace {

// The loops over x are in functions of their own, on pointers, so that compilers vectorize them.

constexpr float least_guide_variance = 1e-3F;

void add_relative_differences(const float* p, const float* q, float floor, int width, float* sum) {
  for (int x = 0; x < width; ++x) {
    const float relative = (p[x] - q[x]) / (0.5F * (kernel::fabs(p[x]) + kernel::fabs(q[x])) + floor);
    sum[x] += relative * relative;
  }
}

void raise_to_guide_distance(const float* mean_p, const float* mean_q, const float* variance_p, const float* variance_q,
                             int width, float* exponent) {
  for (int x = 0; x < width; ++x) {
    const float apart = mean_p[x] - mean_q[x], variance = variance_p[x] + variance_q[x];
    const float distance = (apart * apart - variance) / (least_guide_variance + variance);
    exponent[x] = distance > exponent[x] ? distance : exponent[x];  // false for a missing mean
  }
}

void to_weights(const float* valid, int width, float* exponent) {
  for (int x = 0; x < width; ++x) exponent[x] = kernel::rpf_exp(-exponent[x]) * valid[x];
}

void add_weighted(const float* weight, const float* p, const float* q, int width, float* sum) {
  for (int x = 0; x < width; ++x) sum[x] += weight[x] * (q[x] - p[x]);
}

/// Mean of a pixel's samples of one variable and the variance of that mean; the mean is NaN where all are missing.
void moments(const Frame& frame, std::size_t pixel, std::size_t variable, float& mean, float& variance) {
  double sum = 0, squares = 0;
  std::uint32_t count = 0;
  const auto each = [&](const auto& visit) {
    for (std::size_t i = frame.first_sample[pixel]; i < frame.first_sample[pixel + 1]; ++i) {
      const float value = frame.record(i)[variable];
      if (!kernel::rpf_is_missing(value)) visit(static_cast<double>(value));
    }
  };
  each([&](double value) { sum += value, ++count; });
  const double center = count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
  each([&](double value) { squares += (value - center) * (value - center); });
  mean = static_cast<float>(center);
  variance = count > 1 ? static_cast<float>(squares / (count - 1.0) / count) : 0.0F;
}

}  // namespace

std::vector<std::size_t> polish_guides(const Variables& variables) {
  std::vector<std::size_t> guides;
  for (std::size_t k = 0; k < variables.feature_names.size(); ++k) {
    const std::string& name = variables.feature_names[k];
    const std::string group = group_of_variable(name);
    if (group == "N" || group == "albedo") guides.push_back(variables.features() + k);
  }
  return guides;
}

PolishTile::PolishTile(const Frame& frame, const Plan& plan, float floor)
    : frame_(frame),
      carried_(plan.carried),
      floor_(floor),
      scale_(1.0F / (6.0F * plan.polish * plan.polish)),
      guides_(polish_guides(plan.variables)),
      values_(carried_),
      mean_(guides_.size()),
      variance_(guides_.size()),
      sums_(carried_) {}

std::uint64_t PolishTile::bytes(const Plan& plan) {
  const std::uint64_t planes = 2 * plan.carried + 2 + 2 * polish_guides(plan.variables).size();
  return planes * Plane::stride * Plane::rows * sizeof(float) + sizeof(PolishTile);
}

void PolishTile::run(const Window& tile, const std::vector<float>& pixels, std::vector<float>& result) {
  tile_ = tile;
  load(pixels);
  weight_sum_.fill(0);
  for (Plane& sum : sums_) sum.fill(0);
  for (int dy = -polish_radius; dy <= polish_radius; ++dy)
    for (int dx = -polish_radius; dx <= polish_radius; ++dx) add_offset(dx, dy);
  store(pixels, result);
}

void PolishTile::load(const std::vector<float>& pixels) {
  for (int y = -polish_reach; y < tile_.height + polish_reach; ++y)
    for (int x = -polish_reach; x < tile_.width + polish_reach; ++x) {
      const int u = tile_.x + x, v = tile_.y + y;
      const bool inside = u >= 0 && v >= 0 && u < frame_.width && v < frame_.height;
      const std::size_t pixel = inside ? static_cast<std::size_t>(v) * frame_.width + u : 0;
      const bool valid = inside && frame_.samples(pixel) > 0;
      valid_.row(y)[x] = valid ? 1.0F : 0.0F;
      for (std::size_t c = 0; c < carried_; ++c) values_[c].row(y)[x] = valid ? pixels[pixel * carried_ + c] : 0.0F;
      if (valid) load_guides(x, y, pixel);
    }
}

void PolishTile::load_guides(int x, int y, std::size_t pixel) {
  for (std::size_t k = 0; k < guides_.size(); ++k)
    moments(frame_, pixel, guides_[k], mean_[k].row(y)[x], variance_[k].row(y)[x]);
}

void PolishTile::add_offset(int dx, int dy) {
  for (int y = -polish_patch; y < tile_.height + polish_patch; ++y) {
    sum_patches_of_row(y, dx, dy);
    if (y >= polish_patch) weigh_row(y - polish_patch, dx, dy);
  }
}

/// The differences of row y to the row of its partners, summed over three places from x - 1 on.
void PolishTile::sum_patches_of_row(int y, int dx, int dy) {
  const int width = tile_.width + 2 * polish_patch;  // from x = -1 on
  float difference[Plane::stride], places[Plane::stride];
  std::fill_n(difference, width, 0.0F);
  for (std::size_t c = 0; c < 3; ++c)
    add_relative_differences(values_[c].row(y) - polish_patch, values_[c].row(y + dy) + dx - polish_patch, floor_,
                             width, difference);
  const float *p = valid_.row(y) - polish_patch, *q = valid_.row(y + dy) + dx - polish_patch;
  for (int x = 0; x < width; ++x) {
    places[x] = p[x] * q[x];
    difference[x] *= places[x];
  }
  PatchRow& out = patch_rows_[(y + polish_patch) % 3];
  for (int x = 0; x < tile_.width; ++x) out.difference[x] = difference[x] + difference[x + 1] + difference[x + 2];
  for (int x = 0; x < tile_.width; ++x) out.places[x] = places[x] + places[x + 1] + places[x + 2];
}

void PolishTile::weigh_row(int y, int dx, int dy) {
  const PatchRow &a = patch_rows_[y % 3], &b = patch_rows_[(y + 1) % 3], &c = patch_rows_[(y + 2) % 3];
  const int width = tile_.width;
  float weight[Plane::stride];
  for (int x = 0; x < width; ++x) {
    const float places = a.places[x] + b.places[x] + c.places[x];
    const float difference = a.difference[x] + b.difference[x] + c.difference[x];
    weight[x] = difference / (places > 1.0F ? places : 1.0F) * scale_;
  }
  for (std::size_t k = 0; k < guides_.size(); ++k)
    raise_to_guide_distance(mean_[k].row(y), mean_[k].row(y + dy) + dx, variance_[k].row(y),
                            variance_[k].row(y + dy) + dx, width, weight);
  to_weights(valid_.row(y + dy) + dx, width, weight);
  float* weight_sum = weight_sum_.row(y);
  for (int x = 0; x < width; ++x) weight_sum[x] += weight[x];
  for (std::size_t k = 0; k < carried_; ++k)
    add_weighted(weight, values_[k].row(y), values_[k].row(y + dy) + dx, width, sums_[k].row(y));
}

/// A value plus the mean difference to it: exact where all values with a weight are equal.
void PolishTile::store(const std::vector<float>& pixels, std::vector<float>& result) {
  for (int y = 0; y < tile_.height; ++y)
    for (int x = 0; x < tile_.width; ++x) {
      if (valid_.row(y)[x] == 0) continue;
      const std::size_t first = (static_cast<std::size_t>(tile_.y + y) * frame_.width + tile_.x + x) * carried_;
      for (std::size_t c = 0; c < carried_; ++c)
        result[first + c] = pixels[first + c] + sums_[c].row(y)[x] / weight_sum_.row(y)[x];
    }
}

}  // namespace rpf
