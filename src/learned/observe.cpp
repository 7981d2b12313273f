#include "learned/observe.h"

#include <algorithm>
#include <utility>

#include "frame/clean_frame.h"
#include "frame/repack.h"
#include "learned/record_view.h"
#include "parallel/thread_count.h"

namespace rpf {
namespace {

/// Which inputs the records get columns for, behind the color: those that vary and that the network looks at, and the
/// albedo.
void plan_columns(EstimatePlan& plan, const RecordView& view, const std::vector<int>& constant) {
  plan.column.fill(-1);
  plan.live = {0, 1, 2, 3, 4, 5};
  int column = 3;
  for (int input = RPF_INPUT_NORMAL; input < RPF_INPUTS; ++input) {
    if (!view.has(input) || !looks_at(*plan.network, input)) continue;
    const bool is_live = std::find(constant.begin(), constant.end(), input) == constant.end();
    const bool is_base = plan.has_albedo && input >= RPF_INPUT_ALBEDO && input < RPF_INPUT_ALBEDO + 3;
    if (is_live) plan.live.push_back(input);
    if (!is_live && !is_base) continue;
    plan.column.at(static_cast<std::size_t>(input)) = column++;
  }
}

/// Inputs that the records have columns for, in the order of these.
std::vector<int> columns_of(const EstimatePlan& plan) {
  std::vector<int> columns;
  for (int input = RPF_INPUT_NORMAL; input < RPF_INPUTS; ++input)
    if (plan.column.at(static_cast<std::size_t>(input)) >= 0) columns.push_back(input);
  return columns;
}

/// Writes what the network sees in the place of records: scaled color, then the inputs that have columns.
class RecordMaker {
 public:
  RecordMaker(const CleanFrame& clean, const std::vector<int>& inputs, const PositionFacts& positions)
      : view_(RecordView(clean).only(inputs)),
        inputs_(inputs),
        positions_(positions),
        color_(clean.columns.color),
        scale_(clean.prepared.facts.radiance_scale) {}

  /// For the records that are replaced.
  ColumnBlock block() const { return view_.block({color_[0], color_[1], color_[2]}); }

  void operator()(const ColumnBlock& records, float* to) const {
    InputBlock block;
    float color[3][block_records];
    view_.read(records, positions_, block);
    std::vector<const float*> columns;
    for (std::size_t k = 0; k < 3; ++k) {
      std::transform(records[color_[k]], records[color_[k]] + block_records, color[k],
                     [&](float c) { return c * scale_; });
      columns.push_back(color[k]);
    }
    for (const int input : inputs_) columns.push_back(block.values[input]);
    write_records(columns, records.count(), to);
  }

 private:
  RecordView view_;
  const std::vector<int>& inputs_;
  const PositionFacts& positions_;
  const std::size_t* color_;
  float scale_;
};

/// The selected channels that the network looks at by name: those of inputs that vary, and the others.
void sort_names(const CleanFrame& clean, const EstimatePlan& plan, PreparedFrame& prepared) {
  const auto sort = [&](const std::string& name, std::vector<std::string>& used) {
    if (!looks_at(*plan.network, name)) return;
    (plan.is_live(input_of(name)) ? used : prepared.dropped).push_back(name);
  };
  Variables& names = prepared.facts.variables;
  for (const std::string& slot : clean.selection.random) sort(short_name(slot), names.random_names);
  for (const std::string& slot : clean.selection.features) sort(short_name(slot), names.feature_names);
  if (clean.columns.hit) sort("hit", names.feature_names);
}

}  // namespace

Observed observe(SampleBuffer samples, const Settings& settings, std::shared_ptr<const Network> network) {
  const SampleBuffer frame = without_samples(samples);
  ObserveScan scan(frame, settings);
  scan.add(samples);
  scan.finish();
  scan.look_again(samples);
  const ObservedFindings found = scan.findings();
  Observed observed = observe_frame(frame, found, settings, std::move(network));
  observed.prepared.frame.first_sample =
      observe_rows(std::move(samples), frame, found, settings, observed.plan, observed.prepared);
  return observed;
}

Observed observe_frame(const SampleBuffer& whole, const ObservedFindings& found, const Settings& settings,
                       std::shared_ptr<const Network> network) {
  CleanFrame clean = begin_frame(whole, settings);
  take_report(clean, found.cleaned);
  const RecordView view(clean);
  Observed result;
  EstimatePlan& plan = result.plan;
  plan.network = std::move(network);
  plan.width = clean.prepared.facts.width;
  plan.height = clean.prepared.facts.height;
  plan.carried = clean.prepared.facts.carried;
  plan.exposure = found.exposure;
  plan.weight_scale = found.weight_scale;
  plan.has_albedo = view.has(RPF_INPUT_ALBEDO) && found.has_hit;
  plan_columns(plan, view, found.constant);
  sort_names(clean, plan, clean.prepared);
  clean.prepared.frame.variables = 3 + columns_of(plan).size();
  result.energy = found.energy * clean.prepared.facts.radiance_scale;
  result.prepared = std::move(clean.prepared);
  return result;
}

std::vector<std::uint32_t> observe_rows(SampleBuffer rows, const SampleBuffer& whole, const ObservedFindings& found,
                                        const Settings& settings, const EstimatePlan& plan, PreparedFrame& prepared) {
  CleanFrame clean = begin_frame(whole, settings);
  take_report(clean, found.cleaned);
  take_rows(clean, std::move(rows), found.cleaned, settings.method);
  const std::vector<int> columns = columns_of(plan);
  Frame& frame = prepared.frame;
  frame.others = carried_values(clean, false);
  frame.weights = std::move(clean.prepared.frame.weights);
  const RecordMaker make(clean, columns, found.positions);
  frame.records = repack(clean.samples, frame.variables, make.block(), thread_count(settings), make);
  return std::move(clean.samples.first_sample);
}

}  // namespace rpf
