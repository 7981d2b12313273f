// The two products: samples, and references with their own error.
#include <fmt/format.h>

#include <array>

#include "rpf/error.h"
#include "rpf/samples.h"
#include "rpf/scene.h"
#include "rpf/version.h"
#include "scene/camera_attributes.h"
#include "scene/counts.h"
#include "scene/renderer.h"
#include "scene/workforce.h"

namespace rpf {
namespace scene {
namespace {

using Color = std::array<double, 3>;

std::string sampler_name(SceneSampler sampler) {
  switch (sampler) {
    case SceneSampler::random:
      return "random";
    case SceneSampler::stratified:
      return "stratified";
    case SceneSampler::sobol:
      return "sobol";
  }
  return "?";
}

Metadata metadata_of(const std::string& name, const SceneOptions& options) {
  return {{seed_attribute, static_cast<std::int32_t>(options.seed)},
          {"rpf:renderer", fmt::format("rpf scene {}", version())},
          {"rpf:scene", name},
          {"rpf:sampler", sampler_name(options.sampler)}};
}

/// Sum of a pixel's samples, in the order of their numbers.
Color sum_of_samples(const Renderer& renderer, std::size_t pixel, const PixelSampler& sampler, std::uint32_t count) {
  Color sum{};
  for (std::uint32_t number = 0; number < count; ++number) {
    const Vec3 radiance = renderer.render(pixel, sampler, number).path.radiance;
    sum[0] += radiance.x;
    sum[1] += radiance.y;
    sum[2] += radiance.z;
  }
  return sum;
}

/// The mean of a pixel in three floats; returns the estimate of its relative squared error. The halves' means differ by
/// the error of both: the variance of the whole is w (1 - w) times the expectation of their squared difference, where
/// w is the first half's share of the samples.
double reference_pixel(const Renderer& renderer, const SceneOptions& options, std::size_t pixel, float* out) {
  const std::array<std::uint32_t, 2> counts = {(static_cast<std::uint32_t>(options.samples) + 1) / 2,
                                               static_cast<std::uint32_t>(options.samples) / 2};
  std::array<Color, 2> mean{};
  for (const int half : {0, 1}) {
    const Stage stage = half == 0 ? Stage::first_half : Stage::second_half;
    const PixelSampler sampler(options.sampler, pixel_key(options.seed, stage, pixel), counts[half]);
    mean[half] = sum_of_samples(renderer, pixel, sampler, counts[half]);
    for (double& value : mean[half]) value /= counts[half];
  }
  const double w = static_cast<double>(counts[0]) / options.samples;
  double error = 0;
  for (int c = 0; c < 3; ++c) {
    const double value = w * mean[0][c] + (1 - w) * mean[1][c], difference = mean[0][c] - mean[1][c];
    out[c] = static_cast<float>(value);
    error += w * (1 - w) * difference * difference / (value * value + 0.01);
  }
  return error / 3;
}

/// A scene's samples, rendered when they are read.
class SceneRows : public SampleRows {
 public:
  SceneRows(const std::string& name, const SceneOptions& options)
      : options_(options), renderer_(name, options_), first_sample_(first_samples(options_)) {
    frame_.data_window = frame_.display_window = {0, 0, options.width, options.height};
    frame_.layout = sample_layout(options_);
    frame_.metadata = metadata_of(name, options_);
    if (options_.lightfield) describe_camera(renderer_.camera(), options_, frame_.metadata);
  }

  const SampleBuffer& frame() const override { return frame_; }
  std::uint64_t row_samples(int row) const override {
    return first_sample_[pixel_of(row + 1)] - first_sample_[pixel_of(row)];
  }
  SampleBuffer read(int first, int end) override { return render(first, end, {}); }

  SampleBuffer render(int first, int end, const Control& control) const {
    SampleBuffer samples = frame_;
    samples.data_window.y += first;
    samples.data_window.height = end - first;
    const std::size_t begin = pixel_of(first), pixels = pixel_of(end) - begin;
    for (std::size_t p = begin; p <= begin + pixels; ++p)
      samples.first_sample.push_back(first_sample_[p] - first_sample_[begin]);
    samples.values.resize(samples.sample_count() * samples.layout.size());
    const double mean = static_cast<double>(samples.sample_count()) / static_cast<double>(pixels);
    for_all_pixels({pixels, mean, options_.threads}, control,
                   [&](std::size_t p) { render_pixel(begin + p, samples, samples.first_sample[p]); });
    return samples;
  }

 private:
  std::size_t pixel_of(int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(options_.width);
  }

  void render_pixel(std::size_t pixel, SampleBuffer& samples, std::uint32_t first) const {
    const std::uint32_t count = first_sample_[pixel + 1] - first_sample_[pixel];
    const PixelSampler sampler(options_.sampler, pixel_key(options_.seed, Stage::samples, pixel), count);
    for (std::uint32_t number = 0; number < count; ++number)
      write_record(renderer_.render(pixel, sampler, number), renderer_.usage(), options_,
                   samples.record(first + number));
  }

  SceneOptions options_;
  Renderer renderer_;
  std::vector<std::uint32_t> first_sample_;  ///< of the whole frame
  SampleBuffer frame_;
};

}  // namespace
}  // namespace scene

SampleBuffer render_scene(const std::string& name, const SceneOptions& options, const Control& control) {
  return scene::SceneRows(name, options).render(0, options.height, control);
}

std::unique_ptr<SampleRows> open_scene_rows(const std::string& name, const SceneOptions& options) {
  return std::make_unique<scene::SceneRows>(name, options);
}

Image render_reference(const std::string& name, const SceneOptions& options, const Control& control) {
  using namespace scene;
  const Renderer renderer(name, options);
  if (options.samples < 2)
    throw Error(ErrorKind::usage, "scene: a reference needs 2 samples a pixel or more, one for each half");
  Image image;
  image.data_window = image.display_window = {0, 0, options.width, options.height};
  image.channels = {"R", "G", "B"};
  const std::size_t pixels = image.data_window.pixel_count();
  image.pixels.resize(3 * pixels);
  std::vector<double> errors(pixels);
  for_all_pixels({pixels, static_cast<double>(options.samples), options.threads}, control, [&](std::size_t pixel) {
    errors[pixel] = reference_pixel(renderer, options, pixel, image.pixel(pixel));
  });
  double sum = 0;  // in the order of the pixels, whoever rendered them
  for (const double error : errors) sum += error;
  image.metadata = metadata_of(name, options);
  image.metadata["rpf:samplesPerPixel"] = std::int32_t{options.samples};
  image.metadata[residual_attribute] = static_cast<float>(sum / static_cast<double>(pixels));
  return image;
}

}  // namespace rpf
