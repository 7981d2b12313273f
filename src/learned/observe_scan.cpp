#include "learned/observe_scan.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "parallel/thread_count.h"
#include "parallel/workers.h"

namespace rpf {
namespace {

/// The value in the middle; of two the lower one.
template <typename Number>
Number lower_median(std::vector<Number> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// R + G + B of the mean of a pixel's samples, from the sum of their weighted colors. The same operations as
/// energy_of_means(): some rows of a frame have the energy that they have in the whole, bit for bit.
double energy_of_mean(const std::array<double, 3>& sum, double weight) {
  return weight > 0 ? sum[0] / weight + sum[1] / weight + sum[2] / weight : 0;
}

struct PixelBlock {
  double mean;  ///< luminance
  double pixels;
};

/// Of 8x8 pixels, fewer at the right and lower edge: of few samples many pixels are black and some far too bright, but
/// as many as there are in a block tell how bright it is.
std::vector<PixelBlock> blocks_of(const std::vector<double>& energies, const Window& window) {
  constexpr int side = 8;
  std::vector<PixelBlock> blocks;
  for (int y = 0; y < window.height; y += side)
    for (int x = 0; x < window.width; x += side) {
      const int width = std::min(side, window.width - x), height = std::min(side, window.height - y);
      double sum = 0;
      for (int row = y; row < y + height; ++row) {
        const auto first = energies.begin() + static_cast<std::ptrdiff_t>(row) * window.width + x;
        sum =
            std::accumulate(first, first + width, sum, [](double all, double e) { return all + std::max(e / 3, 0.0); });
      }
      const double pixels = width * height;
      blocks.push_back({sum / pixels, pixels});
    }
  return blocks;
}

std::size_t index(int input) { return static_cast<std::size_t>(input); }

bool is_relative(int input) {
  return (input >= RPF_INPUT_POSITION && input < RPF_INPUT_MISS) || input == RPF_INPUT_DISTANCE2;
}

PositionFacts facts_of(std::vector<float> (&positions)[3]) {
  PositionFacts facts;
  for (std::vector<float>& component : positions)
    component.erase(std::remove_if(component.begin(), component.end(), [](float p) { return std::isnan(p); }),
                    component.end());
  if (positions[0].empty()) return facts;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    facts.median[k] = lower_median(positions[k]);
    for (const float position : positions[k]) sum += std::fabs(position - facts.median[k]);
  }
  if (sum > 0) facts.deviation = sum / (3 * static_cast<double>(positions[0].size()));
  return facts;
}

}  // namespace

ObserveScan::ObserveScan(const SampleBuffer& frame, const Settings& settings)
    : method_(settings.method),
      threads_(thread_count(settings)),
      clean_(begin_frame(frame, settings)),
      cleaning_(clean_.frame, clean_.columns, settings),
      view_(clean_),
      energies_(frame.data_window.pixel_count()),
      weighted_(clean_.columns.weight ? energies_.size() : 0) {
  for (int input = RPF_INPUT_NORMAL; input < RPF_INPUTS; ++input)
    if (view_.has(input)) (is_relative(input) ? relative_ : plain_).push_back(input);
  for (auto& component : positions_) component.assign(energies_.size(), missing);
}

void ObserveScan::add(SampleBuffer& rows) {
  const std::size_t first = first_pixel(rows.data_window, clean_.frame.data_window);
  cleaning_.add(rows, [&](std::size_t place, std::uint32_t begin, std::uint32_t end, const ColorSum& sum) {
    energies_[first + place] = energy_of_mean(sum.color, sum.samples);
    if (clean_.columns.weight) include_weighted(rows, first + place, begin, end);
    include_position(rows, first + place, begin, end);
  });
  if (cleaning_.lacks_positions()) center_missing_positions(rows, clean_.columns, method_);
  const auto& weight = clean_.columns.weight;
  for (std::size_t i = 0; weight && i < rows.sample_count(); ++i)
    largest_weight_ = std::max(largest_weight_, rows.record(i)[*weight]);
  found_.has_hit = found_.has_hit || view_.any_hit(rows);
  leave_constant(rows, plain_, first_plain_);
}

void ObserveScan::include_weighted(const SampleBuffer& rows, std::size_t pixel, std::uint32_t begin,
                                   std::uint32_t end) {
  const Columns& columns = clean_.columns;
  std::array<double, 3> sum{};
  double weights = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const float* record = rows.record(i);
    const double weight = record[*columns.weight];
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * record[columns.color[c]];
    weights += weight;
  }
  weighted_[pixel] = weights > 0 ? energy_of_mean(sum, weights) : energies_[pixel];
}

void ObserveScan::include_position(const SampleBuffer& rows, std::size_t pixel, std::uint32_t begin,
                                   std::uint32_t end) {
  if (begin == end || !view_.has_position(rows.record(begin))) return;
  for (std::size_t k = 0; k < 3; ++k) positions_[k][pixel] = view_.position(rows.record(begin), k);
}

void ObserveScan::know_first(const SampleBuffer& rows, const std::vector<int>& inputs, FirstValues& first) const {
  if (std::exchange(first.are_known, true)) return;
  const RecordView view = view_.only(inputs);
  InputBlock block;
  ColumnBlock records = view.block();
  records.take(rows.record(0), 1);
  view.read(records, found_.positions, block);
  for (const int input : inputs) first.values[input] = block.values[input][0];
}

void ObserveScan::leave_constant(const SampleBuffer& rows, std::vector<int>& inputs, FirstValues& first) const {
  const std::size_t count = rows.sample_count();
  if (count == 0 || inputs.empty()) return;
  know_first(rows, inputs, first);
  constexpr std::size_t samples_of_part = 256 * block_records;
  const std::size_t parts = (count - 1) / samples_of_part + 1;
  Marked varying{};
  const auto look_at = [&](std::size_t part) {
    const std::size_t begin = part * samples_of_part;
    find_varying(rows, begin, std::min(begin + samples_of_part, count), inputs, first, varying);
  };
  const auto leave_unmarked = [&] {
    inputs.erase(std::remove_if(inputs.begin(), inputs.end(), [&](int i) { return varying.at(index(i)).load(); }),
                 inputs.end());
  };
  look_at(0);  // mostly enough
  leave_unmarked();
  if (inputs.empty()) return;
  // From the end on: what does not vary in the first rows, such as a sky, may do so in all others.
  Workers(threads_).for_all(1, parts, [&](std::size_t n, std::size_t /*worker*/) { look_at(parts - n); });
  leave_unmarked();
}

void ObserveScan::find_varying(const SampleBuffer& rows, std::size_t begin, std::size_t end, std::vector<int> inputs,
                               const FirstValues& first, Marked& varying) const {
  InputBlock block;
  RecordView view = view_.only(inputs);
  ColumnBlock records = view.block();
  for (std::size_t i = begin; i < end && !inputs.empty(); i += block_records) {
    const std::size_t count = std::min(block_records, end - i);
    records.take(rows.record(i), count);
    view.read(records, found_.positions, block);
    const auto varies = [&](int input) {
      const float* values = block.values[input];
      std::atomic<bool>& mark = varying.at(index(input));
      if (std::any_of(values, values + count, [&](float value) { return value != first.values[input]; })) mark = true;
      return mark.load(std::memory_order_relaxed);
    };
    const auto left = std::remove_if(inputs.begin(), inputs.end(), varies);
    if (left == inputs.end()) continue;
    inputs.erase(left, inputs.end());
    view = view_.only(inputs);
    records = view.block();
  }
}

/// The power of two that exposes the frame: of the mean luminance, without what is far above the median.
float ObserveScan::exposure() const {
  const std::vector<PixelBlock> blocks = blocks_of(energies_, clean_.frame.data_window);
  std::vector<double> positive;
  for (const PixelBlock& block : blocks)
    if (block.mean > 0) positive.push_back(block.mean);
  if (positive.empty()) return 1;
  const double limit = 8 * lower_median(std::move(positive));
  double sum = 0;
  for (const PixelBlock& block : blocks) sum += block.pixels * std::min(block.mean, limit);
  const double mean = sum / static_cast<double>(energies_.size());
  return power_of_two(-2 - std::ilogb(mean * radiance_scale(found_.cleaned.brightest)));
}

double ObserveScan::energy() const {
  const std::vector<double>& means = weighted_.empty() ? energies_ : weighted_;
  const Window& crop = clean_.prepared.facts.crop;
  double sum = 0;
  for (int y = crop.y; y < crop.y + crop.height; ++y) {
    const auto row = means.begin() + static_cast<std::ptrdiff_t>(y) * clean_.frame.data_window.width + crop.x;
    sum += std::accumulate(row, row + crop.width, 0.0);
  }
  return sum;
}

bool ObserveScan::finish() {
  found_.cleaned = cleaning_.report();
  if (!found_.cleaned.has_color) {
    found_.has_hit = false;
    largest_weight_ = 0;
    for (auto& component : positions_) component.clear();
    std::fill(energies_.begin(), energies_.end(), 0);
    std::fill(weighted_.begin(), weighted_.end(), 0);
  }
  for (const LostPixel& lost : found_.cleaned.lost) {
    std::array<double, 3> sum{};
    for (std::uint32_t i = 0; i < lost.samples; ++i)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += lost.color[c];
    energies_[lost.pixel] = energy_of_mean(sum, lost.samples);
    if (!weighted_.empty()) weighted_[lost.pixel] = energies_[lost.pixel];
  }
  found_.exposure = exposure();
  found_.energy = energy();
  found_.weight_scale = largest_weight_ > 0 ? power_of_two(-std::ilogb(largest_weight_)) : 1;
  found_.positions = facts_of(positions_);
  energies_ = weighted_ = {};
  for (auto& component : positions_) component = {};
  return found_.cleaned.has_color;
}

ObservedFindings ObserveScan::findings() {
  if (found_.cleaned.has_color) {
    std::set_union(plain_.begin(), plain_.end(), relative_.begin(), relative_.end(),
                   std::back_inserter(found_.constant));
  } else {
    for (int input = RPF_INPUT_NORMAL; input < RPF_INPUTS; ++input)
      if (view_.has(input)) found_.constant.push_back(input);
  }
  return std::move(found_);
}

}  // namespace rpf
