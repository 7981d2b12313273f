#include "rpf/metrics.h"

#include <gtest/gtest.h>

#include "rpf/error.h"

namespace rpf {
namespace {

Image two_pixels(std::vector<float> pixels, std::vector<std::string> channels = {"R", "G", "B"}) {
  Image image;
  image.data_window = image.display_window = {0, 0, 2, 1};
  image.channels = std::move(channels);
  image.pixels = std::move(pixels);
  return image;
}

TEST(CompareImages, FollowsItsDefinition) {
  const Image a = two_pixels({1, 2, 3, 4, 5, 6}), b = two_pixels({1, 2, 3, 4, 5, 8});
  const ImageError error = compare_images(a, b);
  EXPECT_DOUBLE_EQ(error.mse, 4.0 / 6);
  EXPECT_DOUBLE_EQ(error.relmse, 4.0 / (64 + 0.01) / 6);
  EXPECT_DOUBLE_EQ(error.energy, 21.0 / 23);
}

TEST(CompareImages, FindsChannelsByName) {
  const Image a = two_pixels({3, 2, 1, 0, 6, 5, 4, 0}, {"B", "G", "R", "A"}), b = two_pixels({1, 2, 3, 4, 5, 6});
  EXPECT_EQ(compare_images(a, b).mse, 0.0);
}

TEST(CompareImages, RefusesWhatCannotBeCompared) {
  Image small = two_pixels({1, 2, 3});
  small.data_window.width = 1;
  EXPECT_THROW(compare_images(small, two_pixels({1, 2, 3, 4, 5, 6})), Error);
  EXPECT_THROW(compare_images(two_pixels({1, 2}, {"Y"}), two_pixels({1, 2, 3, 4, 5, 6})), Error);
}

}  // namespace
}  // namespace rpf
