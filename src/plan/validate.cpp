#include "plan/validate.h"

#include <fmt/format.h>

#include "rpf/error.h"

namespace rpf {
namespace {

void require(bool holds, const std::string& message) {
  if (!holds) throw Error(ErrorKind::usage, message);
}

}  // namespace

void validate(const Settings& s) {
  for (const int b : s.box_widths)
    require(b >= 1 && b <= 255 && b % 2 == 1,
            fmt::format("box width {}: an odd number of pixels from 1 to 255 is expected", b));
  require(s.box_widths.size() <= 100, fmt::format("{} passes: at most 100 are possible", s.box_widths.size()));
  require(!s.samples_factor || (*s.samples_factor > 0 && *s.samples_factor <= 1e6),
          fmt::format("samples factor {}: a number above 0 and up to 1e6 is expected", s.samples_factor.value_or(0)));
  require(
      !s.neighbors_factor || (*s.neighbors_factor > 0 && *s.neighbors_factor <= 1e6),
      fmt::format("neighbors factor {}: a number above 0 and up to 1e6 is expected", s.neighbors_factor.value_or(0)));
  require(s.statistics_block >= 1 && s.statistics_block <= 16,
          fmt::format("statistics block {}: a width from 1 to 16 pixels is expected", s.statistics_block));
  require(s.noise >= 1e-12F && s.noise <= 1e12F,
          fmt::format("noise {}: a number from 1e-12 to 1e12 is expected, such as 0.02", s.noise));
  require(s.bins >= 3 && s.bins <= 31 && s.bins % 2 == 1,
          fmt::format("bins {}: an odd number from 3 to 31 is expected", s.bins));
  require(s.alpha_factor >= 0 && s.alpha_factor <= 1e6F,
          fmt::format("alpha factor {}: a number from 0 to 1e6 is expected", s.alpha_factor));
  require(s.position_scale >= 1e-6F && s.position_scale <= 1e6F,
          fmt::format("position scale {}: a number from 1e-6 to 1e6 is expected", s.position_scale));
  require(s.redraws >= 0 && s.redraws <= 15, fmt::format("redraws {}: a number from 0 to 15 is expected", s.redraws));
  require(s.sigma_color >= 1e-30F && s.sigma_color <= 1e30F,
          fmt::format("sigma color {}: a radiance from 1e-30 to 1e30 is expected, such as 30", s.sigma_color));
  require(s.sigma_feature >= 1e-6F && s.sigma_feature <= 1e6F,
          fmt::format("sigma feature {}: a number from 1e-6 to 1e6 is expected, such as 0.5", s.sigma_feature));
  require(s.polish == 0 || (s.polish >= 1e-3F && s.polish <= 10),
          fmt::format("polish {}: 0 or a number from 0.001 to 10 is expected, such as 0.15", s.polish));
  require(s.threads >= 0, fmt::format("threads {}: a positive number is expected, or 0 for all cores", s.threads));
}

}  // namespace rpf
