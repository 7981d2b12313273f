// Synthetic scenes: what every one of them promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "every_scene.h"
#include "rpf/error.h"
#include "rpf/scene.h"
#include "same_bits.h"
#include "scene/renderer.h"

namespace {

using rpf::SampleBuffer;
using rpf::SceneOptions;
using testing::HasSubstr;

SceneOptions small(int samples = 3) {
  SceneOptions options;
  options.width = 25;
  options.height = 14;
  options.samples = samples;
  options.threads = 1;
  return options;
}

bool same_bits(const SampleBuffer& a, const SampleBuffer& b) {
  return a.first_sample == b.first_sample && rpf::test::same_bits(a.values, b.values);
}

/// All values of a channel.
std::vector<float> channel(const SampleBuffer& samples, const std::string& slot) {
  const std::size_t column = samples.layout.find(slot).value();
  std::vector<float> values;
  for (std::size_t i = 0; i < samples.sample_count(); ++i) values.push_back(samples.record(i)[column]);
  return values;
}

double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  const auto n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) sum_a += a[i], sum_b += b[i];
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double da = a[i] - sum_a / n, db = b[i] - sum_b / n;
    aa += da * da, bb += db * db, ab += da * db;
  }
  return ab / std::sqrt(aa * bb);
}

bool is_zero(const SampleBuffer& samples, const std::string& slot) {
  const std::vector<float> values = channel(samples, slot);
  return std::all_of(values.begin(), values.end(), [](float v) { return v == 0; });
}

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, IsTheSameWithPenumbrasAndLightField) {
  SceneOptions options = small();
  const SampleBuffer plain = render_scene(GetParam(), options);
  options.penumbra = options.lightfield = true;
  const SampleBuffer more = render_scene(GetParam(), options);
  for (const std::string& slot : plain.layout.slots)
    for (std::size_t i = 0; i < plain.sample_count(); ++i) {
      const float a = plain.record(i)[*plain.layout.find(slot)], b = more.record(i)[*more.layout.find(slot)];
      ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << slot;
    }
  EXPECT_EQ(is_zero(more, "feature.penumbra.slope"), is_zero(more, "feature.penumbra.width"));
  for (std::size_t i = 0; i < more.sample_count() && is_zero(more, "random.time"); ++i)
    for (const std::string axis : {"X", "Y", "Z"}) {
      const auto of = [&](const std::string& group) { return *more.layout.find("feature." + group + "." + axis); };
      const float* record = more.record(i);
      const float place = record[of("P")], opening = record[of("opening")], closing = record[of("closing")];
      ASSERT_TRUE(std::isnan(place) ? std::isnan(opening) : opening == place && closing == place) << i;
    }
}

TEST_P(EveryScene, HasFiniteRadianceThatIsNotNegative) {
  const SampleBuffer samples = render_scene(GetParam(), small());
  samples.validate();
  EXPECT_EQ(samples.sample_count(), 25U * 14 * 3);
  double sum = 0;
  for (const char* slot : {"R", "G", "B"})
    for (const float value : channel(samples, slot)) {
      ASSERT_TRUE(std::isfinite(value) && value >= 0) << slot << " " << value;
      sum += value;
    }
  EXPECT_GT(sum, 0);
}

TEST_P(EveryScene, HasItsFilmSamplesInTheirPixels) {
  const SampleBuffer samples = render_scene(GetParam(), small());
  const std::vector<float> x = channel(samples, "film.X"), y = channel(samples, "film.Y");
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    ASSERT_EQ(std::floor(x[i]), static_cast<float>(i / 3 % 25));
    ASSERT_EQ(std::floor(y[i]), static_cast<float>(i / 3 / 25));
  }
}

TEST_P(EveryScene, HasRandomNumbersFromZeroToOneAndZerosForUnusedOnes) {
  const SampleBuffer samples = render_scene(GetParam(), small());
  const rpf::scene::Usage usage = rpf::scene::Renderer(GetParam(), small()).usage();
  for (const std::string& slot : samples.layout.slots) {
    if (!rpf::is_random_slot(slot)) continue;
    for (const float value : channel(samples, slot)) ASSERT_TRUE(value >= 0 && value < 1) << slot << " " << value;
    const std::string group = rpf::group_of(slot);
    const bool used = group == "lens"    ? usage.lens
                      : group == "time"  ? usage.time
                      : group == "light" ? usage.light
                                         : usage.bsdf;
    EXPECT_EQ(is_zero(samples, slot), !used) << slot;
  }
}

TEST_P(EveryScene, HasFeaturesExactlyWhereThereIsAHit) {
  const SampleBuffer samples = render_scene(GetParam(), small());
  const std::vector<float> hit = channel(samples, "feature.hit"), second = channel(samples, "feature.P2.X");
  for (const std::string& slot : samples.layout.slots) {
    if (!rpf::is_feature_slot(slot)) continue;
    const bool of_second = rpf::group_of(slot).back() == '2';
    const std::vector<float> values = channel(samples, slot);
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_TRUE(hit[i] == 0 || hit[i] == 1);
      const bool expected = of_second ? !std::isnan(second[i]) : hit[i] == 1;
      ASSERT_EQ(std::isfinite(values[i]), expected) << slot << " of sample " << i;
      ASSERT_LE(std::isfinite(second[i]) ? 1 : 0, hit[i]);
    }
  }
}

TEST_P(EveryScene, HasTheSameBitsForAnyNumberOfThreadsAndAnyPieces) {
  SceneOptions options = small();
  const SampleBuffer once = render_scene(GetParam(), options);
  EXPECT_TRUE(same_bits(once, render_scene(GetParam(), options)));
  rpf::Control pieces;
  pieces.tile_pixels = 7;
  options.threads = 2;
  EXPECT_TRUE(same_bits(once, render_scene(GetParam(), options, pieces)));
  options.seed = 2;
  EXPECT_FALSE(same_bits(once, render_scene(GetParam(), options)));
}

TEST_P(EveryScene, HasTheSameBitsRowsByRows) {
  SceneOptions options = small();
  options.adaptive = true;
  const SampleBuffer once = render_scene(GetParam(), options);
  const auto rows = rpf::open_scene_rows(GetParam(), options);
  SampleBuffer joined = rows->frame();
  joined.first_sample = {0};
  for (int y = 0, end = 0; y < options.height; y = end) {
    end = std::min(y + 3, options.height);
    const SampleBuffer part = rows->read(y, end);
    std::uint64_t samples = 0;
    for (int row = y; row < end; ++row) samples += rows->row_samples(row);
    EXPECT_EQ(part.sample_count(), samples);
    EXPECT_EQ(part.data_window, (rpf::Window{0, y, options.width, end - y}));
    const std::uint32_t before = joined.first_sample.back();
    for (std::size_t p = 1; p < part.first_sample.size(); ++p)
      joined.first_sample.push_back(before + part.first_sample[p]);
    joined.values.insert(joined.values.end(), part.values.begin(), part.values.end());
  }
  EXPECT_TRUE(same_bits(once, joined));
  EXPECT_EQ(once.metadata, joined.metadata);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(rpf::test::scene_names()), rpf::test::name_of_scene);

TEST(Scene, ConstantIsExact) {
  const SampleBuffer samples = render_scene("constant", small());
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    ASSERT_THAT(std::vector<float>(samples.record(i), samples.record(i) + 3), testing::ElementsAre(0.25F, 0.5F, 0.75F));
  const rpf::Image reference = render_reference("constant", small(5));
  for (std::size_t p = 0; p < 25 * 14; ++p)
    ASSERT_THAT(std::vector<float>(reference.pixel(p), reference.pixel(p) + 3),
                testing::ElementsAre(0.25F, 0.5F, 0.75F));
  EXPECT_EQ(std::get<float>(reference.metadata.at("rpf:residualRelMSE")), 0.0F);
}

TEST(Scene, TwoValuesAreDecidedByLensTimeAndAlbedo) {
  const SampleBuffer samples = render_scene("two-values", small(40));
  const std::vector<float> red = channel(samples, "R"), green = channel(samples, "G"), blue = channel(samples, "B");
  const std::vector<float> lens = channel(samples, "random.lens.U"), time = channel(samples, "random.time"),
                           albedo = channel(samples, "feature.albedo.R");
  for (std::size_t i = 0; i < red.size(); ++i) {
    ASSERT_EQ(red[i], lens[i] < 0.5F ? 0.25F : 0.75F);
    ASSERT_EQ(green[i], time[i] < 0.5F ? 0.25F : 0.75F);
    ASSERT_EQ(blue[i], albedo[i]);
  }
  for (const auto& channels : {std::pair{red, green}, {red, blue}, {green, blue}, {blue, lens}, {blue, time}})
    EXPECT_LT(std::fabs(correlation(channels.first, channels.second)), 4 / std::sqrt(25 * 14 * 40.0));
}

TEST(Scene, NoiseDependsOnNothing) {
  const SampleBuffer samples = render_scene("noise", small(40));
  const std::vector<float> red = channel(samples, "R");
  for (const std::string& slot : samples.layout.slots)
    if (slot != "R" && slot != "feature.hit") {
      EXPECT_LT(std::fabs(correlation(red, channel(samples, slot))), 4 / std::sqrt(25 * 14 * 40.0)) << slot;
    }
}

TEST(Scene, AdaptiveCountsGoFromZeroToTwiceTheMean) {
  SceneOptions options = small(4);
  options.adaptive = true;
  const SampleBuffer samples = render_scene("dof", options);
  samples.validate();
  std::vector<int> pixels_with(9);
  for (std::size_t p = 0; p < 25 * 14; ++p) ++pixels_with.at(samples.first_sample[p + 1] - samples.first_sample[p]);
  for (const int pixels : pixels_with) EXPECT_GT(pixels, 15);  // 39 expected, 6 is one standard deviation
  const std::vector<float> x = channel(samples, "film.X");
  for (std::size_t p = 0; p < 25 * 14; ++p)
    for (std::size_t i = samples.first_sample[p]; i < samples.first_sample[p + 1]; ++i)
      ASSERT_EQ(std::floor(x[i]), static_cast<float>(p % 25));
}

TEST(Scene, DensityDecidesTheCounts) {
  SceneOptions options = small(4);
  rpf::Image density;
  density.data_window = {0, 0, 25, 14};
  density.channels = {"Y"};
  density.pixels.assign(25 * 14, 0.375F);  // 1.5 samples
  density.pixels[0] = 0;
  density.pixels[1] = 2;
  options.density = density;
  const SampleBuffer samples = render_scene("dof", options);
  EXPECT_EQ(samples.first_sample[1], 0U);
  EXPECT_EQ(samples.first_sample[2], 8U);
  for (std::size_t p = 2; p < 25 * 14; ++p) {
    const unsigned count = samples.first_sample[p + 1] - samples.first_sample[p];
    ASSERT_TRUE(count == 1 || count == 2);
  }
  EXPECT_NEAR(samples.sample_count(), 8 + 1.5 * 348, 40);  // four standard deviations
  options.density->pixels[5] = -1;
  EXPECT_THROW(render_scene("dof", options), rpf::Error);
  options.density->pixels[5] = 1;
  EXPECT_NO_THROW(render_scene("dof", options));
  for (const rpf::Window& other : {rpf::Window{0, 0, 5, 14}, {1, 0, 25, 14}, {0, -3, 25, 14}}) {
    options.density->data_window = other;
    EXPECT_THROW(render_scene("dof", options), rpf::Error);
  }
}

TEST(Scene, WorldScaleAndOffsetMovePositionsAndNothingElse) {
  SceneOptions options = small();
  const SampleBuffer plain = render_scene("glossy", options);
  options.world_scale = 100;
  options.world_offset = {1e7F, -3, 0.5F};
  const SampleBuffer moved = render_scene("glossy", options);
  ASSERT_EQ(plain.sample_count(), moved.sample_count());
  for (std::size_t c = 0; c < plain.layout.size(); ++c) {
    const std::string& slot = plain.layout.slots[c];
    const std::string group = rpf::group_of(slot);
    const bool is_position = group == "P" || group == "P2";
    const std::size_t axis = slot.back() - 'X';
    for (std::size_t i = 0; i < plain.sample_count(); ++i) {
      const float before = plain.record(i)[c], after = moved.record(i)[c];
      if (std::isnan(before))
        ASSERT_TRUE(std::isnan(after)) << slot;
      else
        ASSERT_EQ(after, is_position ? static_cast<float>(100.0 * before + options.world_offset.at(axis)) : before)
            << slot;
    }
  }
}

TEST(Scene, FilmPositionsDoNotRoundIntoTheNextPixel) {
  for (const std::size_t pixel : {std::size_t{0}, std::size_t{1}, std::size_t{479}, std::size_t{1048575}})
    for (const float offset : {0.0F, 0.5F, 0x1.fffffep-1F})
      EXPECT_EQ(std::floor(rpf::scene::film_position(pixel, offset)), static_cast<float>(pixel));
}

// Each channel of two-values has the mean 0.5 and the variance 1/16.
TEST(Scene, ReferenceKnowsItsOwnError) {
  for (const int samples : {64, 65}) {
    SceneOptions options = small(samples);
    const rpf::Image reference = render_reference("two-values", options);
    EXPECT_EQ(std::get<std::int32_t>(reference.metadata.at("rpf:samplesPerPixel")), samples);
    double error = 0;
    for (const float value : reference.pixels) error += (value - 0.5) * (value - 0.5) / 0.26;
    error /= static_cast<double>(reference.pixels.size());
    EXPECT_NEAR(error, 1.0 / 16 / samples / 0.26, 0.2 * error);
    EXPECT_NEAR(std::get<float>(reference.metadata.at("rpf:residualRelMSE")), error, 0.2 * error);
    EXPECT_EQ(reference.pixels, render_reference("two-values", options).pixels);
  }
}

TEST(Scene, ReferenceIsDrawnApartFromTheSamplesOfTheSameSeed) {
  const SampleBuffer samples = render_scene("noise", small(2));
  const std::vector<float> red = channel(samples, "R");
  const rpf::Image reference = render_reference("noise", small(2));
  std::vector<float> means, others;
  for (std::size_t p = 0; p < 25 * 14; ++p) {
    means.push_back(red[2 * p] + red[2 * p + 1]);
    others.push_back(reference.pixel(p)[0]);
  }
  EXPECT_LT(std::fabs(correlation(means, others)), 4 / std::sqrt(25 * 14.0));
}

void expect_usage_error(const std::string& name, const SceneOptions& options, const std::string& text) {
  try {
    render_scene(name, options);
    ADD_FAILURE() << "no error that says " << text;
  } catch (const rpf::Error& error) {
    EXPECT_EQ(error.kind(), rpf::ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr(text));
  }
}

TEST(Scene, RefusesWhatCannotBe) {
  expect_usage_error("door", small(), "dof, dof-edge");
  expect_usage_error("dof", small(0), "number of samples");
  SceneOptions options = small();
  options.width = 0;
  expect_usage_error("dof", options, "width");
  options = small();
  options.world_scale = 0;
  expect_usage_error("dof", options, "world scale");
  options = small();
  options.world_offset[2] = INFINITY;
  expect_usage_error("dof", options, "world offset");
  EXPECT_THROW(render_reference("dof", small(1)), rpf::Error);
}

TEST(Scene, StopsOnRequest) {
  rpf::Control control;
  control.tile_pixels = 10;
  int calls = 0;
  control.progress = [&](const rpf::Progress& progress) {
    EXPECT_NEAR(progress.fraction, ++calls * 10.0 / (25 * 14), 1e-9);
    return calls < 3;
  };
  try {
    render_scene("dof", small(), control);
    ADD_FAILURE() << "not cancelled";
  } catch (const rpf::Error& error) {
    EXPECT_EQ(error.kind(), rpf::ErrorKind::cancelled);
  }
  EXPECT_EQ(calls, 3);
}

}  // namespace
