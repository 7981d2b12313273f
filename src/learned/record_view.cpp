#include "learned/record_view.h"

#include <algorithm>
#include <cmath>

#include "learned/observe.h"

namespace rpf {
namespace {

using kernel::rpf_held;

/// Normals are at most 1 long; what is longer is a mistake, which must stay finite.
constexpr float longest_normal = 4;
constexpr float farthest_position = 4;
constexpr float farthest_second_hit = 1e15F;

struct NamedInput {
  const char* variable;
  int input;
};
constexpr NamedInput named_inputs[] = {
    {"N.X", RPF_INPUT_NORMAL},       {"N.Y", RPF_INPUT_NORMAL + 1},      {"N.Z", RPF_INPUT_NORMAL + 2},
    {"albedo.R", RPF_INPUT_ALBEDO},  {"albedo.G", RPF_INPUT_ALBEDO + 1}, {"albedo.B", RPF_INPUT_ALBEDO + 2},
    {"P.X", RPF_INPUT_POSITION},     {"P.Y", RPF_INPUT_POSITION + 1},    {"P.Z", RPF_INPUT_POSITION + 2},
    {"hit", RPF_INPUT_MISS},         {"N2.X", RPF_INPUT_NORMAL2},        {"N2.Y", RPF_INPUT_NORMAL2 + 1},
    {"N2.Z", RPF_INPUT_NORMAL2 + 2}, {"P2.X", RPF_INPUT_DISTANCE2},      {"P2.Y", RPF_INPUT_DISTANCE2},
    {"P2.Z", RPF_INPUT_DISTANCE2},   {"lens.U", RPF_INPUT_LENS},         {"lens.V", RPF_INPUT_LENS + 1},
    {"time", RPF_INPUT_TIME},        {"light.U", RPF_INPUT_LIGHT},       {"light.V", RPF_INPUT_LIGHT + 1},
    {"bsdf.U", RPF_INPUT_BSDF},      {"bsdf.V", RPF_INPUT_BSDF + 1}};

using Three = std::array<std::size_t, 3>;

bool is_there(const float* record, const Three& columns) {
  return std::none_of(columns.begin(), columns.end(), [&](std::size_t c) { return std::isnan(record[c]); });
}

bool is_zero(const float* record, const Three& columns) {
  return std::all_of(columns.begin(), columns.end(), [&](std::size_t c) { return record[c] == 0; });
}

float or_zero(float value) { return std::isnan(value) ? 0.0F : value; }

/// 2u - 1 of a number in [0, 1); 0 where it is missing.
float centered(float u) { return std::isnan(u) ? 0.0F : rpf_held(2 * u - 1, -1, 1); }

/// The columns of a group's components.
std::optional<Three> group_at(const Variables& v, const std::string& group, const char* axes) {
  Three columns{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto name = std::find(v.feature_names.begin(), v.feature_names.end(), group + "." + axes[k]);
    if (name == v.feature_names.end()) return std::nullopt;
    columns[k] = v.features() + static_cast<std::size_t>(name - v.feature_names.begin());
  }
  return columns;
}

}  // namespace

int input_of(const std::string& variable) {
  for (const NamedInput& named : named_inputs)
    if (variable == named.variable) return named.input;
  return -1;
}

RecordView::RecordView(const Variables& variables)
    : normal_(group_at(variables, "N", "XYZ")),
      albedo_(group_at(variables, "albedo", "RGB")),
      position_(group_at(variables, "P", "XYZ")),
      normal2_(group_at(variables, "N2", "XYZ")),
      position2_(group_at(variables, "P2", "XYZ")) {
  for (std::size_t k = 0; k < variables.feature_names.size(); ++k)
    if (variables.feature_names[k] == "hit") hit_ = variables.features() + k;
  for (std::size_t k = 0; k < variables.random_names.size(); ++k)
    if (const int input = input_of(variables.random_names[k]); input >= 0) random_[input] = Variables::random + k;
  random_[RPF_INPUT_FILM] = Variables::position;
  random_[RPF_INPUT_FILM + 1] = Variables::position + 1;
}

bool RecordView::has(int input) const {
  if (input >= RPF_INPUT_LENS) return random_[input].has_value();
  if (input == RPF_INPUT_DISTANCE2) return normal2_ && position_ && position2_;
  if (input >= RPF_INPUT_NORMAL2) return normal2_.has_value();
  if (input >= RPF_INPUT_MISS) return hit_ || normal_;
  if (input >= RPF_INPUT_POSITION) return position_.has_value();
  return input >= RPF_INPUT_ALBEDO ? albedo_.has_value() : normal_.has_value();
}

bool RecordView::is_hit(const float* record) const {
  if (hit_) return record[*hit_] != 0 && !std::isnan(record[*hit_]);
  return !normal_ || (is_there(record, *normal_) && !is_zero(record, *normal_));
}

bool RecordView::is_second_hit(const float* record) const {
  return is_hit(record) && is_there(record, *normal2_) && !is_zero(record, *normal2_);
}

bool RecordView::has_position(const float* record) const {
  return position_ && is_hit(record) && is_there(record, *position_);
}

bool RecordView::any_hit(const Frame& frame) const {
  for (std::size_t i = 0; i < frame.sample_count(); ++i)
    if (is_hit(frame.record(i))) return true;
  return false;
}

void RecordView::read_first_hit(const float* record, const PositionFacts& positions, float* inputs) const {
  const bool is_hit_once = is_hit(record);
  inputs[RPF_INPUT_MISS] = is_hit_once ? 0.0F : 1.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto value = [&](const Columns& columns) { return is_hit_once ? or_zero(record[(*columns)[k]]) : 0; };
    if (normal_) inputs[RPF_INPUT_NORMAL + k] = rpf_held(value(normal_), -longest_normal, longest_normal);
    if (albedo_) inputs[RPF_INPUT_ALBEDO + k] = rpf_held(value(albedo_), 0, 1);
    if (!position_) continue;
    const double off = is_hit_once ? record[(*position_)[k]] - positions.median[k] : 0;
    const float p = or_zero(static_cast<float>(off / positions.deviation));
    inputs[RPF_INPUT_POSITION + k] = rpf_held(p, -farthest_position, farthest_position);
  }
}

void RecordView::read_second_hit(const float* record, const PositionFacts& positions, float* inputs) const {
  if (!normal2_) return;
  const bool is_hit_again = is_second_hit(record);
  inputs[RPF_INPUT_HIT2] = is_hit_again ? 1.0F : 0.0F;
  for (std::size_t k = 0; k < 3; ++k)
    inputs[RPF_INPUT_NORMAL2 + k] =
        is_hit_again ? rpf_held(record[(*normal2_)[k]], -longest_normal, longest_normal) : 0.0F;
  if (!position_ || !position2_) return;
  inputs[RPF_INPUT_DISTANCE2] = 0;
  if (!is_hit_again || !has_position(record) || !is_there(record, *position2_)) return;
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = static_cast<double>(record[(*position2_)[k]]) - record[(*position_)[k]];
    square += d * d;
  }
  const auto distance = static_cast<float>(std::sqrt(square) / positions.deviation);
  inputs[RPF_INPUT_DISTANCE2] = kernel::rpf_log(1 + 4 * rpf_held(distance, 0, farthest_second_hit));
}

void RecordView::read(const float* record, const PositionFacts& positions, float* inputs) const {
  read_first_hit(record, positions, inputs);
  read_second_hit(record, positions, inputs);
  for (int input = RPF_INPUT_LENS; input < RPF_INPUTS; ++input) {
    if (!random_[input]) continue;
    const float u = record[*random_[input]];
    const bool is_film = input == RPF_INPUT_FILM || input == RPF_INPUT_FILM + 1;
    inputs[input] = centered(is_film ? u - std::floor(u) : u);
  }
}

}  // namespace rpf
