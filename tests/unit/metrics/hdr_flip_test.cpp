#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metrics/hdr_flip.h"
#include "rpf/metrics.h"
#include "tolerances.h"

namespace rpf {
namespace {

constexpr int width = 24, height = 16;

Image flat(float red, float green, float blue) {
  Image image;
  image.data_window = image.display_window = {0, 0, width, height};
  image.channels = {"R", "G", "B"};
  for (int p = 0; p < width * height; ++p) image.pixels.insert(image.pixels.end(), {red, green, blue});
  return image;
}

void set_pixel(Image& image, int x, int y, float red, float green, float blue) {
  float* pixel = image.pixel(static_cast<std::size_t>(y) * width + x);
  pixel[0] = red, pixel[1] = green, pixel[2] = blue;
}

/// A wall with a lamp of 40 times its light, and a picture of it with another right side, a firefly and a dark pixel.
struct Lamp {
  Image reference = flat(0.25F, 0.5F, 0.75F), image;

  Lamp() {
    for (int y = 3; y < 6; ++y)
      for (int x = 5; x < 9; ++x) set_pixel(reference, x, y, 40, 30, 8);
    image = reference;
    for (int y = 0; y < height; ++y)
      for (int x = 10; x < width; ++x) set_pixel(image, x, y, 0.75F, 0.5F, 0.125F);
    set_pixel(image, 4, 7, 100, 100, 100);
    set_pixel(image, 20, 12, 0.001F, 0.001F, 0.001F);
  }
};

metrics::ColorPlanes grays(std::vector<double> values) {
  const metrics::Plane plane{static_cast<int>(values.size()), 1, std::move(values)};
  return {plane, plane, plane};
}

TEST(HdrFlip, IsThatOfItsAuthors) {
  const Lamp lamp;
  // flip_evaluator 1.7 in its HDR mode.
  EXPECT_NEAR(compare_images(lamp.image, lamp.reference).hdr_flip, 0.583997905,
              test::tolerance::flip_in_single_precision);
}

TEST(HdrFlip, DoesNotDependOnTheUnitOfLight) {
  Lamp lamp;
  const double before = compare_images(lamp.image, lamp.reference).hdr_flip;
  for (Image* image : {&lamp.image, &lamp.reference})
    for (float& value : image->pixels) value *= 64;
  EXPECT_NEAR(compare_images(lamp.image, lamp.reference).hdr_flip, before, test::tolerance::exposure_rounding);
}

TEST(HdrFlip, SeesWhatADisplayCutsOff) {
  const Image reference = flat(30, 30, 30);
  const ImageError error = compare_images(flat(9, 9, 9), reference);
  EXPECT_EQ(error.flip, 0.0) << "both are white";
  EXPECT_GT(error.hdr_flip, 0.1);
  EXPECT_EQ(compare_images(reference, reference).hdr_flip, 0.0);
}

TEST(HdrFlip, IsNaNWhereTheImageIsAndANumberWhereLightIsInfiniteOrNegative) {
  const Image reference = flat(1, 1, 1);
  Image image = reference;
  set_pixel(image, 3, 3, std::numeric_limits<float>::infinity(), -1, 1);
  const double error = compare_images(image, reference).hdr_flip;
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 1);
  set_pixel(image, 3, 3, 1, std::numeric_limits<float>::quiet_NaN(), 1);
  EXPECT_TRUE(std::isnan(compare_images(image, reference).hdr_flip));
}

TEST(ExposureRange, ReachesFromTheBrightestPixelToTheMedian) {
  // (0.9036 x^2 + 0.018 x) / (0.8748 x^2 + 0.354 x + 0.14) = 0.85 at x = 2.118872.
  const double nearly_white = std::log2(2.118872);
  const metrics::ExposureRange range = metrics::exposure_range(grays({8, 1, 0.25, 0, 0.5, 4}));
  EXPECT_NEAR(range.first, nearly_white - 3, 1e-5);
  EXPECT_NEAR(range.last, nearly_white, 1e-5) << "the upper of the two middle pixels, 1";
  EXPECT_EQ(range.count, 3);
}

TEST(ExposureRange, HasTwoExposuresAtLeastAndEndsAboveBlack) {
  const metrics::ExposureRange same = metrics::exposure_range(grays({2, 2, 2}));
  EXPECT_EQ(same.first, same.last);
  EXPECT_EQ(same.count, 2);
  const metrics::ExposureRange dark = metrics::exposure_range(grays({0, 0, 0, 1}));
  EXPECT_NEAR(dark.last - dark.first, 23, 1e-9) << "the least median is 2^-23";
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(metrics::exposure_range(grays({nan, infinity, 2})).first, same.first);
  EXPECT_EQ(metrics::exposure_range(grays({nan, infinity})).count, 2);
}

}  // namespace
}  // namespace rpf
