#include "rpf/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rpf/error.h"
#include "tolerances.h"

namespace rpf {
namespace {

Image two_pixels(std::vector<float> pixels, std::vector<std::string> channels = {"R", "G", "B"}) {
  Image image;
  image.data_window = image.display_window = {0, 0, 2, 1};
  image.channels = std::move(channels);
  image.pixels = std::move(pixels);
  return image;
}

Image gray(int width, int height, float value) {
  Image image;
  image.data_window = image.display_window = {0, 0, width, height};
  image.channels = {"R", "G", "B"};
  image.pixels.assign(image.data_window.pixel_count() * 3, value);
  return image;
}

void set_pixel(Image& image, std::size_t index, float value) {
  for (int c = 0; c < 3; ++c) image.pixel(index)[c] = value;
}

TEST(CompareImages, FollowsItsDefinition) {
  const Image a = two_pixels({1, 2, 3, 4, 5, 6}), b = two_pixels({1, 2, 3, 4, 5, 8});
  const ImageError error = compare_images(a, b);
  EXPECT_DOUBLE_EQ(error.mse, 4.0 / 6);
  EXPECT_DOUBLE_EQ(error.relmse, 4.0 / (64 + 0.01) / 6);
  EXPECT_DOUBLE_EQ(error.mae, 2.0 / 6);
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
  EXPECT_THROW(relative_error_map(small, two_pixels({1, 2, 3, 4, 5, 6})), Error);
}

TEST(CompareImages, EqualImagesAreBestInEveryMetric) {
  const Image image = two_pixels({1, 2, 3, 4, 5, 6});
  const ImageError error = compare_images(image, image);
  for (const double zero : {error.mse, error.relmse, error.trimmed_relmse, error.mae, error.flip}) EXPECT_EQ(zero, 0.0);
  EXPECT_EQ(error.energy, 1.0);
  EXPECT_EQ(error.psnr, std::numeric_limits<double>::infinity());
}

TEST(CompareImages, FindsTheLargestDifferenceOfEachChannel) {
  Image a = two_pixels({1, 2, 3, 4, 5, 6});
  Image b = two_pixels({1, 9, 3, 4, 6, 4});
  a.data_window = b.data_window = {-7, 3, 2, 1};
  const auto largest = compare_images(a, b).largest;
  const double differences[3] = {0, 7, 2};
  const int columns[3] = {-7, -7, -6};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(largest[c].difference, differences[c]);
    EXPECT_EQ(largest[c].x, columns[c]);
    EXPECT_EQ(largest[c].y, 3);
  }
}

TEST(CompareImages, FindsNaNAndShowsItInTheMeans) {
  Image image = gray(40, 50, 1);
  set_pixel(image, 3, 100);
  image.pixel(85)[1] = std::numeric_limits<float>::quiet_NaN();
  const ImageError error = compare_images(image, gray(40, 50, 1));
  EXPECT_TRUE(std::isnan(error.relmse));
  EXPECT_TRUE(std::isnan(error.psnr));
  EXPECT_TRUE(std::isnan(error.largest[1].difference));
  EXPECT_EQ(error.largest[1].x, 5);
  EXPECT_EQ(error.largest[1].y, 2);
  EXPECT_EQ(error.trimmed_relmse, 0.0) << "the two worst of 2,000 pixels are left out, NaN first";
}

TEST(TrimmedRelmse, LeavesOutOnePixelInAThousand) {
  const Image reference = gray(50, 40, 1);
  Image image = gray(50, 40, 2);
  set_pixel(image, 0, 100);
  set_pixel(image, 1999, 100);
  EXPECT_NEAR(compare_images(image, reference).trimmed_relmse, 1 / 1.01, 1e-12);
  set_pixel(image, 700, 11);
  EXPECT_NEAR(compare_images(image, reference).trimmed_relmse, (1997 + 100) / 1.01 / 1998, 1e-12);
}

TEST(TrimmedRelmse, LeavesOutNothingBelowAThousandPixels) {
  Image image = gray(37, 27, 1);
  set_pixel(image, 5, 2);
  EXPECT_NEAR(compare_images(image, gray(37, 27, 1)).trimmed_relmse, 1 / 1.01 / 999, 1e-15);
}

TEST(RelativeErrorMap, IsTheErrorOfEachPixelWhereTheReferenceStands) {
  Image reference = two_pixels({1, 2, 3, 4, 5, 8});
  Image image = two_pixels({1, 2, 4, 4, 5, 6});
  reference.data_window.x = image.data_window.x = 9;
  const Image map = relative_error_map(image, reference);
  EXPECT_EQ(map.channels, std::vector<std::string>{"relMSE"});
  EXPECT_EQ(map.data_window, reference.data_window);
  EXPECT_FLOAT_EQ(map.pixels[0], 1 / 9.01F / 3);
  EXPECT_FLOAT_EQ(map.pixels[1], 4 / 64.01F / 3);
}

// ---- behind the tone curve

/// Linear light that a display shows as 1/2.
const float half_shown = static_cast<float>(std::pow((0.5 + 0.055) / 1.055, 2.4));

TEST(Psnr, IsTwentyLogarithmsOfTheDisplayedDifference) {
  EXPECT_NEAR(compare_images(gray(3, 2, half_shown), gray(3, 2, 0)).psnr, 20 * std::log10(2.0), 1e-6);
  EXPECT_NEAR(compare_images(gray(3, 2, 0.001F), gray(3, 2, 0)).psnr, -20 * std::log10(0.01292), 1e-6);
}

TEST(Psnr, KnowsNoLightBeyondTheDisplay) {
  EXPECT_NEAR(compare_images(gray(3, 2, 7), gray(3, 2, -7)).psnr, 0, 1e-12);
  EXPECT_EQ(compare_images(gray(3, 2, 7), gray(3, 2, 1)).psnr, std::numeric_limits<double>::infinity());
}

TEST(Ssim, OfFlatImagesComparesTheirLuminance) {
  const double expected = (2 * 0.5 * 1 + 0.0001) / (0.5 * 0.5 + 1 * 1 + 0.0001);
  EXPECT_NEAR(compare_images(gray(13, 12, half_shown), gray(13, 12, 1)).ssim, expected, 1e-6);
}

TEST(Ssim, OfOnePointFollowsFromTheWindowsCenter) {
  Image point = gray(11, 11, 0);
  set_pixel(point, 60, 1);
  double sum = 0;
  for (int d = -5; d <= 5; ++d) sum += std::exp(-d * d / 4.5);
  const double w = 1 / (sum * sum), c1 = 0.0001, c2 = 0.0009;
  EXPECT_NEAR(compare_images(point, gray(11, 11, 0)).ssim, c1 * c2 / ((w * w + c1) * (w - w * w + c2)), 1e-12);
}

TEST(Ssim, NeedsAWholeWindow) {
  EXPECT_TRUE(std::isnan(compare_images(gray(10, 11, 0), gray(10, 11, 0)).ssim));
  EXPECT_EQ(compare_images(gray(11, 11, 0), gray(11, 11, 0)).ssim, 1.0);
}

TEST(Flip, OfBlackAndWhiteFollowsFromPublishedColors) {
  // CIE L*a*b* of sRGB's green and blue (D65), a* and b* times L* / 100: the largest distance that FLIP knows.
  const double green[3] = {87.7347, -86.1827 * 0.877347, 83.1793 * 0.877347};
  const double blue[3] = {32.2970, 79.1875 * 0.322970, -107.8602 * 0.322970};
  const double largest = std::pow(green[0] - blue[0] + std::hypot(green[1] - blue[1], green[2] - blue[2]), 0.7);
  const double distance = std::pow(100, 0.7), knee = 0.4 * largest;
  const double expected = 0.95 + 0.05 * (distance - knee) / (largest - knee);
  EXPECT_NEAR(compare_images(gray(4, 3, 5), gray(4, 3, -1)).flip, expected, test::tolerance::flip);
}

TEST(Flip, OfAnEdgeAndAPointIsThatOfItsAuthors) {
  Image flat = gray(24, 16, 0);
  for (std::size_t p = 0; p < flat.pixels.size() / 3; ++p) {
    flat.pixel(p)[0] = 0.25F;
    flat.pixel(p)[1] = 0.5F;
    flat.pixel(p)[2] = 0.75F;
  }
  Image drawn = flat;
  for (std::size_t p = 0; p < flat.pixels.size() / 3; ++p)
    if (p % 24 >= 10) {
      drawn.pixel(p)[0] = 0.75F;
      drawn.pixel(p)[2] = 0.125F;
    }
  set_pixel(drawn, 7 * 24 + 4, 1);
  // flip_evaluator 1.7 of the two after the sRGB transfer function.
  EXPECT_NEAR(compare_images(flat, drawn).flip, 0.608609676, test::tolerance::flip_in_single_precision);
}

TEST(Flip, IsSymmetricAndWithinZeroAndOne) {
  Image a = gray(20, 20, 0.2F), b = gray(20, 20, 0.3F);
  set_pixel(a, 210, 1);
  const double flip = compare_images(a, b).flip;
  EXPECT_DOUBLE_EQ(flip, compare_images(b, a).flip);
  EXPECT_GT(flip, 0);
  EXPECT_LT(flip, 1);
}

}  // namespace
}  // namespace rpf
