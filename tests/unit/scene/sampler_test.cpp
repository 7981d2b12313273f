// The random numbers of synthetic scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "scene/random.h"
#include "scene/sampler.h"

namespace {

using rpf::SceneSampler;
using rpf::scene::Draw;
using rpf::scene::Pair;
using rpf::scene::PixelSampler;

/// How many different cells of a columns x rows grid the samples of a pair occupy.
std::size_t occupied(const PixelSampler& sampler, std::uint32_t count, int columns, int rows) {
  std::set<std::pair<int, int>> cells;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Pair p = sampler.pair(i, 1);
    cells.insert(
        {static_cast<int>(p.u * static_cast<float>(columns)), static_cast<int>(p.v * static_cast<float>(rows))});
  }
  return cells.size();
}

TEST(Sampler, PermutesAnyCount) {
  for (std::uint32_t count = 1; count < 70; ++count)
    for (const std::uint32_t key : {0U, 1U, 0xdeadbeefU}) {
      std::set<std::uint32_t> seen;
      for (std::uint32_t i = 0; i < count; ++i) seen.insert(rpf::scene::permute(i, count, key));
      ASSERT_EQ(seen.size(), count);
      ASSERT_EQ(*seen.rbegin(), count - 1);
    }
}

TEST(Sampler, StratifiedFillsItsGridAndBothAxes) {
  for (std::uint32_t key = 0; key < 20; ++key) {
    const PixelSampler twelve(SceneSampler::stratified, key, 12), five(SceneSampler::stratified, key, 5);
    EXPECT_EQ(occupied(twelve, 12, 3, 4), 12U);
    EXPECT_EQ(occupied(twelve, 12, 12, 1), 12U);
    EXPECT_EQ(occupied(twelve, 12, 1, 12), 12U);
    EXPECT_EQ(occupied(five, 5, 5, 1), 5U);
    EXPECT_EQ(occupied(five, 5, 1, 5), 5U);
  }
}

TEST(Sampler, SobolFillsEveryElementaryInterval) {
  for (std::uint32_t key = 0; key < 20; ++key) {
    const PixelSampler sampler(SceneSampler::sobol, key, 64);
    for (int columns = 1; columns <= 64; columns *= 2) EXPECT_EQ(occupied(sampler, 64, columns, 64 / columns), 64U);
  }
}

TEST(Sampler, RandomFillsNoGrid) {
  const PixelSampler sampler(SceneSampler::random, 1, 64);
  EXPECT_LT(occupied(sampler, 64, 8, 8), 55U);  // 41 expected
}

class EverySampler : public testing::TestWithParam<SceneSampler> {};

TEST_P(EverySampler, IsUniformFromZeroToBelowOne) {
  double sum = 0, squares = 0;
  constexpr int pixels = 5000;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const Pair p = PixelSampler(GetParam(), rpf::scene::hash(pixel), 4).pair(2, 0);
    for (const float value : {p.u, p.v}) {
      ASSERT_TRUE(value >= 0 && value < 1);
      sum += value;
      squares += static_cast<double>(value) * value;
    }
  }
  EXPECT_NEAR(sum / (2 * pixels), 0.5, 4 * std::sqrt(1.0 / 12 / (2 * pixels)));
  EXPECT_NEAR(squares / (2 * pixels), 1.0 / 3, 4 * std::sqrt(4.0 / 45 / (2 * pixels)));
}

// A sample's number says nothing about its values, and a value nothing about those of another dimension.
TEST_P(EverySampler, HasNoOrderInsideAPixel) {
  constexpr int pixels = 5000;
  constexpr std::uint32_t count = 4;
  double number_film = 0, film_lens = 0, lens_time = 0, film_bsdf = 0;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const PixelSampler sampler(GetParam(), rpf::scene::hash(pixel), count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Draw draw = sampler.draw(i);
      number_film += (i - 1.5) / 3.75 * (draw.film.u - 0.5);
      film_lens += (draw.film.u - 0.5) * (draw.lens.u - 0.5);
      lens_time += (draw.lens.v - 0.5) * (draw.time - 0.5);
      film_bsdf += (draw.film.v - 0.5) * (draw.bsdf.v - 0.5);
    }
  }
  // The standard deviation of one product of two independent uniform numbers is 1/12.
  const double limit = 4 * std::sqrt(static_cast<double>(pixels) * count) / 12;
  for (const double sum : {number_film, film_lens, lens_time, film_bsdf}) EXPECT_LT(std::fabs(sum), limit);
}

TEST_P(EverySampler, GivesEverySampleItsOwnFurtherNumbers) {
  std::set<std::uint32_t> keys;
  for (std::uint32_t pixel = 0; pixel < 100; ++pixel)
    for (std::uint32_t i = 0; i < 16; ++i) keys.insert(PixelSampler(GetParam(), pixel, 16).draw(i).further);
  EXPECT_EQ(keys.size(), 1600U);
}

INSTANTIATE_TEST_SUITE_P(Samplers, EverySampler,
                         testing::Values(SceneSampler::random, SceneSampler::stratified, SceneSampler::sobol));

}  // namespace
