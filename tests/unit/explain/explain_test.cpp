// What explain() says where the truth is known. In the suite Filter, so that it runs on both backends.
#include "rpf/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rpf/error.h"
#include "rpf/scene.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

Settings settings_under_test(int box) {
  Settings settings = explain_settings();
  settings.backend = test::backend_under_test();
  settings.box_widths = {box};
  return settings;
}

/// explain(), and the proof that the backend under test ran it.
Explanation explained(const SampleBuffer& samples, int box = 9, const std::optional<PixelPosition>& pixel = {}) {
  Explanation result = explain(samples, settings_under_test(box), {}, pixel);
  EXPECT_EQ(result.report.backend.rfind(test::backend_under_test(), 0), 0) << result.report.backend;
  return result;
}

SampleBuffer scene(const std::string& name, int samples = 4, int width = 96, int height = 54) {
  SceneOptions options;
  options.width = width;
  options.height = height;
  options.samples = samples;
  return render_scene(name, options);
}

std::vector<float> layer(const Explanation& explanation, const std::string& name) {
  const Image& layers = explanation.layers;
  const auto found = std::find(layers.channels.begin(), layers.channels.end(), name);
  EXPECT_NE(found, layers.channels.end()) << name;
  std::vector<float> values;
  for (std::size_t p = 0; p < layers.data_window.pixel_count(); ++p)
    values.push_back(layers.pixel(p)[found - layers.channels.begin()]);
  return values;
}

double mean(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Sets R, G and B of every sample to what `color` makes of its record.
template <class Color>
void paint(SampleBuffer& samples, const Color& color) {
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const char* channel : {"R", "G", "B"}) test::value_of(samples, i, channel) = color(i);
}

TEST(Filter, ExplainFindsTheGroupThatAloneMakesNoise) {
  const std::vector<std::vector<std::string>> parts = {{"lens.U", "lens.V"}, {"light.U", "light.V"}, {"time"}};
  for (const auto& components : parts) {
    SampleBuffer samples = scene("noise");  // all numbers are independent
    // Symmetric about the middle, so that no mean shows it.
    paint(samples, [&](std::size_t i) {
      float square = 0;
      for (const std::string& name : components) {
        const float off = test::value_of(samples, i, "random." + name) - 0.5F;
        square += off * off;
      }
      return 1 + square;
    });
    const Explanation result = explained(samples);
    const std::string group = components[0].substr(0, components[0].find('.'));
    const std::vector<float> share = layer(result, "share." + group);
    EXPECT_GT(mean(share), 0.95) << group;
    const auto low = std::count_if(share.begin(), share.end(), [](float part) { return part < 0.8F; });
    EXPECT_LT(static_cast<double>(low), 0.01 * static_cast<double>(share.size())) << group;
    EXPECT_GT(mean(layer(result, "share.explained")), 0.5) << group;  // the rest: what close pairs still differ by
  }
}

TEST(Filter, ExplainSharesNoiseAmongGroupsAsTheyCauseIt) {
  // R depends on lens.U, G on the time, B on the albedo, each a coin. Pairs are close within h (0.191 of the two
  // components of the lens, 0.062 of the time), so h / (2 - h) of them lie on both sides of the coin's edge.
  const Explanation result = explained(scene("two-values", 16));
  const double lens = 1 - 2 * 0.191 / (2 - 0.191), time = 1 - 2 * 0.062 / (2 - 0.062);
  EXPECT_NEAR(mean(layer(result, "share.lens")), lens / (lens + time), test::tolerance::attributed_share);
  EXPECT_NEAR(mean(layer(result, "share.time")), time / (lens + time), test::tolerance::attributed_share);
  EXPECT_NEAR(mean(layer(result, "share.explained")), (lens + time) / 3, test::tolerance::attributed_share);
  EXPECT_LT(mean(layer(result, "share.light")), test::tolerance::attributed_share);
}

TEST(Filter, ExplainBlamesNobodyForNoiseOfItsOwn) {
  const Explanation result = explained(scene("noise"));
  EXPECT_LT(mean(layer(result, "share.explained")), test::tolerance::attributed_to_chance);
}

TEST(Filter, ExplainKnowsTheStandardErrorOfTheMean) {
  // Each channel is a coin between 0.25 and 0.75: its standard deviation is 0.25.
  const Explanation result = explained(scene("two-values"));
  EXPECT_NEAR(mean(layer(result, "noise.sample")), 0.25, 0.25 * test::tolerance::estimated_noise);
  EXPECT_NEAR(mean(layer(result, "noise.mean")), 0.125, 0.125 * test::tolerance::estimated_noise);
}

TEST(Filter, ExplainSuggestsAsManySamplesAsThereAre) {
  SceneOptions options;
  options.width = 40;
  options.height = 30;
  options.adaptive = true;  // some pixels have none
  const SampleBuffer samples = render_scene("combined", options);
  double with_samples = 0;
  for (std::size_t p = 0; p + 1 < samples.first_sample.size(); ++p)
    with_samples += samples.first_sample[p + 1] > samples.first_sample[p] ? 1 : 0;
  const std::vector<float> density = layer(explained(samples), "density");
  EXPECT_NEAR(mean(density), static_cast<double>(samples.sample_count()) / with_samples, 1e-4);
  EXPECT_GE(*std::min_element(density.begin(), density.end()), 0);
}

TEST(Filter, ExplainCountsEqualWeightsAsEffective) {
  const Explanation result = explained(scene("constant"));
  const std::vector<float> effective = layer(result, "neighborhood.effective"),
                           size = layer(result, "neighborhood.size");
  for (std::size_t p = 0; p < size.size(); ++p) EXPECT_NEAR(effective[p], size[p], size[p] * test::tolerance::formula);
}

TEST(Filter, ExplainedPixelAddsUpToItsLayers) {
  const SampleBuffer samples = scene("combined", 4, 48, 27);
  const Explanation result = explained(samples, 9, PixelPosition{20, 15});
  const ExplainedPixel& pixel = *result.pixel;
  const float* layers = result.layers.pixel(15 * 48 + 20);
  const std::size_t first = std::find(result.layers.channels.begin(), result.layers.channels.end(), "filtered.R") -
                            result.layers.channels.begin();
  double share = 0, drawn = 0;
  std::array<double, 3> color{};
  for (const ExplainedNeighbor& n : pixel.neighbors) {
    share += n.share;
    drawn += n.drawn;
    for (std::size_t c = 0; c < 3; ++c) color[c] += static_cast<double>(n.share) * n.color[c];
  }
  EXPECT_NEAR(share, 1, test::tolerance::filtered);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(color[c], layers[first + c], layers[first + c] * test::tolerance::filtered);
  EXPECT_EQ(drawn, layer(result, "neighborhood.size")[15 * 48 + 20]);
  ASSERT_FALSE(pixel.pairs.empty());
  for (const ExplainedPair& pair : pixel.pairs)
    EXPECT_EQ(std::accumulate(pair.histogram.begin(), pair.histogram.end(), 0U), drawn) << pair.second;
}

TEST(Filter, ExplainCountsPixelsAsTheDataWindowDoes) {
  const SampleBuffer samples = scene("combined", 4, 24, 16);
  SampleBuffer moved = samples;
  moved.data_window.x = -7;
  moved.data_window.y = 3;
  for (std::size_t i = 0; i < moved.sample_count(); ++i) {
    test::value_of(moved, i, "film.X") -= 7;
    test::value_of(moved, i, "film.Y") += 3;
  }
  const Explanation here = explained(samples, 9, PixelPosition{5, 6}),
                    there = explained(moved, 9, PixelPosition{-2, 9});
  EXPECT_EQ(there.layers.data_window, moved.data_window);
  EXPECT_EQ(there.pixel->position.x, -2);
  EXPECT_EQ(there.pixel->position.y, 9);
  ASSERT_EQ(there.pixel->neighbors.size(), here.pixel->neighbors.size());
  EXPECT_EQ(there.pixel->neighbors[0].pixel.x, here.pixel->neighbors[0].pixel.x - 7);
  EXPECT_EQ(there.pixel->neighbors[0].pixel.y, here.pixel->neighbors[0].pixel.y + 3);
}

TEST(Filter, ExplainIsTheSameForTilesAndThreads) {
  const SampleBuffer samples = scene("combined", 3, 30, 20);
  Settings settings = settings_under_test(9);
  settings.threads = 1;
  const Explanation whole = explain(samples, settings);
  settings.threads = 2;
  Control control;
  control.tile_pixels = 7;
  EXPECT_EQ(explain(samples, settings, control).layers.pixels, whole.layers.pixels);
}

TEST(Explain, SaysWhatItCannotExplain) {
  const SampleBuffer samples = test::defocused_edge();
  const auto kind = [&](const Settings& settings, const std::optional<PixelPosition>& pixel) {
    try {
      explain(samples, settings, {}, pixel);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::internal;
  };
  Settings two_passes = explain_settings(), cropped = two_passes, small = two_passes;
  two_passes.box_widths = {9, 5};
  cropped.crop = Window{0, 0, 4, 4};
  small.max_memory = 1000;
  EXPECT_EQ(kind(two_passes, {}), ErrorKind::usage);
  EXPECT_EQ(kind(cropped, {}), ErrorKind::usage);
  for (const Method method : {Method::cross_bilateral, Method::learned}) {
    Settings other = explain_settings();
    other.method = method;
    EXPECT_EQ(kind(other, {}), ErrorKind::usage);
  }
  EXPECT_EQ(kind(explain_settings(), PixelPosition{13, 0}), ErrorKind::usage);
  EXPECT_EQ(kind(small, {}), ErrorKind::memory);
}

}  // namespace
}  // namespace rpf
