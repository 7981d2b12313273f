#include "learned/record_view.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "learned/network.h"
#include "learned/observe_scan.h"
#include "parallel/vectors.h"

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

// What follows is without branches, so that compilers make vectors of it.

bool is_there(float x, float y, float z) {
  return !(static_cast<unsigned>(std::isnan(x)) | std::isnan(y) | std::isnan(z));
}

/// A vector that is neither missing nor 0: of a hit.
bool is_direction(float x, float y, float z) {
  return static_cast<unsigned>(is_there(x, y, z)) & static_cast<unsigned>(!((x == 0) & (y == 0) & (z == 0)));
}

bool is_marked_hit(float hit) { return static_cast<unsigned>(hit != 0) & static_cast<unsigned>(!std::isnan(hit)); }

float or_zero(float value) { return std::isnan(value) ? 0.0F : value; }

/// std::floor() without the call that it is on processors before SSE4.1.
float floor_of(float value) {
  constexpr float all_whole = 1 << 23;  // from here on; sums with it are whole too
  const float magnitude = std::fabs(value), nearest = std::copysign(magnitude + all_whole - all_whole, value);
  const float below = nearest > value ? nearest - 1 : nearest;
  return magnitude < all_whole ? below : value;
}

/// 2u - 1 of a number in [0, 1); 0 where it is missing.
float centered(float u) {
  const float held = rpf_held(2 * u - 1, -1, 1);
  return std::isnan(u) ? 0.0F : held;
}

/// One input from a column: make(value, number of the record), also where there is no record.
template <typename Make>
void read_column(const float* column, float* input, const Make& make) {
  for (std::size_t i = 0; i < block_records; ++i) input[i] = make(column[i], i);
}

/// test(x, y, z) of three columns.
template <typename Test>
void test_columns(const ColumnBlock& records, const Three& columns, BlockMask& results, const Test& test) {
  const float *x = records[columns[0]], *y = records[columns[1]], *z = records[columns[2]];
  for (std::size_t i = 0; i < block_records; ++i) results[i] = test(x[i], y[i], z[i]) ? 1 : 0;
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

bool looks_at(const Network& network, int input) {
  if (input < RPF_INPUT_NORMAL2) return true;
  const NetworkLayer& layer = network.sample1();
  const auto weights = layer.weights.begin() + static_cast<std::ptrdiff_t>(input) * layer.outputs;
  return std::any_of(weights, weights + layer.outputs, [](float weight) { return weight != 0; });
}

bool looks_at(const Network& network, const std::string& slot) {
  const int input = input_of(short_name(slot));
  const bool is_second_normal = input >= RPF_INPUT_NORMAL2 && input < RPF_INPUT_DISTANCE2;
  if (!is_second_normal) return looks_at(network, input);
  for (int any = RPF_INPUT_NORMAL2; any < RPF_INPUT_LENS; ++any)
    if (looks_at(network, any)) return true;
  return false;
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
  if (hit_) return is_marked_hit(record[*hit_]);
  return !normal_ || is_direction(record[(*normal_)[0]], record[(*normal_)[1]], record[(*normal_)[2]]);
}

bool RecordView::has_position(const float* record) const {
  return position_ && is_hit(record) && is_there(position(record, 0), position(record, 1), position(record, 2));
}

bool RecordView::any_hit(const SampleBuffer& samples) const {
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    if (is_hit(samples.record(i))) return true;
  return false;
}

ColumnBlock RecordView::block(std::vector<std::size_t> others) const {
  std::vector<std::size_t> columns = std::move(others);
  const auto add = [&](bool is_read, const Columns& group) {
    if (is_read) columns.insert(columns.end(), group->begin(), group->end());
  };
  if (hit_) columns.push_back(*hit_);
  add(reads_.normal || (!hit_ && normal_), normal_);
  add(reads_.albedo, albedo_);
  add(reads_.position || reads_.second_distance, position_);
  add(reads_.second_hit, normal2_);
  add(reads_.second_distance, position2_);
  for (const Number& n : numbers_) columns.push_back(n.column);
  return {columns, stride_};
}

void RecordView::find_hits(const ColumnBlock& records, BlockMask& hits) const {
  if (hit_) {
    const float* hit = records[*hit_];
    for (std::size_t i = 0; i < block_records; ++i) hits[i] = is_marked_hit(hit[i]) ? 1 : 0;
  } else if (normal_) {
    test_columns(records, *normal_, hits, is_direction);
  } else {
    std::fill(std::begin(hits), std::end(hits), 1);
  }
}

void RecordView::read_first_hits(const ColumnBlock& records, const BlockMask& hits, const PositionFacts& positions,
                                 InputBlock& inputs) const {
  for (std::size_t i = 0; i < block_records; ++i) inputs.values[RPF_INPUT_MISS][i] = hits[i] != 0 ? 0.0F : 1.0F;
  const auto read = [&](const Three& columns, int input, float least, float most) {
    for (std::size_t k = 0; k < 3; ++k)
      read_column(records[columns[k]], inputs.values[static_cast<std::size_t>(input) + k],
                  [&hits, least, most](float value, std::size_t i) {
                    const float held = rpf_held(or_zero(value), least, most);
                    return hits[i] != 0 ? held : 0.0F;
                  });
  };
  if (reads_.normal) read(*normal_, RPF_INPUT_NORMAL, -longest_normal, longest_normal);
  if (reads_.albedo) read(*albedo_, RPF_INPUT_ALBEDO, 0, 1);
  for (std::size_t k = 0; reads_.position && k < 3; ++k)
    read_column(records[(*position_)[k]], inputs.values[RPF_INPUT_POSITION + k],
                [&hits, median = positions.median[k], deviation = positions.deviation](float value, std::size_t i) {
                  const auto off = static_cast<float>((value - median) / deviation);
                  const float held = rpf_held(or_zero(off), -farthest_position, farthest_position);
                  return hits[i] != 0 ? held : 0.0F;
                });
}

void RecordView::read_second_distances(const ColumnBlock& records, const BlockMask& again,
                                       const PositionFacts& positions, float (&input)[block_records]) const {
  double squares[block_records] = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const float *second = records[(*position2_)[k]], *first = records[(*position_)[k]];
    for (std::size_t i = 0; i < block_records; ++i) {
      const double d = static_cast<double>(second[i]) - first[i];
      squares[i] += d * d;
    }
  }
  for (std::size_t i = 0; i < block_records; ++i) {
    const auto distance = static_cast<float>(std::sqrt(squares[i]) / positions.deviation);
    const float seen = kernel::rpf_log(1 + 4 * rpf_held(distance, 0, farthest_second_hit));
    const bool is_known = again[i] != 0 && !std::isnan(distance);  // else a position is missing
    input[i] = is_known ? seen : 0.0F;
  }
}

void RecordView::read_second_hits(const ColumnBlock& records, const BlockMask& hits, const PositionFacts& positions,
                                  InputBlock& inputs) const {
  BlockMask again;
  test_columns(records, *normal2_, again, is_direction);
  for (std::size_t i = 0; i < block_records; ++i) again[i] &= hits[i];
  for (std::size_t i = 0; i < block_records; ++i) inputs.values[RPF_INPUT_HIT2][i] = again[i] != 0 ? 1.0F : 0.0F;
  for (std::size_t k = 0; k < 3; ++k)
    read_column(records[(*normal2_)[k]], inputs.values[RPF_INPUT_NORMAL2 + k], [&again](float value, std::size_t i) {
      const float held = rpf_held(value, -longest_normal, longest_normal);
      return again[i] != 0 ? held : 0.0F;
    });
  if (reads_.second_distance) read_second_distances(records, again, positions, inputs.values[RPF_INPUT_DISTANCE2]);
}

void RecordView::read(const ColumnBlock& records, const PositionFacts& positions, InputBlock& inputs) const {
  with_avx2([&] { read_all(records, positions, inputs); });
}

void RecordView::read_all(const ColumnBlock& records, const PositionFacts& positions, InputBlock& inputs) const {
  BlockMask hits;
  find_hits(records, hits);
  read_first_hits(records, hits, positions, inputs);
  if (reads_.second_hit) read_second_hits(records, hits, positions, inputs);
  for (const Number& n : numbers_) {
    float* input = inputs.values[n.input];
    if (n.is_film)
      read_column(records[n.column], input, [origin = n.origin](float value, std::size_t /*i*/) {
        return centered(value - origin - floor_of(value - origin));
      });
    else
      read_column(records[n.column], input, [](float value, std::size_t /*i*/) { return centered(value); });
  }
}

}  // namespace rpf
