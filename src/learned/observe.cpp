#include "learned/observe.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frame/clean_frame.h"
#include "frame/repack.h"
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

/// Of a pixel's samples, in scaled radiance.
double mean_luminance(const Frame& frame, std::size_t pixel) {
  const std::uint32_t first = frame.first_sample[pixel], end = frame.first_sample[pixel + 1];
  double sum = 0;
  for (std::uint32_t i = first; i < end; ++i) {
    const float* color = frame.record(i);
    sum += (static_cast<double>(color[0]) + color[1] + color[2]) / 3;
  }
  return first < end ? std::max(sum / (end - first), 0.0) : 0;
}

float power_of_two(int exponent) { return std::ldexp(1.0F, std::clamp(exponent, -126, 126)); }

/// The power of two that exposes the frame: of the mean luminance, without what is far above the median. Over all
/// samples, in the order of the pixels.
float exposure_of(const Frame& frame) {
  std::vector<double> luminances(frame.first_sample.size() - 1), positive;
  for (std::size_t pixel = 0; pixel < luminances.size(); ++pixel) luminances[pixel] = mean_luminance(frame, pixel);
  std::copy_if(luminances.begin(), luminances.end(), std::back_inserter(positive), [](double l) { return l > 0; });
  if (positive.empty()) return 1;
  const double limit = 8 * lower_median(std::move(positive));
  double sum = 0;
  for (const double l : luminances) sum += std::min(l, limit);
  return power_of_two(-2 - std::ilogb(sum / static_cast<double>(luminances.size())));
}

float weight_scale(const std::vector<float>& weights) {
  const float largest = weights.empty() ? 0 : *std::max_element(weights.begin(), weights.end());
  return largest > 0 ? power_of_two(-std::ilogb(largest)) : 1;
}

PositionFacts position_facts(const SampleBuffer& samples, const RecordView& view) {
  std::vector<float> there[3];  // of each component
  for (std::size_t pixel = 0; pixel + 1 < samples.first_sample.size(); ++pixel) {
    const std::uint32_t first = samples.first_sample[pixel];
    if (first == samples.first_sample[pixel + 1] || !view.has_position(samples.record(first))) continue;
    for (std::size_t k = 0; k < 3; ++k) there[k].push_back(view.position(samples.record(first), k));
  }
  PositionFacts facts;
  if (there[0].empty()) return facts;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    facts.median[k] = lower_median(there[k]);
    for (const float position : there[k]) sum += std::fabs(position - facts.median[k]);
  }
  if (sum > 0) facts.deviation = sum / (3 * static_cast<double>(there[0].size()));
  return facts;
}

/// Inputs that there are channels for, in their order.
std::vector<int> available_inputs(const RecordView& view) {
  std::vector<int> inputs;
  for (int input = RPF_INPUT_NORMAL; input < RPF_INPUTS; ++input)
    if (view.has(input)) inputs.push_back(input);
  return inputs;
}

/// Those of `inputs` that do not vary. Looks at each until it varies: at most of a frame's only for a few samples.
std::vector<int> constant_inputs(const SampleBuffer& samples, const RecordView& all, const PositionFacts& positions,
                                 std::vector<int> inputs) {
  InputBlock block;
  float first[RPF_INPUTS] = {};
  RecordView view = all;
  for (std::size_t i = 0; i < samples.sample_count() && !inputs.empty(); i += block_records) {
    const std::size_t count = std::min(block_records, samples.sample_count() - i);
    view.read(samples.record(i), count, positions, block);
    for (const int input : inputs)
      if (i == 0) first[input] = block.values[input][0];
    const auto varies = [&](int input) {
      const float* values = block.values[input];
      return std::any_of(values, values + count, [&](float value) { return value != first[input]; });
    };
    const auto varying = std::remove_if(inputs.begin(), inputs.end(), varies);
    if (varying == inputs.end()) continue;
    inputs.erase(varying, inputs.end());
    view = all.only(inputs);
  }
  return inputs;
}

/// Which inputs the records get columns for, behind the color: those that vary, and the albedo.
std::vector<int> plan_columns(EstimatePlan& plan, const std::vector<int>& inputs, const std::vector<int>& constant) {
  plan.column.fill(-1);
  plan.live = {0, 1, 2, 3, 4, 5};
  std::vector<int> columns;
  for (const int input : inputs) {
    const bool is_live = std::find(constant.begin(), constant.end(), input) == constant.end();
    const bool is_base = plan.has_albedo && input >= RPF_INPUT_ALBEDO && input < RPF_INPUT_ALBEDO + 3;
    if (is_live) plan.live.push_back(input);
    if (!is_live && !is_base) continue;
    plan.column.at(static_cast<std::size_t>(input)) = static_cast<int>(3 + columns.size());
    columns.push_back(input);
  }
  return columns;
}

/// Writes what the network sees in the place of records: scaled color, then the inputs that have columns.
class RecordMaker {
 public:
  RecordMaker(const CleanFrame& clean, const RecordView& view, const std::vector<int>& columns,
              const PositionFacts& positions)
      : view_(view.only(columns)),
        columns_(columns),
        positions_(positions),
        color_(clean.columns.color),
        stride_(clean.samples.layout.size()),
        scale_(clean.prepared.facts.radiance_scale) {}

  void operator()(const float* records, float* to, std::size_t count) const {
    InputBlock block;
    view_.read(records, count, positions_, block);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) *to++ = records[i * stride_ + color_[k]] * scale_;
      for (const int input : columns_) *to++ = block.values[input][i];
    }
  }

 private:
  RecordView view_;
  const std::vector<int>& columns_;
  const PositionFacts& positions_;
  const std::size_t* color_;
  std::size_t stride_;
  float scale_;
};

/// The selected channels by name: those of inputs that vary, and the others.
void sort_names(const CleanFrame& clean, const EstimatePlan& plan, PreparedFrame& prepared) {
  const auto sort = [&](const std::string& name, std::vector<std::string>& used) {
    (plan.is_live(input_of(name)) ? used : prepared.dropped).push_back(name);
  };
  Variables& names = prepared.facts.variables;
  for (const std::string& slot : clean.selection.random) sort(short_name(slot), names.random_names);
  for (const std::string& slot : clean.selection.features) sort(short_name(slot), names.feature_names);
  if (clean.columns.hit) sort("hit", names.feature_names);
}

}  // namespace

Observed observe(SampleBuffer samples, const Settings& settings, std::shared_ptr<const Network> network) {
  CleanFrame clean = clean_frame(std::move(samples), settings);
  const RecordView view(clean);
  const PositionFacts positions = position_facts(clean.samples, view);
  Observed result;
  EstimatePlan& plan = result.plan;
  plan.network = std::move(network);
  plan.width = clean.prepared.facts.width;
  plan.height = clean.prepared.facts.height;
  plan.carried = clean.prepared.facts.carried;
  plan.weight_scale = weight_scale(clean.prepared.frame.weights);
  plan.has_albedo = view.has(RPF_INPUT_ALBEDO) && view.any_hit(clean.samples);
  const std::vector<int> inputs = available_inputs(view);
  const std::vector<int> columns = plan_columns(plan, inputs, constant_inputs(clean.samples, view, positions, inputs));
  sort_names(clean, plan, clean.prepared);

  clean.prepared.colors = carried_values(clean, false);
  Frame& frame = clean.prepared.frame;
  frame.variables = 3 + columns.size();
  frame.records = repack(clean.samples, frame.variables, RecordMaker(clean, view, columns, positions));
  frame.first_sample = std::move(clean.samples.first_sample);
  plan.exposure = exposure_of(frame);
  result.prepared = std::move(clean.prepared);
  return result;
}

}  // namespace rpf
