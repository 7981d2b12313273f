#include "learned/observe.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "learned/record_view.h"

namespace rpf {
namespace {

/// The value in the middle; of two the lower one.
template <typename Number>
Number lower_median(std::vector<Number> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double mean_luminance(const Frame& frame, std::size_t pixel) {
  double sum = 0;
  for (std::uint32_t i = frame.first_sample[pixel]; i < frame.first_sample[pixel + 1]; ++i) {
    const float* color = frame.record(i);
    sum += (static_cast<double>(color[0]) + color[1] + color[2]) / 3;
  }
  return frame.samples(pixel) > 0 ? std::max(sum / frame.samples(pixel), 0.0) : 0;
}

float power_of_two(int exponent) { return std::ldexp(1.0F, std::clamp(exponent, -126, 126)); }

float weight_scale(const std::vector<float>& weights) {
  const float largest = weights.empty() ? 0 : *std::max_element(weights.begin(), weights.end());
  return largest > 0 ? power_of_two(-std::ilogb(largest)) : 1;
}

PositionFacts position_facts(const Frame& frame, const RecordView& view) {
  std::vector<const float*> there;
  for (std::size_t pixel = 0; pixel + 1 < frame.first_sample.size(); ++pixel)
    if (frame.samples(pixel) > 0 && view.has_position(frame.record(frame.first_sample[pixel])))
      there.push_back(frame.record(frame.first_sample[pixel]));
  PositionFacts facts;
  if (there.empty()) return facts;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<float> values;
    values.reserve(there.size());
    for (const float* record : there) values.push_back(view.position(record, k));
    facts.median[k] = lower_median(std::move(values));
    for (const float* record : there) sum += std::fabs(view.position(record, k) - facts.median[k]);
  }
  if (sum > 0) facts.deviation = sum / (3 * static_cast<double>(there.size()));
  return facts;
}

/// Which columns of records of one width take the place of records of another, in one vector.
void resize_records(Frame& frame, std::size_t columns) {
  const std::size_t count = frame.sample_count(), from = frame.variables;
  if (columns > from) {
    frame.records.reserve(count * columns);  // resize() alone would take twice as much
    frame.records.resize(count * columns);
    for (std::size_t i = count; i-- > 0;)
      std::copy_backward(frame.record(i), frame.record(i) + from,
                         frame.records.begin() + static_cast<std::ptrdiff_t>(i * columns + from));
  } else {
    for (std::size_t i = 0; i < count; ++i)
      std::copy_n(frame.record(i), columns, frame.records.begin() + static_cast<std::ptrdiff_t>(i * columns));
    frame.records.resize(count * columns);
  }
  frame.variables = columns;
}

/// Inputs that the records get a column for, in their order.
std::vector<int> available_inputs(const RecordView& view) {
  std::vector<int> inputs;
  for (int input = RPF_INPUT_NORMAL; input < RPF_INPUTS; ++input)
    if (view.has(input)) inputs.push_back(input);
  return inputs;
}

/// Writes inputs over the records, each wide enough for both. Returns which of them vary.
std::vector<bool> write_inputs(Frame& frame, const RecordView& view, const PositionFacts& positions,
                               const std::vector<int>& inputs) {
  std::vector<bool> varies(RPF_INPUTS, false);
  float values[RPF_INPUTS] = {}, first[RPF_INPUTS] = {};
  for (std::size_t i = 0; i < frame.sample_count(); ++i) {
    float* record = frame.records.data() + i * frame.variables;
    view.read(record, positions, values);
    if (i == 0) std::copy_n(values, RPF_INPUTS, first);
    float* to = record + 3;
    for (const int input : inputs) {
      if (values[input] != first[input]) varies[static_cast<std::size_t>(input)] = true;
      *to++ = values[input];
    }
  }
  return varies;
}

/// Keeps these columns behind the color.
void keep_columns(Frame& frame, const std::vector<std::size_t>& columns) {
  for (std::size_t i = 0; i < frame.sample_count(); ++i) {
    float* record = frame.records.data() + i * frame.variables;
    for (std::size_t k = 0; k < columns.size(); ++k) record[3 + k] = record[columns[k]];
  }
  resize_records(frame, 3 + columns.size());
}

/// Sorts names into those of inputs that vary and the others.
void drop_names(const EstimatePlan& plan, std::vector<std::string>& names, std::vector<std::string>& dropped) {
  const auto is_used = [&](const std::string& name) { return plan.is_live(input_of(name)); };
  const auto unused = std::stable_partition(names.begin(), names.end(), is_used);
  dropped.insert(dropped.end(), unused, names.end());
  names.erase(unused, names.end());
}

}  // namespace

float exposure_of(const Frame& frame) {
  std::vector<double> luminances, positive;
  for (std::size_t pixel = 0; pixel + 1 < frame.first_sample.size(); ++pixel)
    luminances.push_back(mean_luminance(frame, pixel));
  std::copy_if(luminances.begin(), luminances.end(), std::back_inserter(positive), [](double l) { return l > 0; });
  if (positive.empty()) return 1;
  const double limit = 8 * lower_median(std::move(positive));
  double sum = 0;
  for (const double l : luminances) sum += std::min(l, limit);
  return power_of_two(-2 - std::ilogb(sum / static_cast<double>(luminances.size())));
}

EstimatePlan observe(PreparedFrame& prepared, std::shared_ptr<const Network> network) {
  Frame& frame = prepared.frame;
  EstimatePlan plan;
  plan.network = std::move(network);
  plan.width = frame.width;
  plan.height = frame.height;
  plan.carried = prepared.facts.carried;
  plan.exposure = exposure_of(frame);
  plan.weight_scale = weight_scale(frame.weights);

  const RecordView view(prepared.facts.variables);
  const PositionFacts positions = position_facts(frame, view);
  const std::vector<int> inputs = available_inputs(view);
  plan.has_albedo = view.has(RPF_INPUT_ALBEDO) && view.any_hit(frame);
  if (3 + inputs.size() > frame.variables) resize_records(frame, 3 + inputs.size());
  const std::vector<bool> varies = write_inputs(frame, view, positions, inputs);

  plan.column.fill(-1);
  plan.live = {0, 1, 2, 3, 4, 5};
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const int input = inputs[k];
    const bool is_live = varies[static_cast<std::size_t>(input)];
    const bool is_base = plan.has_albedo && input >= RPF_INPUT_ALBEDO && input < RPF_INPUT_ALBEDO + 3;
    if (is_live) plan.live.push_back(input);
    if (!is_live && !is_base) continue;
    plan.column[static_cast<std::size_t>(input)] = static_cast<int>(3 + columns.size());
    columns.push_back(3 + k);
  }
  keep_columns(frame, columns);
  frame.has_missing = false;
  drop_names(plan, prepared.facts.variables.random_names, prepared.dropped);
  drop_names(plan, prepared.facts.variables.feature_names, prepared.dropped);
  return plan;
}

}  // namespace rpf
