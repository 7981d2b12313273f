// Features that cannot be what their names say: normals, reflectances, positions.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "frame/conventions.h"
#include "frame/tally.h"

namespace rpf {
namespace {

using Vector = std::array<double, 3>;

constexpr double unit_slack = 0.05;  ///< of a normal's length: half, and interpolation over a triangle
constexpr float most_reflected = 2;  ///< renderers give 1 and a little; beyond this it is another unit
constexpr double near_parallel = 0.99, off_surface = 0.3;  ///< cosines

Vector vector_at(const float* record, const std::vector<std::size_t>& columns) {
  return {record[columns[0]], record[columns[1]], record[columns[2]]};
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& v) { return std::sqrt(dot(v, v)); }
bool is_unit(const Vector& v) { return std::fabs(length(v) - 1) <= unit_slack; }

/// Calls use(record, pixel) for the samples that hit something.
template <class Use>
void for_each_hit(const SampleBuffer& samples, Use use) {
  const auto hit = samples.layout.find("feature.hit");
  for (std::size_t pixel = 0; pixel + 1 < samples.first_sample.size(); ++pixel)
    for (std::uint32_t i = samples.first_sample[pixel]; i < samples.first_sample[pixel + 1]; ++i)
      if (!hit || samples.record(i)[*hit] != 0) use(samples.record(i), pixel);
}

void check_normals(const SampleBuffer& samples, const std::string& group, std::vector<InputNote>& notes) {
  const auto columns = columns_of(samples.layout, "feature." + group, "XYZ");
  if (columns.empty()) return;
  Tally wrong;
  Guess encoded{"which look encoded to 0 to 1; write 2 N - 1"};
  for_each_hit(samples, [&](const float* record, std::size_t pixel) {
    const Vector n = vector_at(record, columns);
    const double size = length(n);
    if (!std::isfinite(size) || size == 0 || is_unit(n)) return;
    wrong.add(pixel);
    const bool in_cube = n[0] >= 0 && n[0] <= 1 && n[1] >= 0 && n[1] <= 1 && n[2] >= 0 && n[2] <= 1;
    encoded.agreeing += in_cube && is_unit({2 * n[0] - 1, 2 * n[1] - 1, 2 * n[2] - 1});
  });
  wrong.tell(fmt::format("normals {} whose length is not 1{}", group,
                         advice_of({encoded}, wrong.count, "; write unit vectors in world space")),
             samples.data_window, notes);
}

void check_albedo(const SampleBuffer& samples, const std::string& group, std::vector<InputNote>& notes) {
  const auto columns = columns_of(samples.layout, "feature." + group, "RGB");
  if (columns.empty()) return;
  Tally wrong;
  Guess bytes{"which look like 0 to 255; divide by 255"};
  for_each_hit(samples, [&](const float* record, std::size_t pixel) {
    for (const std::size_t c : columns) {
      if (!std::isfinite(record[c]) || (record[c] <= most_reflected && record[c] >= 0)) continue;
      wrong.add(pixel);
      bytes.agreeing += record[c] > 0 && record[c] <= 255 && record[c] == std::floor(record[c]);
      return;
    }
  });
  wrong.tell(fmt::format("values of {} far from 0 to 1{}", group,
                         advice_of({bytes}, wrong.count, "; write the part of the light that is reflected")),
             samples.data_window, notes);
}

/// Neighbors on a surface differ in directions that its normal is at right angles to. Where most do not, positions and
/// normals are of two spaces: world and camera.
void check_spaces(const SampleBuffer& samples, std::vector<InputNote>& notes) {
  const auto normal = columns_of(samples.layout, "feature.N", "XYZ"),
             position = columns_of(samples.layout, "feature.P", "XYZ");
  if (normal.empty() || position.empty()) return;
  constexpr std::uint64_t fewest = 16;  // pairs that can prove something
  std::uint64_t pairs = 0;
  Tally wrong;
  const float* before = nullptr;
  std::size_t pixel_before = 0;
  for_each_hit(samples, [&](const float* record, std::size_t pixel) {
    const float* other = pixel == pixel_before ? before : nullptr;
    before = record;
    pixel_before = pixel;
    if (other == nullptr) return;
    const Vector n = vector_at(record, normal), p = vector_at(record, position), q = vector_at(other, position);
    const Vector step{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    // Also false where something is not finite.
    if (!(is_unit(n) && dot(n, vector_at(other, normal)) > near_parallel && length(step) > 1e-4 * length(p))) return;
    ++pairs;
    if (std::fabs(dot(n, step)) > off_surface * length(step)) wrong.add(pixel);
  });
  if (pairs < fewest || wrong.count * 2 <= pairs) return;
  wrong.tell(
      "positions P that do not lie on surfaces with the normals N, as if one were in camera space; write both in "
      "world space",
      samples.data_window, notes);
}

}  // namespace

void check_surfaces(const SampleBuffer& samples, std::vector<InputNote>& notes) {
  for (const char* group : {"N", "Ns", "Ng", "N2"}) check_normals(samples, group, notes);
  for (const char* group : {"albedo", "albedo2"}) check_albedo(samples, group, notes);
  check_spaces(samples, notes);
}

}  // namespace rpf
