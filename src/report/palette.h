// The colors that tell things apart.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace rpf::report {

/// 0xRRGGBB in sRGB, told apart by nearly everybody (Okabe and Ito).
constexpr std::uint32_t orange = 0xe69f00, sky_blue = 0x56b4e9, bluish_green = 0x009e73, yellow = 0xf0e442,
                        blue = 0x0072b2, vermillion = 0xd55e00, reddish_purple = 0xcc79a7, black = 0x000000;

/// What is drawn onto pictures: orange, in linear light.
constexpr std::array<float, 3> mark_color = {1.0F, 0.5F, 0.0F};

/// "#rrggbb".
std::string html_color(std::uint32_t color);

}  // namespace rpf::report
