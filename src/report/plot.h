// Plots, drawn by gnuplot (Debian: gnuplot-nox), which runs as a program of its own.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace rpf::report {

struct Curve {
  std::string name;                           ///< in the legend
  std::vector<std::array<double, 2>> points;  ///< x, y in the order of drawing; those that are not finite are left out
};

/// All texts are plain UTF-8.
struct Plot {
  std::string x_label, y_label;
  std::vector<Curve> curves;          ///< none, or none with a point: the plot is empty
  bool log_x = false, log_y = false;  ///< points at or below 0 are left out
  bool bars = false;                  ///< histograms: a bar at each x instead of a line through all points
  std::vector<double> x_ticks;        ///< where numbers stand; empty: gnuplot chooses
};

/// The plot as the text of an SVG file, black on white. Throws Error(output) where gnuplot is missing: it says what to
/// install.
std::string svg_of(const Plot& plot);

/// For finding out before an hour of work. Throws as svg_of() does.
void check_plotting();

}  // namespace rpf::report
