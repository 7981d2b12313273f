#include "opencl/sample_stage.h"

#include <algorithm>

#include "rpf_network.h"

namespace rpf {
namespace {

/// Samples at once: their values are a few MB.
constexpr std::size_t samples_at_once = 8192;

std::size_t whole_rows(std::size_t samples) { return (samples + RPF_SAMPLE_ROW - 1) / RPF_SAMPLE_ROW; }

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
      see_samples_(program.kernel("see_samples")),
      see_pixels_(program.kernel("see_pixels")),
      weigh_samples_(program.kernel("weigh_samples")),
      sum_samples_(program.kernel("sum_samples")),
      columns_(record_columns(job.plan)),
      columns_buffer_(session.copy(columns_)),
      guide_columns_(session.copy(guide_columns(job.plan))),
      base_columns_(session.copy(base_columns(job.plan))) {}

std::uint32_t SampleStage::samples(int pixel) const {
  const Window& w = job_.window;
  const int y = w.y + pixel / w.width, x = w.x + pixel % w.width;
  return job_.frame.samples(static_cast<std::size_t>(y) * static_cast<std::size_t>(job_.frame.width) +
                            static_cast<std::size_t>(x));
}

template <typename... Values>
void SampleStage::launch(cl::Kernel& kernel, const Values&... values) {
  cl_uint number = 0;
  (kernel.setArg(number++, values), ...);
  session_.enqueue(kernel, items_, 1);
}

int SampleStage::end_of_chunk(int first, int end) const {
  const int width = job_.window.width;
  if (width < job_.frame.width) end = std::min(end, (first / width + 1) * width);
  std::size_t count = samples(first);
  int p = first + 1;
  while (p < end && count + samples(p) <= samples_at_once) count += samples(p++);
  return p;
}

SampleStage::Chunk SampleStage::chunk(int first, int end) const {
  const Frame& frame = job_.frame;
  const EstimatePlan& plan = job_.plan;
  const Window& w = job_.window;
  const auto pixel = [&](int row, int x) {
    return static_cast<std::size_t>(w.y + row) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x);
  };
  const auto in_frame = [&](int p) { return pixel(p / w.width, w.x + p % w.width); };
  const int row = first / w.width, end_row = (end - 1) / w.width + 1;
  const std::size_t from = frame.first_sample[in_frame(first)],
                    count = frame.first_sample[in_frame(end - 1) + 1] - from;
  const std::size_t others = plan.carried - 3;
  const auto shared = [&](const auto* data, std::size_t number) {
    return session_.host_buffer(data, number * sizeof *data, CL_MEM_READ_ONLY);
  };
  return {
      {first, end, w.x, w.width, frame.width, row, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(count),
       static_cast<int>(frame.variables), plan.has_albedo ? 1 : 0, frame.weights.empty() ? 0 : 1, plan.exposure,
       plan.weight_scale, static_cast<std::uint32_t>(plan.network->sample_features),
       static_cast<std::uint32_t>(program_.feature_stride()), static_cast<int>(plan.carried)},
      count,
      shared(frame.record(from), count * frame.variables),
      others == 0 ? cl::Buffer() : shared(frame.others.data() + (from - frame.first_record) * others, count * others),
      frame.weights.empty() ? cl::Buffer() : shared(frame.weights.data() + (from - frame.first_record), count),
      shared(frame.first_sample.data() + pixel(row, 0), pixel(end_row, 0) - pixel(row, 0) + 1)};
}

void SampleStage::for_chunks(int first, int end, bool again, const Progress& progress,
                             const std::function<void(const Chunk&)>& body) {
  const int width = job_.window.width, pixels = (end - first) * width;
  for (int row = first, there = first; row < end; row = there) {
    there = bring(row, end, again);
    for (int p = row * width; p < there * width;) {
      const Chunk chunk = this->chunk(p, end_of_chunk(p, there * width));
      reserve(chunk.samples);
      body(chunk);
      progress(static_cast<double>(chunk.launch.end - p) / pixels);
      p = chunk.launch.end;
    }
  }
}

int SampleStage::bring(int first, int end, bool again) {
  if (job_.frame.supply == nullptr) return end;
  session_.finish();  // what was launched reads rows that may be gone then
  return job_.frame.bring(job_.window.y + first, job_.window.y + end, again) - job_.window.y;
}

void SampleStage::reserve(std::size_t samples) {
  if (samples <= capacity_) return;
  capacity_ = whole_rows(std::max(samples, samples_at_once)) * RPF_SAMPLE_ROW;
  const auto floats = [&](int values) {
    return session_.buffer(capacity_ * static_cast<std::size_t>(values) * sizeof(float));
  };
  seen_ = floats(RPF_SEEN);
  hidden_ = floats(padded(job_.plan.network->sample_features));
  features_ = floats(program_.feature_stride());
  weighed_ = floats(RPF_WEIGHT_FEATURES);
  weights_ = floats(1);
}

kernel::rpf_layer SampleStage::rows_of_samples(const DeviceLayer& layer, std::size_t samples) const {
  const int rows = static_cast<int>(whole_rows(samples));
  kernel::rpf_layer l{};
  l.area = {RPF_SAMPLE_ROW, rows, 0, rows, RPF_SAMPLE_ROW};
  l.coarse = {rows, RPF_SAMPLE_ROW * layer.shape.coarse_stride};
  l.own = {rows, RPF_SAMPLE_ROW * layer.shape.own_stride};
  l.out = {rows, RPF_SAMPLE_ROW * layer.shape.out_stride};
  return l;
}

template <typename... More>
void SampleStage::launch_on_samples(cl::Kernel& kernel, const Chunk& chunk, const More&... more) {
  const DeviceLayer &sample1 = program_.layer(0), &sample2 = program_.layer(1);
  kernel::rpf_layer first = rows_of_samples(sample1, chunk.samples);
  first.own = {static_cast<int>(chunk.samples), chunk.launch.variables};
  first.inputs = static_cast<int>(columns_.size());
  launch(kernel, chunk.records, base_columns_, columns_buffer_, sample1.weights, sample1.bias, sample2.weights,
         sample2.bias, seen_, hidden_, features_, chunk.launch, first, rows_of_samples(sample2, chunk.samples),
         more...);
}

void SampleStage::see(int first, int end, const DeviceGrid& pixel, const DeviceGrid& guides, const DeviceGrid& albedo,
                      const Progress& progress) {
  for_chunks(first, end, true, progress, [&](const Chunk& chunk) {
    launch_on_samples(see_samples_, chunk);
    launch(see_pixels_, chunk.records, guide_columns_, seen_, features_, chunk.first_sample, pixel.buffer,
           guides.buffer, albedo.buffer, chunk.launch, pixel.rows, guides.rows, albedo.rows, pixel.stored);
    if (trace_ != nullptr) keep_seen(chunk);
  });
}

void SampleStage::sum(int first, int end, const DeviceGrid& heads, const DeviceGrid& sums, const Progress& progress) {
  const DeviceLayer& weight1 = program_.layer(job_.plan.network->layers.size() - 2);
  for_chunks(first, end, false, progress, [&](const Chunk& chunk) {
    launch_on_samples(weigh_samples_, chunk, heads.buffer, chunk.first_sample, weight1.weights, weight1.bias,
                      program_.last_weights(), chunk.weights, weighed_, weights_,
                      rows_of_samples(weight1, chunk.samples), heads.rows, heads.stored);
    launch(sum_samples_, weights_, seen_, chunk.records, chunk.others, chunk.first_sample, sums.buffer, chunk.launch,
           sums.rows);
    if (trace_ != nullptr) keep(trace_->weights, weights_, chunk.samples, 1, 1);
  });
}

void SampleStage::keep(std::vector<float>& to, const cl::Buffer& from, std::size_t samples, int stride, int values) {
  const std::vector<float> all = session_.read<float>(from, 0, samples * static_cast<std::size_t>(stride));
  for (std::size_t s = 0; s < samples; ++s) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(s) * stride;
    to.insert(to.end(), first, first + values);
  }
}

void SampleStage::keep_seen(const Chunk& chunk) {
  const int features = job_.plan.network->sample_features;
  keep(trace_->sample1, hidden_, chunk.samples, padded(features), features);
  keep(trace_->sample2, features_, chunk.samples, program_.feature_stride(), features);
  std::vector<float> computed;
  keep(computed, seen_, chunk.samples, RPF_SEEN, RPF_INPUT_NORMAL);
  for (std::size_t s = 0; s < chunk.samples; ++s) {
    float inputs[RPF_INPUTS] = {};
    std::copy_n(computed.data() + s * RPF_INPUT_NORMAL, RPF_INPUT_NORMAL, inputs);
    for (std::size_t i = 0; i < columns_.size(); ++i)
      inputs[job_.plan.live[RPF_INPUT_NORMAL + i]] =
          job_.frame.record(chunk.launch.first_sample + s)[static_cast<std::size_t>(columns_[i])];
    trace_->inputs.insert(trace_->inputs.end(), std::begin(inputs), std::end(inputs));
  }
}

std::uint64_t SampleStage::bytes(const Network& network) {
  const int floats = RPF_SEEN + padded(network.sample_features) + padded(network.sample_features + RPF_CONTEXT) +
                     RPF_WEIGHT_FEATURES + 1;
  return samples_at_once * sizeof(float) * static_cast<std::uint64_t>(floats);
}

}  // namespace rpf
