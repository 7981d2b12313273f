// Features that cannot be what their names say: normals, reflectances, positions.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

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
bool is_unit(const Vector& v) {
  constexpr double least = (1 - unit_slack) * (1 - unit_slack), most = (1 + unit_slack) * (1 + unit_slack);
  const double square = dot(v, v);
  return square >= least && square <= most;
}

bool is_hit(const float* record, const std::optional<std::size_t>& hit) { return !hit || record[*hit] != 0; }

class NormalCheck : public SampleCheck {
 public:
  /// `of_first_hit`: feature.hit speaks of these, so that where it is not 0 there must be one.
  NormalCheck(const SampleLayout& layout, std::string group, std::vector<std::size_t> columns, bool of_first_hit)
      : hit_(layout.find("feature.hit")),
        must_be_(of_first_hit && hit_),
        group_(std::move(group)),
        columns_(std::move(columns)) {}

  void look(const ColumnBlock& records, const PixelCorners& /*corners*/, BlockMask& odd) const override {
    constexpr float least = 1 - unit_slack, most = 1 + unit_slack;  // of a square: half the slack of a length
    const float *x = records[columns_[0]], *y = records[columns_[1]], *z = records[columns_[2]];
    const float* hit = must_be_ ? records[*hit_] : x;  // x: where nothing must be, zeros are not odd
    for (std::size_t i = 0; i < block_records; ++i) {
      const float square = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
      const std::int32_t any = static_cast<std::int32_t>(x[i] != 0) | static_cast<std::int32_t>(y[i] != 0) |
                               static_cast<std::int32_t>(z[i] != 0) | static_cast<std::int32_t>(hit[i] != 0);
      odd[i] |= (static_cast<std::int32_t>(square < least) & any) | static_cast<std::int32_t>(square > most);
    }
  }

  void tell(const Window& data_window, std::vector<InputNote>& notes) const override {
    wrong_.tell(fmt::format("normals {} whose length is not 1{}", group_,
                            advice_of({encoded_}, wrong_.count, "; write unit vectors in world space")),
                data_window, notes);
    none_.tell(fmt::format("normals {} that are 0,0,0 where a surface was hit; write its normal, or hit 0", group_),
               data_window, notes);
  }

  void add(const float* record, std::size_t pixel) override {
    if (!is_hit(record, hit_)) return;
    const Vector n = vector_at(record, columns_);
    if (is_unit(n) || !std::isfinite(dot(n, n))) return;
    if (dot(n, n) == 0) {
      if (must_be_) none_.add(pixel);  // else: nothing was hit
      return;
    }
    wrong_.add(pixel);
    const bool in_cube = n[0] >= 0 && n[0] <= 1 && n[1] >= 0 && n[1] <= 1 && n[2] >= 0 && n[2] <= 1;
    encoded_.agreeing += in_cube && is_unit({2 * n[0] - 1, 2 * n[1] - 1, 2 * n[2] - 1}) ? 1 : 0;
  }

 private:
  std::optional<std::size_t> hit_;
  bool must_be_;
  std::string group_;
  std::vector<std::size_t> columns_;
  Tally wrong_, none_;
  Guess encoded_{"which look encoded to 0 to 1; write 2 N - 1"};
};

class AlbedoCheck : public SampleCheck {
 public:
  AlbedoCheck(const SampleLayout& layout, std::string group, std::vector<std::size_t> columns)
      : hit_(layout.find("feature.hit")), group_(std::move(group)), columns_(std::move(columns)) {}

  void tell(const Window& data_window, std::vector<InputNote>& notes) const override {
    wrong_.tell(fmt::format("values of {} far from 0 to 1{}", group_,
                            advice_of({bytes_}, wrong_.count, "; write the part of the light that is reflected")),
                data_window, notes);
  }

  void look(const ColumnBlock& records, const PixelCorners& /*corners*/, BlockMask& odd) const override {
    for (const std::size_t c : columns_) mark_outside(records[c], 0, most_reflected, odd);
  }

  void add(const float* record, std::size_t pixel) override {
    if (!is_hit(record, hit_)) return;
    for (const std::size_t c : columns_) {
      const float value = record[c];
      if ((value <= most_reflected && value >= 0) || !std::isfinite(value)) continue;
      wrong_.add(pixel);
      bytes_.agreeing += looks_like_byte(value) ? 1 : 0;
      return;
    }
  }

 private:
  std::optional<std::size_t> hit_;
  std::string group_;
  std::vector<std::size_t> columns_;
  Tally wrong_;
  Guess bytes_{"which look like 0 to 255; divide by 255"};
};

/// A vector of which some components are not there: in all pixels.
class IncompleteCheck : public PixelCheck {
 public:
  explicit IncompleteCheck(std::string what) : what_(std::move(what)) {}

  void look(const SampleBuffer& /*rows*/, std::size_t /*place*/, std::size_t pixel,
            PixelFindings& found) const override {
    found.wrong.add(pixel);
  }

  void tell(const PixelFindings& found, const Window& data_window, std::vector<InputNote>& notes) const override {
    found.wrong.tell(what_, data_window, notes);
  }

 private:
  std::string what_;
};

class HitCheck : public SampleCheck {
 public:
  explicit HitCheck(std::size_t column) : column_(column) {}

  void look(const ColumnBlock& records, const PixelCorners& /*corners*/, BlockMask& odd) const override {
    const float* hit = records[column_];
    for (std::size_t i = 0; i < block_records; ++i)
      odd[i] |= static_cast<std::int32_t>(hit[i] != 0) & static_cast<std::int32_t>(hit[i] != 1);
  }

  void add(const float* record, std::size_t pixel) override {
    const float hit = record[column_];
    if (hit != 0 && hit != 1 && !std::isnan(hit)) odd_.add(pixel);  // what is missing is told as such
  }

  void tell(const Window& data_window, std::vector<InputNote>& notes) const override {
    odd_.tell("values of hit that are neither 0 nor 1, taken for 1; write 1 where a surface is hit, else 0",
              data_window, notes);
  }

 private:
  std::size_t column_;
  Tally odd_;
};

/// Neighbors on a surface differ in directions that its normal is at right angles to. Where most do not, positions and
/// normals are of two spaces: world and camera.
class SpaceCheck : public PixelCheck {
 public:
  SpaceCheck(const SampleLayout& layout, std::vector<std::size_t> normal, std::vector<std::size_t> position)
      : hit_(layout.find("feature.hit")), normal_(std::move(normal)), position_(std::move(position)) {}

  void look(const SampleBuffer& rows, std::size_t place, std::size_t pixel, PixelFindings& found) const override {
    const float* before = nullptr;
    for (std::uint32_t i = rows.first_sample[place]; i < rows.first_sample[place + 1]; ++i) {
      const float* record = rows.record(i);
      if (!is_hit(record, hit_)) continue;
      if (before != nullptr) return look_at_pair(before, record, pixel, found);
      before = record;
    }
  }

  void tell(const PixelFindings& found, const Window& data_window, std::vector<InputNote>& notes) const override {
    constexpr std::uint64_t fewest = 16;  // pairs that can prove something
    if (found.looked_at < fewest || found.wrong.count * 2 <= found.looked_at) return;
    found.wrong.tell(
        "positions P that do not lie on surfaces with the normals N, as if one were in camera space; write both in "
        "world space",
        data_window, notes);
  }

 private:
  void look_at_pair(const float* before, const float* record, std::size_t pixel, PixelFindings& found) const {
    const Vector n = vector_at(record, normal_), p = vector_at(record, position_), q = vector_at(before, position_);
    const Vector step{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    const double square = dot(step, step);
    // Also false where something is not finite.
    if (!(is_unit(n) && dot(n, vector_at(before, normal_)) > near_parallel && square > 1e-8 * dot(p, p))) return;
    ++found.looked_at;
    const double across = dot(n, step);
    if (across * across > off_surface * off_surface * square) found.wrong.add(pixel);
  }

  std::optional<std::size_t> hit_;
  std::vector<std::size_t> normal_, position_;
};

/// Vectors that lack a component. One that is alone is a number of its own, such as a gray albedo.
void add_incomplete_checks(const SampleLayout& layout, ConventionChecks& checks) {
  for (const auto& [group, letters] :
       {std::pair{"N", "XYZ"}, {"P", "XYZ"}, {"albedo", "RGB"}, {"N2", "XYZ"}, {"P2", "XYZ"}}) {
    std::string missing;
    for (const char* letter = letters; *letter != '\0'; ++letter)
      if (!layout.find(fmt::format("feature.{}.{}", group, *letter))) missing += *letter;
    if (missing.size() == 1)
      checks.of_pixels.push_back(std::make_unique<IncompleteCheck>(fmt::format(
          "pixels of {} without {}, which presets leave out whole; write all of {}", group, missing, letters)));
  }
}

}  // namespace

void add_surface_checks(const SampleBuffer& samples, ConventionChecks& checks) {
  const SampleLayout& layout = samples.layout;
  add_incomplete_checks(layout, checks);
  if (const auto hit = layout.find("feature.hit")) checks.of_samples.push_back(std::make_unique<HitCheck>(*hit));
  for (const std::string group : {"N", "Ns", "Ng", "N2"})
    if (auto columns = columns_of(layout, "feature." + group, "XYZ"); !columns.empty())
      checks.of_samples.push_back(std::make_unique<NormalCheck>(layout, group, std::move(columns), group != "N2"));
  for (const std::string group : {"albedo", "albedo2"})
    if (auto columns = columns_of(layout, "feature." + group, "RGB"); !columns.empty())
      checks.of_samples.push_back(std::make_unique<AlbedoCheck>(layout, group, std::move(columns)));
  auto normal = columns_of(layout, "feature.N", "XYZ"), position = columns_of(layout, "feature.P", "XYZ");
  if (!normal.empty() && !position.empty())
    checks.of_pixels.push_back(std::make_unique<SpaceCheck>(layout, std::move(normal), std::move(position)));
}

}  // namespace rpf
