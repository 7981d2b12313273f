// What pixels of many samples have of their own mean (docs/network.md, "Many samples").
#include "run/plain_means.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace rpf {
namespace {

constexpr float of_one[] = {1, 1, 1};
constexpr float same[] = {1, 1, 1}, apart[] = {2, 1, 1};

TEST(OwnShare, IsNothingOfFewSamplesAndAllOfEndlesslyMany) {
  EXPECT_EQ(own_share(1, of_one, same, 1), 0);
  EXPECT_EQ(own_share(45, of_one, same, 1), 0);
  EXPECT_DOUBLE_EQ(own_share(4 * 45, of_one, same, 1), 0.5);  // 1 - sqrt(1/4)
  EXPECT_GT(own_share(4000000000U, of_one, apart, 1), 0.999);
}

TEST(OwnShare, IsLessWhereResultAndMeanAreApart) {
  // d = 1 / (3 + 0.06), so that (40 d)^2 = 170.87; n / (n + 170.87) of 1/2
  EXPECT_NEAR(own_share(180, of_one, apart, 1), 0.5 * 180 / (180 + 170.8744), 1e-6);
}

TEST(OwnShare, HasNoUnitOfRadiance) {
  const float result[] = {256, 256, 256};
  const float mean[] = {512, 256, 256};
  EXPECT_EQ(own_share(180, result, mean, 1.0F / 256), own_share(180, of_one, apart, 1));
}

/// Of one row, without samples yet; all but its last pixels are in the crop.
PreparedFrame row_of(std::vector<std::uint32_t> first_sample, int crop_width, std::size_t carried) {
  PreparedFrame prepared;
  prepared.facts.width = prepared.frame.width = static_cast<int>(first_sample.size()) - 1;
  prepared.facts.height = prepared.frame.height = 1;
  prepared.facts.carried = carried;
  prepared.facts.crop = {0, 0, crop_width, 1};
  prepared.facts.max_samples_per_pixel = first_sample.back();  // or fewer
  prepared.frame.variables = 3;
  prepared.frame.first_sample = std::move(first_sample);
  return prepared;
}

TEST(PlainMeans, CountSamplesByTheirWeights) {
  PreparedFrame prepared = row_of({0, 400}, 1, 3);
  Frame& frame = prepared.frame;
  frame.records.assign(1200, 1);
  for (int i = 0; i < 400; ++i) frame.weights.push_back(i < 90 ? 3.0F : i < 180 ? 1.0F : 0.0F);
  PlainMeans means(prepared, 2);
  means.add_rows(0, 1);
  Pixels pixels = {0.99F, 1, 1};  // (90 (3 + 1))^2 / (90 (9 + 1)) = 144 samples
  const double share = own_share(144, pixels.data(), same, 1);
  EXPECT_GT(share, 0.3);
  means.draw_to_means(pixels, 1);
  EXPECT_EQ(pixels[0], drawn(0.99F, 1, share));
}

TEST(PlainMeans, AreDrawnToWherePixelsHaveManySamplesInTheCrop) {
  PreparedFrame prepared = row_of({0, 2, 182, 364}, 2, 4);  // 2, 180, 182 samples
  Frame& frame = prepared.frame;
  for (int i = 0; i < 364; ++i) {
    frame.records.insert(frame.records.end(), {i % 2 == 0 ? 0.0F : 2.0F, 1, 1});
    frame.others.push_back(i % 2 == 0 ? 3.0F : 5.0F);
  }
  PlainMeans means(prepared, 2);
  means.add_rows(0, 1);
  Pixels pixels = {7, 7, 7, 7, 1, 1, 1, 2, 7, 7, 7, 7};
  means.draw_to_means(pixels, 1);
  EXPECT_EQ(pixels, (Pixels{7, 7, 7, 7, 1, 1, 1, 3, 7, 7, 7, 7}));  // alpha: half of the way from 2 to 4
}

}  // namespace
}  // namespace rpf
