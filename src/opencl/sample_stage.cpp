#include "opencl/sample_stage.h"

#include <algorithm>

#include "rpf_network.h"

namespace rpf {
namespace {

/// A launch cannot be stopped: some hundredths of a second, but for a pixel that has more.
constexpr std::uint64_t samples_of_launch = 1 << 20;

/// Enough work for a work-item, and little enough that many have some.
constexpr std::uint64_t samples_of_part = 4096;

int column_of(const EstimatePlan& plan, int input) { return plan.column[static_cast<std::size_t>(input)]; }

/// Of the live inputs that are not computed.
std::vector<int> record_columns(const EstimatePlan& plan) {
  std::vector<int> columns;
  for (const int input : plan.live)
    if (input >= RPF_INPUT_NORMAL) columns.push_back(column_of(plan, input));
  return columns;
}

std::vector<int> guide_columns(const EstimatePlan& plan) {
  std::vector<int> columns;
  for (int i = RPF_INPUT_NORMAL; i < RPF_INPUT_NORMAL + RPF_GUIDES; ++i)
    columns.push_back(plan.is_live(i) ? column_of(plan, i) : -1);
  return columns;
}

std::vector<int> base_columns(const EstimatePlan& plan) {
  return {column_of(plan, RPF_INPUT_ALBEDO), column_of(plan, RPF_INPUT_ALBEDO + 1),
          column_of(plan, RPF_INPUT_ALBEDO + 2), column_of(plan, RPF_INPUT_MISS)};
}

}  // namespace

SampleStage::SampleStage(Session& session, const NetworkProgram& program, const EstimateJob& job, std::size_t items,
                         SampleTrace* trace)
    : session_(session),
      program_(program),
      job_(job),
      items_(items),
      trace_(trace),
      see_(program.kernel("see")),
      sum_(program.kernel("sum")),
      columns_(record_columns(job.plan)),
      columns_buffer_(session.copy(columns_)),
      guide_columns_(session.copy(guide_columns(job.plan))),
      base_columns_(session.copy(base_columns(job.plan))) {}

const std::uint32_t& SampleStage::first_sample(int row, int column) const {
  const Window& w = job_.window;
  return job_.frame.first_sample[static_cast<std::size_t>(w.y + row) * static_cast<std::size_t>(job_.frame.width) +
                                 static_cast<std::size_t>(w.x + column)];
}

SampleStage::Rows SampleStage::rows_of(const kernel::rpf_area& area) const {
  const Frame& frame = job_.frame;
  const EstimatePlan& plan = job_.plan;
  const std::size_t from = first_sample(area.first, 0), count = first_sample(area.end - 1, area.width) - from,
                    others = plan.carried - 3;
  const auto shared = [&](const auto* data, std::size_t number) {
    return number == 0 ? cl::Buffer() : session_.host_buffer(data, number * sizeof *data, CL_MEM_READ_ONLY);
  };
  const auto entries =
      static_cast<std::size_t>(area.end - 1 - area.first) * static_cast<std::size_t>(frame.width) + area.width + 1;
  const std::size_t record = from - frame.first_record;
  Rows rows{{},
            shared(frame.record(from), count * frame.variables),
            shared(frame.others.data() + record * others, count * others),
            frame.weights.empty() ? cl::Buffer() : shared(frame.weights.data() + record, count),
            shared(&first_sample(area.first, 0), entries)};
  kernel::rpf_samples& l = rows.launch;
  l.area = area;
  l.frame_width = frame.width;
  l.first_sample = static_cast<std::uint32_t>(from);
  l.samples = static_cast<std::uint32_t>(count);
  l.variables = static_cast<int>(frame.variables);
  l.inputs = static_cast<int>(columns_.size());
  l.has_albedo = plan.has_albedo ? 1 : 0;
  l.has_weights = frame.weights.empty() ? 0 : 1;
  l.exposure = plan.exposure;
  l.weight_scale = plan.weight_scale;
  l.carried = static_cast<int>(plan.carried);
  l.is_traced = trace_ == nullptr ? 0 : 1;
  return rows;
}

int SampleStage::bring(int first, int end, bool again) {
  if (job_.frame.supply == nullptr) return end;
  session_.finish();  // what was launched reads rows that may be gone then
  return job_.frame.bring(job_.window.y + first, job_.window.y + end, again) - job_.window.y;
}

std::uint32_t SampleStage::samples_in(const kernel::rpf_area& area, int part) const {
  const int rows = area.end - area.first, row = area.first + part % rows, begin = part / rows * area.part;
  return first_sample(row, std::min(begin + area.part, area.width)) - first_sample(row, begin);
}

int SampleStage::end_of_launch(const kernel::rpf_area& area, int first) const {
  const int parts = kernel::rpf_parts_of_row(&area) * (area.end - area.first);
  if (trace_ != nullptr) return parts;
  std::uint64_t samples = samples_in(area, first++);
  while (first < parts && samples + samples_in(area, first) <= samples_of_launch) samples += samples_in(area, first++);
  return first;
}

/// The rows with parts as their samples ask for.
kernel::rpf_area SampleStage::in_parts(kernel::rpf_area rows) const {
  std::uint64_t samples = 0;
  for (int row = rows.first; row < rows.end; ++row) samples += first_sample(row, rows.width) - first_sample(row, 0);
  const std::uint64_t pixels =
                          static_cast<std::uint64_t>(rows.width) * static_cast<std::uint64_t>(rows.end - rows.first),
                      fitting = samples_of_part * pixels / std::max<std::uint64_t>(samples, 1);
  rows.part = static_cast<int>(std::clamp<std::uint64_t>(fitting, 1, static_cast<std::uint64_t>(rows.part)));
  return rows;
}

void SampleStage::for_launches(const kernel::rpf_area& rows, bool again, const Progress& progress,
                               const Launch& launch) {
  kernel::rpf_area area = in_parts(rows);
  const int parts_of_row = kernel::rpf_parts_of_row(&area), all = parts_of_row * (rows.end - rows.first);
  for (int row = rows.first; row < rows.end; row = area.end) {
    area.first = row;
    // What is traced is copied as it lies: of a window, only a row's samples lie side by side.
    area.end = bring(row, trace_ == nullptr ? rows.end : row + 1, again);
    Rows there = rows_of(area);
    const int parts = parts_of_row * (area.end - area.first);
    for (int part = 0; part < parts; part = there.launch.end_part) {
      there.launch.first_part = part;
      there.launch.end_part = end_of_launch(area, part);
      launch(there);
      progress(static_cast<double>(there.launch.end_part - part) / all);
    }
  }
}

template <typename... More>
void SampleStage::launch_on_samples(cl::Kernel& kernel, const Rows& rows, const More&... more) {
  const DeviceLayer &sample1 = program_.layer(0), &sample2 = program_.layer(1);
  cl_uint number = 0;
  const auto set = [&](const auto&... values) { (kernel.setArg(number++, values), ...); };
  set(rows.records, base_columns_, columns_buffer_, sample1.weights, sample1.bias, sample2.weights, sample2.bias,
      rows.first_sample, more...);
  session_.enqueue(kernel, items_, 1);
}

void SampleStage::see(const kernel::rpf_area& area, const SeenGrids& out, const Progress& progress) {
  const DeviceLayer& enter = program_.layer(2);
  for_launches(area, true, progress, [&](const Rows& rows) {
    const cl::Buffer trace = trace_of(rows, traced_floats());
    launch_on_samples(see_, rows, guide_columns_, enter.weights, enter.bias, out.enter.buffer, out.guides.buffer,
                      out.albedo.buffer, out.kept.buffer, out.pixel.buffer, trace, rows.launch, out.enter.rows,
                      out.guides.rows, out.albedo.rows, out.kept.rows, out.pixel.rows);
    if (trace_ != nullptr) keep_seen(rows, trace);
  });
}

void SampleStage::sum(const kernel::rpf_area& area, const DeviceGrid& heads, const DeviceGrid& kept,
                      const DeviceGrid& sums, const Progress& progress) {
  const DeviceLayer& weight1 = program_.layer(job_.plan.network->layers.size() - 2);
  for_launches(area, false, progress, [&](const Rows& rows) {
    const cl::Buffer trace = trace_of(rows, 1);
    launch_on_samples(sum_, rows, heads.buffer, weight1.weights, weight1.bias, program_.last_weights(), rows.weights,
                      rows.others, kept.buffer, sums.buffer, trace, rows.launch, heads.rows, kept.rows, sums.rows,
                      heads.stored);
    if (trace_ == nullptr) return;
    const std::vector<float> weights = session_.read<float>(trace, 0, rows.launch.samples);
    trace_->weights.insert(trace_->weights.end(), weights.begin(), weights.end());
  });
}

// A launch has all samples of its row.
cl::Buffer SampleStage::trace_of(const Rows& rows, std::size_t floats) const {
  if (trace_ == nullptr) return {};
  return session_.buffer(std::max<std::size_t>(rows.launch.samples * floats, 1) * sizeof(float));
}

std::size_t SampleStage::traced_floats() const {
  return RPF_SEEN + 2 * static_cast<std::size_t>(padded(job_.plan.network->sample_features));
}

void SampleStage::keep_seen(const Rows& rows, const cl::Buffer& trace) {
  const auto features = static_cast<std::size_t>(job_.plan.network->sample_features),
             stride = static_cast<std::size_t>(padded(job_.plan.network->sample_features));
  const std::vector<float> all = session_.read<float>(trace, 0, rows.launch.samples * traced_floats());
  for (std::size_t s = 0; s < rows.launch.samples; ++s) {
    const float* seen = all.data() + s * traced_floats();
    const float* record = job_.frame.record(rows.launch.first_sample + s);
    float inputs[RPF_INPUTS] = {};
    std::copy_n(seen, RPF_INPUT_NORMAL, inputs);
    for (std::size_t i = 0; i < columns_.size(); ++i)
      inputs[job_.plan.live[RPF_INPUT_NORMAL + i]] = record[static_cast<std::size_t>(columns_[i])];
    const float *hidden = seen + RPF_SEEN, *outputs = hidden + stride;
    trace_->inputs.insert(trace_->inputs.end(), std::begin(inputs), std::end(inputs));
    trace_->sample1.insert(trace_->sample1.end(), hidden, hidden + features);
    trace_->sample2.insert(trace_->sample2.end(), outputs, outputs + features);
  }
}

}  // namespace rpf
