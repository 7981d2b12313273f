#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "rpf/error.h"
#include "rpf/ranges.h"
#include "rpf/settings.h"

namespace rpf {
namespace {

void require(const char* option, double value, const NumberRange& range) {
  if (!range.has(value)) throw Error(ErrorKind::usage, fmt::format("{} {:.9g}: {}", option, value, range.expected()));
}

}  // namespace

bool NumberRange::has(double value) const {
  if (or_zero && value == 0) return true;
  // The floats nearest to the ends may lie beyond them.
  const auto as_float = [&](double end) { return whole ? end : static_cast<double>(static_cast<float>(end)); };
  if (!(value >= std::min(least, as_float(least)) && value <= std::max(most, as_float(most)))) return false;  // NaN too
  return (!whole || value == std::trunc(value)) && (!odd || std::fmod(value, 2) != 0);
}

std::string NumberRange::expected() const {
  return fmt::format("{}{} number from {:.10g} to {:.10g} is expected, such as {}", or_zero ? "0 or " : "",
                     odd     ? "an odd"
                     : whole ? "a whole"
                             : "a",
                     least, most, example);
}

void validate(const Settings& s) {
  for (const int width : s.box_widths) require("--boxes", width, ranges::box_width);
  if (s.box_widths.size() > 100)
    throw Error(ErrorKind::usage,
                fmt::format("--boxes: {} passes, at most 100 are possible; name fewer widths", s.box_widths.size()));
  require("--samples-factor", s.samples_factor.value_or(1), ranges::factor);
  require("--noise", s.noise, ranges::noise);
  require("--bins", s.bins, ranges::bins);
  require("--alpha-factor", s.alpha_factor, ranges::alpha_factor);
  require("--position-scale", s.position_scale, ranges::position_scale);
  require("--redraws", s.redraws, ranges::redraws);
  require("--sigma-color", s.sigma_color, ranges::sigma_color);
  require("--sigma-feature", s.sigma_feature, ranges::sigma_feature);
  require("--damping", s.damping, ranges::damping);
  require("--window", s.window, ranges::box_width);
  require("--gamma", s.gamma, ranges::gamma);
  require("--bandwidth", s.bandwidth, ranges::bandwidth);
  require("--views", s.views, ranges::views);
  if (s.threads != 0) require("--threads", s.threads, ranges::threads);  // 0: all cores
}

}  // namespace rpf
