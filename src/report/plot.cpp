#include "report/plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bench/child.h"
#include "io/checked_writer.h"
#include "report/palette.h"
#include "rpf/error.h"

namespace rpf::report {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The lines of a plot take them in turns; from the second turn on they are dashed.
constexpr std::uint32_t colors[] = {blue, vermillion, bluish_green, reddish_purple, orange, sky_blue, black};

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += c == '\n' ? ' ' : c;  // a line break would end the command
  }
  return result + "'";
}

bool can_be_drawn(const Plot& plot, const std::array<double, 2>& point) {
  return std::isfinite(point[0]) && std::isfinite(point[1]) && (!plot.log_x || point[0] > 0) &&
         (!plot.log_y || point[1] > 0);
}

std::string data_of(const Plot& plot) {
  std::string text;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    text += fmt::format("$curve{} << EOD\n", i);
    for (const auto& point : plot.curves[i].points)
      if (can_be_drawn(plot, point)) text += fmt::format("{:.9g} {:.9g}\n", point[0], point[1]);
    text += "EOD\n";
  }
  return text;
}

std::string axes_of(const Plot& plot) {
  std::string text = fmt::format("set xlabel {}\nset ylabel {}\n", quoted(plot.x_label), quoted(plot.y_label));
  if (plot.log_x) text += "set logscale x\n";
  if (plot.log_y) text += "set logscale y\n";
  if (!plot.x_ticks.empty()) text += fmt::format("set xtics ({})\n", fmt::join(plot.x_ticks, ", "));
  if (plot.bars) text += "set style fill solid 0.6\nset boxwidth 0.9 relative\nset yrange [0:*]\n";
  return text;
}

/// gnuplot says on standard error that a range with one value is none, and widens it; so it is given one as wide.
std::string range_of(const Plot& plot, std::size_t axis) {
  const bool from_zero = axis == 1 && plot.bars;
  double least = from_zero ? 0 : infinity, most = from_zero ? 0 : -infinity;
  for (const Curve& curve : plot.curves)
    for (const auto& point : curve.points) {
      if (!can_be_drawn(plot, point)) continue;
      least = std::min(least, point.at(axis));
      most = std::max(most, point.at(axis));
    }
  if (most - least > 1e-8 * std::abs(most)) return "";
  const double around = most == 0 ? 1 : 0.01 * std::abs(most);
  return fmt::format("set {}range [{:.9g}:{:.9g}]\n", axis == 0 ? 'x' : 'y', least - (from_zero ? 0 : around),
                     most + around);
}

std::string curves_of(const Plot& plot) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const std::string drawn = plot.bars ? "boxes"
                                        : fmt::format("linespoints linewidth 2 dashtype {} pointtype 7 pointsize 0.5",
                                                      1 + i / std::size(colors));
    parts.push_back(fmt::format("$curve{} using 1:2 with {} linecolor rgb '{}' title {}", i, drawn,
                                html_color(colors[i % std::size(colors)]), quoted(plot.curves[i].name)));
  }
  return fmt::format("plot {}\n", fmt::join(parts, ", "));
}

bool is_empty(const Plot& plot) {
  for (const Curve& curve : plot.curves)
    for (const auto& point : curve.points)
      if (can_be_drawn(plot, point)) return false;
  return true;
}

std::string script_of(const Plot& plot) {
  std::string text =
      "set encoding utf8\n"
      "set terminal svg size 600,420 dynamic noenhanced font 'sans-serif,14' background '#ffffff'\n"
      "set grid\nset key above\n";
  text += data_of(plot) + axes_of(plot);
  if (is_empty(plot)) return text + "unset logscale\nplot [0:1][0:1] NaN notitle\n";
  return text + range_of(plot, 0) + range_of(plot, 1) + curves_of(plot);
}

/// A file without a name on any disk.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text) : descriptor_(::memfd_create("rpf-plot", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw Error(ErrorKind::output, "no file in memory can be made for a plot");
    io::CheckedWriter writer(descriptor_, path());
    writer.write(text.data(), text.size());
    writer.finish();
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return fmt::format("/proc/{}/fd/{}", ::getpid(), descriptor_); }

 private:
  int descriptor_;
};

std::string gnuplot(const std::string& argument) {
  try {
    return bench::output_of({"gnuplot", "--default-settings", argument});
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::usage) throw;
    throw Error(
        ErrorKind::output,
        fmt::format("plots are drawn by gnuplot: {}; install it (Debian: apt-get install gnuplot-nox)", e.what()));
  }
}

}  // namespace

std::string svg_of(const Plot& plot) { return gnuplot(MemoryFile(script_of(plot)).path()); }

void check_plotting() { gnuplot("--version"); }

}  // namespace rpf::report
