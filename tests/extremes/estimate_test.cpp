// The learned estimator on arbitrary frames with arbitrary networks (docs/network.md, "Bound").
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "arbitrary.h"
#include "learned/network_file.h"
#include "rpf/explain.h"
#include "temporary_folder.h"
#include "test_networks.h"
#include "tolerances.h"

namespace rpf {
namespace {

using namespace test;

/// 24 x 16 pixels with every input, from 0 to 5 samples each.
SampleBuffer any_estimated_frame() {
  const int samples = *rc::gen::element(4, 0);
  return every_input({24, 16, samples, static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30))});
}

/// Weights from harmless to as large as a file can hold. Few shapes: OpenCL compiles each anew.
Network any_network() {
  NetworkOptions options;
  options.seed = static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30));
  options.shape.channels = *rc::gen::element(std::vector<int>{3}, std::vector<int>{5, 4}, std::vector<int>{4, 5, 9});
  options.shape.sample_features = *rc::gen::element(1, 5);
  options.shape.embedding = *rc::gen::element(1, 3);
  options.gain = *rc::gen::element(1.0F, 1.0F, 30.0F, 1e3F, 1e5F);
  return random_network(options);
}

Settings settings_with(const TemporaryFolder& folder, const Network& network) {
  Settings s;
  s.method = Method::learned;
  s.backend = backend_under_test();
  s.threads = 1;
  s.model = write_network(network, folder.file("any.rpfnet"));
  return s;
}

/// Least and largest of the samples, and of (radiance / a of samples) times (a of samples).
struct Bound {
  double least = INFINITY, largest = -INFINITY;

  void add(double value) {
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
};

Bound bound_of(const SampleBuffer& samples, const std::string& color, const std::string& albedo) {
  Bound bound, ratio, base;
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    const float* record = samples.record(i);
    const auto value = [&](const std::string& slot) { return static_cast<double>(record[*samples.layout.find(slot)]); };
    const bool is_hit = value("feature.hit") != 0;
    const double a = is_hit ? std::clamp(value(albedo), 0.0, 1.0) + 0.05 : 1;
    bound.add(value(color));
    ratio.add(value(color) / a);
    base.add(a);
  }
  for (const double r : {ratio.least, ratio.largest})
    for (const double b : {base.least, base.largest}) bound.add(r * b);
  return bound;
}

/// Nothing where all pixels are inside; the frame is within reach of every pixel.
std::string outside_bound(const std::vector<float>& pixels, const SampleBuffer& samples) {
  const char* channels[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    Bound bound = bound_of(samples, channels[c], std::string("feature.albedo.") + channels[c]);
    const double slack =
        tolerance::estimated_bound * std::max({std::fabs(bound.least), std::fabs(bound.largest), 1e-37});
    bound.add(0);  // a pixel without weight
    for (std::size_t p = c; p < pixels.size(); p += 3)
      if (!(pixels[p] >= bound.least - slack && pixels[p] <= bound.largest + slack))
        return fmt::format("value {} is {}, not between {} and {}", p, pixels[p], bound.least, bound.largest);
  }
  return "";
}

RC_GTEST_PROP(Estimate, StaysInsideItsBoundWhateverTheNetworkSays, ()) {
  const TemporaryFolder folder;
  const SampleBuffer samples = any_estimated_frame();
  RC_ASSERT(outside_bound(filtered(samples, settings_with(folder, any_network())), samples) == "");
}

RC_GTEST_PROP(Estimate, OfPixelsWithoutSamplesIsBlackWhateverIsAround, ()) {
  const TemporaryFolder folder;
  const SampleBuffer samples = every_input({24, 16, 0, static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30))});
  const std::vector<float> picture = filtered(samples, settings_with(folder, any_network()));
  for (std::size_t i = 0; i < picture.size(); ++i)
    if (samples.first_sample[i / 3] == samples.first_sample[i / 3 + 1]) RC_ASSERT(picture[i] == 0.0F);
}

RC_GTEST_PROP(Estimate, StaysInsideItsBoundForRadianceOfAllMagnitudes, ()) {
  const TemporaryFolder folder;
  SampleBuffer samples = any_estimated_frame();
  Dice dice(static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30)));
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* slot : {"R", "G", "B"}) value_of(samples, i, slot) = any_finite_float(dice) / 64;
  RC_ASSERT(outside_bound(filtered(samples, settings_with(folder, any_network())), samples) == "");
}

RC_GTEST_PROP(Estimate, StaysInsideItsBoundForFeaturesOfAllMagnitudesAndMissingOnes, ()) {
  const TemporaryFolder folder;
  SampleBuffer samples = any_estimated_frame();
  Dice dice(static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30)));
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const std::string& slot : samples.layout.slots)
      if ((is_feature_slot(slot) || is_random_slot(slot)) && slot.find("albedo") == std::string::npos)
        value_of(samples, i, slot) = dice() < 0.1F ? NAN : any_finite_float(dice);
  RC_ASSERT(outside_bound(filtered(samples, settings_with(folder, any_network())), samples) == "");
}

RC_GTEST_PROP(Estimate, StaysInsideItsBoundForAnyWeightsOfTheFile, ()) {
  const TemporaryFolder folder;
  SampleBuffer samples = any_estimated_frame();
  add_channel(samples, "weight", 0);
  Dice dice(static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30)));
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    value_of(samples, i, "weight") = std::min(std::fabs(any_finite_float(dice)), 1e15F);
  RC_ASSERT(outside_bound(filtered(samples, settings_with(folder, any_network())), samples) == "");
}

RC_GTEST_PROP(Estimate, TimesAPowerOfTwoIsThePictureTimesIt, ()) {
  const TemporaryFolder folder;
  const SampleBuffer samples = any_estimated_frame();
  const Settings settings = settings_with(folder, any_network());
  const int exponent = *rc::gen::inRange(-100, 120);
  SampleBuffer scaled = samples;
  scale_radiance(scaled, std::ldexp(1.0F, exponent));
  std::vector<float> expected = filtered(samples, settings);
  for (float& value : expected) value = std::ldexp(value, exponent);
  RC_ASSERT(difference(filtered(scaled, settings), expected, 24) == "");
}

RC_GTEST_PROP(Estimate, IsWhatTheSharesOfItsSamplesMake, ()) {
  const TemporaryFolder folder;
  const SampleBuffer samples = any_estimated_frame();
  const Settings settings = settings_with(folder, any_network());
  const int pixel = pixel_of(samples, any_sample(samples));
  const std::vector<float> picture = filtered(samples, settings);
  const ExplainedEstimate explained = explain_estimate(samples, settings, {pixel % 24, pixel / 24});
  double shares = 0;
  std::array<double, 3> color{}, magnitude{};
  for (const Contribution& sample : explained.samples) {
    shares += sample.share;
    for (std::size_t c = 0; c < 3; ++c) {
      const double part = static_cast<double>(sample.share) * sample.color.at(c) * explained.factor.at(c);
      color.at(c) += part;
      magnitude.at(c) += std::fabs(part);
    }
  }
  RC_PRE(shares > 0);  // not a pixel without weight
  RC_ASSERT(std::fabs(shares - 1) <= tolerance::remade_pixel);
  for (std::size_t c = 0; c < 3; ++c)
    RC_ASSERT(std::fabs(color.at(c) - picture[static_cast<std::size_t>(pixel) * 3 + c]) <=
              tolerance::remade_pixel * magnitude.at(c));
}

RC_GTEST_PROP(Estimate, HasTheSameBitsInAnyCropWithAnyThreads, ()) {
  const TemporaryFolder folder;
  const SampleBuffer samples = any_estimated_frame();
  Settings settings = settings_with(folder, any_network());
  const Image whole = run(samples, settings).image;
  Window crop;
  crop.x = *rc::gen::inRange(0, 24);
  crop.y = *rc::gen::inRange(0, 16);
  crop.width = *rc::gen::inRange(1, 25 - crop.x);
  crop.height = *rc::gen::inRange(1, 17 - crop.y);
  settings.crop = crop;
  settings.threads = *rc::gen::inRange(1, 5);
  RC_ASSERT(difference(filtered(samples, settings), part_of(whole, crop), crop.width) == "");
}

}  // namespace
}  // namespace rpf
