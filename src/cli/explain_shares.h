// Shares of samples in a color, as the pages about one pixel show them.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace rpf::cli {

/// Of the samples with the largest shares, so many are listed.
constexpr std::size_t listed_shares = 20;

std::string number(float value);
std::string color_text(const std::array<float, 3>& color);

/// SVG: how much so many of the largest shares have together. `shares` fall; `of`: "the filtered value".
std::string share_plot(const std::vector<float>& shares, const std::string& of);

}  // namespace rpf::cli
