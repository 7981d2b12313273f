#include "report/palette.h"

#include <fmt/format.h>

namespace rpf::report {

std::string html_color(std::uint32_t color) { return fmt::format("#{:06x}", color & 0xffffffU); }

}  // namespace rpf::report
