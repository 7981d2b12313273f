// The learned estimator as a method of filter(): what must not matter, and what must come out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "learned/network_file.h"
#include "rpf/error.h"
#include "rpf/filter.h"
#include "rpf/presets.h"
#include "rpf_network.h"
#include "temporary_folder.h"
#include "test_frames.h"
#include "test_networks.h"
#include "tolerances.h"

namespace rpf {
namespace {

using test::every_input;
using test::value_of;

/// Runs with a network of three levels whose weights are random.
class EveryMethodEstimate : public testing::Test {
 protected:
  Settings settings() const {
    Settings s;
    s.method = Method::learned;
    s.backend = test::backend_under_test();
    s.model = model_;
    s.threads = 1;
    return s;
  }

  std::vector<float> estimate(const SampleBuffer& samples, const Settings& s) const {
    const Result result = filter(samples, s);
    EXPECT_EQ(result.report.backend.rfind(test::backend_under_test(), 0), 0U) << result.report.backend;
    return result.image.pixels;
  }
  std::vector<float> estimate(const SampleBuffer& samples) const { return estimate(samples, settings()); }

 private:
  TemporaryFolder folder_;
  std::string model_ = test::write_network(test::random_network(), folder_.file("random.rpfnet"));
};

TEST_F(EveryMethodEstimate, ChangesTheFrameAndStaysFinite) {
  const SampleBuffer samples = every_input({21, 17, 4, 1});
  Settings mean;
  mean.box_widths = {};
  const std::vector<float> pixels = estimate(samples), plain = filter(samples, mean).image.pixels;
  EXPECT_NE(pixels, plain);
  for (const float v : pixels) EXPECT_TRUE(std::isfinite(v));
}

TEST_F(EveryMethodEstimate, KeepsAConstantColorAndTheBlackOfPixelsWithoutSamples) {
  SampleBuffer samples = every_input({21, 17, 0, 1});
  const float color[] = {0.7F, 1e-3F, 40};
  const char* slots[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) test::fill(samples, slots[c], color[c]);
  for (const char* slot : {"feature.albedo.R", "feature.albedo.G", "feature.albedo.B"}) test::fill(samples, slot, 0.5F);
  test::fill(samples, "feature.hit", 1);
  const std::vector<float> pixels = estimate(samples);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const float expected = samples.first_sample[i / 3] < samples.first_sample[i / 3 + 1] ? color[i % 3] : 0;
    ASSERT_NEAR(pixels[i], expected, test::tolerance::estimated_constant * expected) << i;
  }
}

TEST_F(EveryMethodEstimate, OfAFrameTimesAPowerOfTwoIsThePictureTimesIt) {
  const SampleBuffer samples = every_input({21, 17, 0, 1});
  for (const int exponent : {-80, -1, 3, 90}) {
    SampleBuffer scaled = samples;
    test::scale_radiance(scaled, std::ldexp(1.0F, exponent));
    std::vector<float> expected = estimate(samples);
    for (float& v : expected) v = std::ldexp(v, exponent);
    EXPECT_EQ(estimate(scaled), expected) << exponent;
  }
}

TEST_F(EveryMethodEstimate, HasTheSameBitsForAnyNumberOfThreads) {
  const SampleBuffer samples = every_input({37, 29, 0, 1});
  Settings s = settings();
  const std::vector<float> one = estimate(samples, s);
  for (const int threads : {2, 3, 7}) {
    s.threads = threads;
    EXPECT_EQ(estimate(samples, s), one) << threads;
  }
}

TEST_F(EveryMethodEstimate, OfACropIsThatPartOfTheWhole) {
  const SampleBuffer samples = every_input({150, 141, 1, 1});
  const Image whole = filter(samples, settings()).image;
  for (const Window& crop : {Window{0, 0, 1, 1}, Window{70, 66, 9, 7}, Window{149, 140, 1, 1}, Window{3, 0, 140, 1},
                             Window{75, 5, 2, 130}}) {
    Settings s = settings();
    s.crop = crop;
    EXPECT_EQ(estimate(samples, s), test::part_of(whole, crop)) << crop.x << "," << crop.y;
  }
}

TEST_F(EveryMethodEstimate, InBandsIsTheWholeAndTakesLessMemory) {
  const SampleBuffer samples = every_input({16, 900, 1, 1});
  const FrameSize size{16 * 900, samples.sample_count(), 1, 16};
  Settings s = settings();
  const std::vector<float> whole = estimate(samples, s);
  const std::uint64_t all = predict_memory(size, samples.layout, s);
  if (s.backend == "cpu") {  // a device keeps few rows at a time anyway
    s.max_memory = all * 3 / 4;
    EXPECT_LT(predict_memory(size, samples.layout, s), s.max_memory);
    EXPECT_EQ(estimate(samples, s), whole);
  }
  s.max_memory = all / 8;
  try {
    estimate(samples, s);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::memory);
  }
}

TEST_F(EveryMethodEstimate, OfAGroupThatIsConstantIsThatWithoutIt) {
  SampleBuffer samples = every_input({21, 17, 3, 1});
  test::fill(samples, "feature.hit", 1);  // a normal is 0 where nothing is hit, so it would vary
  const std::vector<std::vector<std::string>> groups = {{"random.lens.U", "random.lens.V"},
                                                        {"random.time"},
                                                        {"random.bsdf.U", "random.bsdf.V"},
                                                        {"feature.N.X", "feature.N.Y", "feature.N.Z"},
                                                        {"feature.P.X", "feature.P.Y", "feature.P.Z"}};
  for (const auto& group : groups) {
    SampleBuffer constant = samples;
    for (const std::string& slot : group) test::fill(constant, slot, 0.25F);
    std::vector<std::string> others = samples.layout.slots;
    const auto is_in_group = [&](const std::string& slot) {
      // Distances to the second hit need the first one's position.
      const bool is_second = group[0] == "feature.P.X" && slot.rfind("feature.P2", 0) == 0;
      return is_second || std::find(group.begin(), group.end(), slot) != group.end();
    };
    others.erase(std::remove_if(others.begin(), others.end(), is_in_group), others.end());
    if (group[0] == "feature.P.X")
      for (const char* slot : {"feature.P2.X", "feature.P2.Y", "feature.P2.Z"}) test::fill(constant, slot, 0.25F);
    EXPECT_EQ(estimate(constant), estimate(test::with_slots(samples, others))) << group[0];
  }
}

TEST_F(EveryMethodEstimate, WorksWithColorAlone) {
  const SampleBuffer samples = every_input({21, 17, 3, 1});
  for (const float v : estimate(test::with_slots(samples, {"R", "G", "B", "film.X", "film.Y"})))
    EXPECT_TRUE(std::isfinite(v));
}

TEST_F(EveryMethodEstimate, OfAFrameWithoutSamplesIsBlack) {
  SampleBuffer samples = every_input({3, 2, 1, 1});
  samples.values.clear();
  std::fill(samples.first_sample.begin(), samples.first_sample.end(), 0U);
  for (const float v : estimate(samples)) EXPECT_EQ(v, 0.0F);
}

TEST_F(EveryMethodEstimate, OfAPixelAloneIsItsColorWhateverTheNetworkSays) {
  const TemporaryFolder folder;
  const SampleBuffer samples = every_input({1, 1, 1, 1});
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    Settings s = settings();
    s.model = test::write_network(test::random_network({{4, {4, 5, 9}, 2}, seed, 1e5F}), folder.file("hostile.rpfnet"));
    const std::vector<float> pixels = estimate(samples, s);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(pixels[c], samples.record(0)[c], test::tolerance::estimated_constant) << "seed " << seed;
  }
}

TEST_F(EveryMethodEstimate, TakesThousandsOfSamplesInOnePixel) {
  SampleBuffer samples = every_input({3, 3, 1500, 1});
  for (const float v : estimate(samples)) EXPECT_TRUE(std::isfinite(v) && v > 0);
}

TEST_F(EveryMethodEstimate, DoesNotDependOnTheUnitOfTheFilesWeights) {
  SampleBuffer samples = every_input({9, 9, 3, 1});
  test::add_channel(samples, "weight", 1);
  value_of(samples, 5, "weight") = 0.25F;
  for (const float unit : {0x1p40F, 0x1p-100F}) {
    SampleBuffer scaled = samples;
    for (std::size_t i = 0; i < samples.sample_count(); ++i) value_of(scaled, i, "weight") *= unit;
    EXPECT_EQ(estimate(scaled), estimate(samples)) << unit;
  }
  SampleBuffer without = samples;
  test::fill(without, "weight", 1);
  EXPECT_NE(estimate(without), estimate(samples));
}

TEST_F(EveryMethodEstimate, CarriesAlphaAndFeaturesWithTheSameWeights) {
  SampleBuffer samples = every_input({9, 9, 3, 1});
  test::add_channel(samples, "A", 0.5F);
  Settings s = settings();
  s.filter_features = true;
  const Result result = filter(samples, s);
  ASSERT_EQ(result.image.channels.size(), 4U);
  for (std::size_t p = 0; p < 81; ++p) EXPECT_NEAR(result.image.pixel(p)[3], 0.5F, test::tolerance::estimated_constant);
  EXPECT_THAT(result.features.channels, testing::Contains("N2.X"));
}

TEST_F(EveryMethodEstimate, SaysWhichNetworkItWasAndWhatItLookedAt) {
  const Result result = filter(every_input({9, 9, 3, 1}), settings());
  const Network network = test::random_network();
  EXPECT_EQ(result.report.model, "random");
  EXPECT_EQ(result.report.model_hash, network.hash);
  EXPECT_EQ(std::get<std::string>(result.image.metadata.at("rpf:modelHash")), network.hash);
  EXPECT_EQ(std::get<std::string>(result.image.metadata.at("rpf:method")), "learned");
  EXPECT_THAT(result.report.random, testing::Contains("light.U"));
  EXPECT_THAT(result.report.features, testing::Contains("hit"));
  EXPECT_GT(result.report.passes.front().energy, 0.5);
}

/// Inputs first .. end - 1 without any weight.
void forget(Network& network, int first, int end) {
  NetworkLayer& sample1 = network.layers.front();
  const auto row = [&](int input) {
    return sample1.weights.begin() + static_cast<std::ptrdiff_t>(input) * sample1.outputs;
  };
  std::fill(row(first), row(end), 0.0F);
}

TEST_F(EveryMethodEstimate, ReadsNoChannelThatItsNetworkDoesNotLookAt) {
  TemporaryFolder folder;
  Network network = test::random_network();
  forget(network, RPF_INPUT_DISTANCE2, RPF_INPUT_HIT2);
  forget(network, RPF_INPUT_FILM, RPF_INPUTS);
  Settings s = settings();
  s.model = test::write_network(network, folder.file("some.rpfnet"));
  const SampleBuffer samples = every_input({19, 13, 3, 1});
  const std::vector<std::string> needed = needed_slots(samples.layout, s);
  EXPECT_THAT(needed, testing::Contains("feature.N2.X"));  // says whether there is a second hit
  for (const char* slot : {"feature.P2.X", "random.light.U", "random.bsdf.V"})
    EXPECT_THAT(needed, testing::Not(testing::Contains(slot)));
  const Result all = filter(samples, s), some = filter(test::with_slots(samples, needed), s);
  EXPECT_EQ(some.image.pixels, all.image.pixels);
  EXPECT_EQ(some.report.features, all.report.features);
  EXPECT_EQ(some.report.random, all.report.random);
  EXPECT_THAT(all.report.features, testing::Not(testing::Contains("P2.X")));
}

TEST_F(EveryMethodEstimate, ReadsNoSecondHitForANetworkThatLooksAtNone) {
  TemporaryFolder folder;
  Network network = test::random_network();
  forget(network, RPF_INPUT_NORMAL2, RPF_INPUT_LENS);
  Settings s = settings();
  s.model = test::write_network(network, folder.file("some.rpfnet"));
  const SampleLayout layout = every_input({2, 2, 1, 1}).layout;
  EXPECT_THAT(needed_slots(layout, s), testing::Not(testing::Contains("feature.N2.X")));
  EXPECT_THAT(needed_slots(layout, s), testing::Contains("random.light.U"));
  s.filter_features = true;
  EXPECT_THAT(needed_slots(layout, s), testing::Contains("feature.N2.X"));
}

TEST_F(EveryMethodEstimate, TellsItsProgressToTheEndAndStopsWhereItIsTold) {
  const SampleBuffer samples = every_input({150, 120, 2, 1});
  double last = 0;
  int calls = 0;
  Control control;
  control.progress = [&](const Progress& p) {
    EXPECT_GE(p.fraction, last);
    last = p.fraction;
    ++calls;
    return true;
  };
  filter(samples, settings(), control);
  EXPECT_NEAR(last, 1, 1e-6);
  const int all = calls;
  EXPECT_GT(all, 10);
  calls = 0;
  control.progress = [&](const Progress&) { return ++calls < all / 2; };
  try {
    filter(samples, settings(), control);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::cancelled);
    EXPECT_EQ(calls, all / 2);
  }
}

TEST_F(EveryMethodEstimate, RefusesAGroupThatItDoesNotLookAt) {
  SampleBuffer samples = every_input({9, 9, 3, 1});
  test::add_channel(samples, "feature.uv.U", 0.5F);
  Settings s = settings();
  s.features = std::vector<std::string>{"N", "uv"};
  try {
    estimate(samples, s);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::usage);
    EXPECT_THAT(e.what(), testing::HasSubstr("'uv'"));
  }
}

}  // namespace
}  // namespace rpf
