#include "frame/camera_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rpf/error.h"

namespace rpf {
namespace {

using Row = CameraFacts::Row;
using Point = std::array<double, 3>;

template <typename T>
const T& attribute(const Metadata& metadata, const char* name, const char* type) {
  const auto found = metadata.find(name);
  const T* value = found == metadata.end() ? nullptr : std::get_if<T>(&found->second);
  if (value == nullptr)
    throw Error(
        ErrorKind::input,
        fmt::format("--method lightfield: the samples have no attribute {} of type {}, which docs/file-format.md "
                    "describes; have the renderer write it (rpf scene does with --lightfield), or choose "
                    "another --method",
                    name, type));
  return *value;
}

/// What was subtracted from positions; 0 where nothing was.
Point origin_of(const Metadata& metadata) {
  constexpr const char* name = "rpf:worldOrigin";
  const auto found = metadata.find(name);
  if (found == metadata.end()) return {};
  const auto* origin = std::get_if<std::vector<float>>(&found->second);
  const auto is_finite = [](float value) { return std::isfinite(value); };
  if (origin == nullptr || origin->size() != 3 || !std::all_of(origin->begin(), origin->end(), is_finite))
    throw Error(ErrorKind::input, fmt::format("attribute {} is no vector of 3 finite numbers; write it as v3f", name));
  return {(*origin)[0], (*origin)[1], (*origin)[2]};
}

/// A column of a matrix that rows are multiplied with, for positions that rpf:worldOrigin was subtracted from.
Row column_of(const Metadata& metadata, const char* name, std::size_t column) {
  const auto& matrix = attribute<std::vector<float>>(metadata, name, "m44f");
  const bool is_matrix =
      matrix.size() == 16 && std::all_of(matrix.begin(), matrix.end(), [](float v) { return std::isfinite(v); });
  if (!is_matrix)
    throw Error(ErrorKind::input,
                fmt::format("attribute {} is no matrix of 4 x 4 finite numbers; write it as m44f", name));
  Row row = {matrix[column], matrix[4 + column], matrix[8 + column], matrix[12 + column]};
  const Point origin = origin_of(metadata);
  for (std::size_t k = 0; k < 3; ++k) row[3] += row[k] * origin[k];
  return row;
}

Row sum(double s, const Row& a, double t, const Row& b) {
  Row result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = s * a[k] + t * b[k];
  return result;
}

double dot(const Row& a, const Point& p) { return a[0] * p[0] + a[1] * p[1] + a[2] * p[2]; }

/// The way in the world that adds 1 to this coordinate of the camera, whose axes are at right angles.
Point axis_of(const Row& coordinate) {
  const double square = dot(coordinate, {coordinate[0], coordinate[1], coordinate[2]});
  if (!(square > 0))
    throw Error(ErrorKind::input, "attribute worldToCamera has no axes; write the matrix of the camera");
  return {coordinate[0] / square, coordinate[1] / square, coordinate[2] / square};
}

double length_of(const Metadata& metadata, const char* name, double least) {
  const double value = attribute<float>(metadata, name, "float");
  if (std::isfinite(value) && value >= least) return value;
  throw Error(ErrorKind::input, fmt::format("attribute {} is {}; a finite number of scene units, {} is expected", name,
                                            value, least > 0 ? "above 0" : "0 or more"));
}

}  // namespace

CameraFacts camera_of(const Metadata& metadata, const Window& data_window, const Window& display_window) {
  CameraFacts camera;
  const Row x = column_of(metadata, "worldToNDC", 0), y = column_of(metadata, "worldToNDC", 1);
  camera.film[2] = column_of(metadata, "worldToNDC", 3);
  camera.film[0] = sum(display_window.width, x, display_window.x - data_window.x, camera.film[2]);
  camera.film[1] = sum(display_window.height, y, display_window.y - data_window.y, camera.film[2]);
  camera.depth = column_of(metadata, "worldToCamera", 2);
  const double radius = length_of(metadata, "rpf:lensRadius", 0);
  camera.inverse_focus = 1 / length_of(metadata, "rpf:focusDistance", std::numeric_limits<float>::min());
  // Of what is 1 before the camera: the third of film is 1 there, in the unit of its growth along the axis.
  const double growth = dot(camera.film[2], axis_of(camera.depth));
  const Point right = axis_of(column_of(metadata, "worldToCamera", 0));
  const Point up = axis_of(column_of(metadata, "worldToCamera", 1));
  for (std::size_t k = 0; k < 2 && radius > 0; ++k) {
    camera.right[k] = radius * dot(camera.film[k], right) / growth;
    camera.up[k] = radius * dot(camera.film[k], up) / growth;
  }
  if (!std::isfinite(camera.right[0] + camera.right[1] + camera.up[0] + camera.up[1]))
    throw Error(ErrorKind::input,
                "attribute worldToNDC does not shrink what is far; a lens needs the matrix of a perspective");
  return camera;
}

}  // namespace rpf
