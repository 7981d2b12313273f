#include "report/legend.h"

#include <fmt/format.h>

#include "report/heat_map.h"
#include "report/html_text.h"
#include "report/palette.h"

namespace rpf::report {

std::string legend_html(const Legend& legend) {
  if (legend.entries.empty()) return "";
  std::string html = "<div class=\"legend\">";
  if (legend.continuous) {
    std::string colors;
    for (const Legend::Entry& entry : legend.entries) colors += ", " + html_color(entry.color);
    html += fmt::format(
        "<span>{}</span><i class=\"bar\" style=\"background: linear-gradient(90deg{})\"></i><span>{}</span>",
        escaped(legend.entries.front().text), colors, escaped(legend.entries.back().text));
  } else {
    for (const Legend::Entry& entry : legend.entries)
      html +=
          fmt::format("<span><i style=\"background: {}\"></i>{}</span>", html_color(entry.color), escaped(entry.text));
  }
  return html + "</div>";
}

Legend magma_legend(const std::string& least, const std::string& most) {
  Legend legend;
  legend.continuous = true;
  for (std::size_t i = 0; i < magma.size(); i += 15) legend.entries.push_back({magma.at(i), ""});
  legend.entries.front().text = least;
  legend.entries.back().text = most;
  return legend;
}

}  // namespace rpf::report
