// Errors as colors.
#pragma once

#include <array>
#include <cstdint>

#include "rpf/image.h"

namespace rpf::report {

/// What the ends of the color map stand for; between them it is logarithmic. Fixed, so that pictures can be compared.
constexpr double darkest_error = 1e-4, brightest_error = 1;

/// 0xRRGGBB in sRGB, from dark to bright.
extern const std::array<std::uint32_t, 256> magma;

/// Linear light of 0xRRGGBB.
std::array<float, 3> linear_light(std::uint32_t rgb);

/// Linear light of the color at `position`, 0 dark to 1 bright; writing the picture makes sRGB of it again. NaN: 1.
std::array<float, 3> color_at(double position);

/// The one channel of `errors` in colors. NaN has the brightest.
Image heat_map(const Image& errors);

/// The picture with a bar of all colors at its right, the brightest on top, and a tick at each power of ten.
Image with_legend(const Image& picture);

}  // namespace rpf::report
