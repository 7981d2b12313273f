#include "learned/record_view.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "learned/observe_scan.h"

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

// Written out: as algorithms of the standard library they are calls, a few for each sample.
bool is_there(const float* record, const Three& columns) {
  return !std::isnan(record[columns[0]]) && !std::isnan(record[columns[1]]) && !std::isnan(record[columns[2]]);
}

bool is_zero(const float* record, const Three& columns) {
  return record[columns[0]] == 0 && record[columns[1]] == 0 && record[columns[2]] == 0;
}

float or_zero(float value) { return std::isnan(value) ? 0.0F : value; }

/// std::floor() without the call that it is on processors before SSE4.1.
float floor_of(float value) {
  constexpr float all_whole = 1 << 23;  // from here on
  if (!(std::fabs(value) < all_whole)) return value;
  const auto whole = static_cast<float>(static_cast<int>(value));
  return whole > value ? whole - 1 : whole;
}

/// 2u - 1 of a number in [0, 1); 0 where it is missing.
float centered(float u) { return std::isnan(u) ? 0.0F : rpf_held(2 * u - 1, -1, 1); }

/// One input of `count` records from a column of theirs: make(value, number of the record).
template <typename Make>
void read_column(const float* column, std::size_t stride, std::size_t count, float* input, const Make& make) {
  for (std::size_t i = 0; i < count; ++i) input[i] = make(column[i * stride], i);
}

/// The columns of a group's components.
std::optional<Three> group_at(const CleanFrame& clean, const std::string& group, const char* axes) {
  const std::vector<std::string>& selected = clean.selection.features;
  Three columns{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string slot = "feature." + group + "." + axes[k];
    if (std::find(selected.begin(), selected.end(), slot) == selected.end()) return std::nullopt;
    columns[k] = *clean.frame.layout.find(slot);
  }
  return columns;
}

}  // namespace

int input_of(const std::string& variable) {
  for (const NamedInput& named : named_inputs)
    if (variable == named.variable) return named.input;
  return -1;
}

RecordView::RecordView(const CleanFrame& clean)
    : stride_(clean.frame.layout.size()),
      normal_(group_at(clean, "N", "XYZ")),
      albedo_(group_at(clean, "albedo", "RGB")),
      position_(group_at(clean, "P", "XYZ")),
      normal2_(group_at(clean, "N2", "XYZ")),
      position2_(group_at(clean, "P2", "XYZ")),
      hit_(clean.columns.hit) {
  for (const std::string& slot : clean.selection.random)
    if (const int input = input_of(short_name(slot)); input >= 0)
      numbers_.push_back({input, *clean.frame.layout.find(slot), 0, false});
  const Window& window = clean.frame.data_window;
  numbers_.push_back({RPF_INPUT_FILM, clean.columns.film[0], static_cast<float>(window.x), true});
  numbers_.push_back({RPF_INPUT_FILM + 1, clean.columns.film[1], static_cast<float>(window.y), true});
  std::vector<int> all(RPF_INPUTS - RPF_INPUT_NORMAL);
  std::iota(all.begin(), all.end(), RPF_INPUT_NORMAL);
  reads_ = reads_of(all);
}

RecordView::Reads RecordView::reads_of(const std::vector<int>& inputs) const {
  const auto reads_any = [&](int first, int end) {
    return std::any_of(inputs.begin(), inputs.end(), [&](int i) { return i >= first && i < end && has(i); });
  };
  return {reads_any(RPF_INPUT_NORMAL, RPF_INPUT_ALBEDO), reads_any(RPF_INPUT_ALBEDO, RPF_INPUT_POSITION),
          reads_any(RPF_INPUT_POSITION, RPF_INPUT_MISS), reads_any(RPF_INPUT_NORMAL2, RPF_INPUT_LENS),
          reads_any(RPF_INPUT_DISTANCE2, RPF_INPUT_HIT2)};
}

RecordView RecordView::only(const std::vector<int>& inputs) const {
  RecordView view = *this;
  view.reads_ = reads_of(inputs);
  const auto is_left_out = [&](const Number& n) {
    return std::find(inputs.begin(), inputs.end(), n.input) == inputs.end();
  };
  view.numbers_.erase(std::remove_if(view.numbers_.begin(), view.numbers_.end(), is_left_out), view.numbers_.end());
  return view;
}

bool RecordView::has(int input) const {
  if (input >= RPF_INPUT_LENS)
    return std::any_of(numbers_.begin(), numbers_.end(), [&](const Number& n) { return n.input == input; });
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
  return is_there(record, *normal2_) && !is_zero(record, *normal2_);
}

bool RecordView::has_position(const float* record) const {
  return position_ && is_hit(record) && is_there(record, *position_);
}

bool RecordView::any_hit(const SampleBuffer& samples) const {
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    if (is_hit(samples.record(i))) return true;
  return false;
}

void RecordView::read_first_hits(const float* records, std::size_t count, const bool* hits,
                                 const PositionFacts& positions, InputBlock& block) const {
  for (std::size_t i = 0; i < count; ++i) block.values[RPF_INPUT_MISS][i] = hits[i] ? 0.0F : 1.0F;
  const auto read = [&](const Three& columns, int input, float least, float most) {
    for (std::size_t k = 0; k < 3; ++k)
      read_column(records + columns[k], stride_, count, block.values[static_cast<std::size_t>(input) + k],
                  [&](float value, std::size_t i) { return hits[i] ? rpf_held(or_zero(value), least, most) : 0.0F; });
  };
  if (reads_.normal) read(*normal_, RPF_INPUT_NORMAL, -longest_normal, longest_normal);
  if (reads_.albedo) read(*albedo_, RPF_INPUT_ALBEDO, 0, 1);
  for (std::size_t k = 0; reads_.position && k < 3; ++k)
    read_column(records + (*position_)[k], stride_, count, block.values[RPF_INPUT_POSITION + k],
                [&, median = positions.median[k]](float value, std::size_t i) {
                  const double off = hits[i] ? value - median : 0;
                  return rpf_held(or_zero(static_cast<float>(off / positions.deviation)), -farthest_position,
                                  farthest_position);
                });
}

float RecordView::second_distance(const float* record, const PositionFacts& positions) const {
  if (!is_there(record, *position_) || !is_there(record, *position2_)) return 0;
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = static_cast<double>(record[(*position2_)[k]]) - record[(*position_)[k]];
    square += d * d;
  }
  const auto distance = static_cast<float>(std::sqrt(square) / positions.deviation);
  return kernel::rpf_log(1 + 4 * rpf_held(distance, 0, farthest_second_hit));
}

void RecordView::read_second_hits(const float* records, std::size_t count, const bool* hits,
                                  const PositionFacts& positions, InputBlock& block) const {
  bool again[block_records];
  for (std::size_t i = 0; i < count; ++i) {
    again[i] = hits[i] && is_second_hit(records + i * stride_);
    block.values[RPF_INPUT_HIT2][i] = again[i] ? 1.0F : 0.0F;
  }
  for (std::size_t k = 0; k < 3; ++k)
    read_column(
        records + (*normal2_)[k], stride_, count, block.values[RPF_INPUT_NORMAL2 + k],
        [&](float value, std::size_t i) { return again[i] ? rpf_held(value, -longest_normal, longest_normal) : 0.0F; });
  for (std::size_t i = 0; reads_.second_distance && i < count; ++i)
    block.values[RPF_INPUT_DISTANCE2][i] = again[i] ? second_distance(records + i * stride_, positions) : 0;
}

void RecordView::read(const float* records, std::size_t count, const PositionFacts& positions,
                      InputBlock& block) const {
  bool hits[block_records];
  for (std::size_t i = 0; i < count; ++i) hits[i] = is_hit(records + i * stride_);
  read_first_hits(records, count, hits, positions, block);
  if (reads_.second_hit) read_second_hits(records, count, hits, positions, block);
  for (const Number& n : numbers_)
    read_column(records + n.column, stride_, count, block.values[n.input], [&](float value, std::size_t /*i*/) {
      const float u = value - n.origin;
      return centered(n.is_film ? u - floor_of(u) : u);
    });
}

}  // namespace rpf
