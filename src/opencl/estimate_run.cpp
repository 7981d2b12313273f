#include "opencl/estimate_run.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "rpf_network.h"

namespace rpf {
namespace {

using Kind = EstimateStep::Kind;

/// Cells of a part of a row: as many parts as there are work-items, but each long enough.
int part_cells(int width, std::size_t items) {
  constexpr int least = 32, unit = RPF_LANES;
  const int share = width / static_cast<int>(std::min<std::size_t>(items, static_cast<std::size_t>(width)));
  return std::max(least, (share + unit - 1) / unit * unit);
}

/// Multiply-adds that the device is asked for before it is waited for: a fraction of a second, and of the whole.
constexpr double work_at_once = 2e9, least_waits = 16;

/// Of a row whose samples are kept: pitches of grids are ints.
constexpr std::uint32_t most_row_samples = 1 << 20;

/// Behind a grid there may be read, not more than a vector, what has no meaning.
constexpr std::size_t read_behind = RPF_LANES * sizeof(float);

double sample_count(const EstimateJob& job) {
  const Window& w = job.window;
  double sum = 0;
  for (int y = w.y; y < w.y + w.height; ++y) {
    const std::size_t row =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(job.frame.width) + static_cast<std::size_t>(w.x);
    sum += job.frame.first_sample[row + static_cast<std::size_t>(w.width)] - job.frame.first_sample[row];
  }
  return sum;
}

/// Samples of the row that has most; 0 where not all are in memory, or a row has too many: then there is no room for
/// what is computed of them.
int row_samples(const EstimateJob& job) {
  const Window& w = job.window;
  std::uint32_t most = 0;
  for (int y = w.y; job.frame.supply == nullptr && y < w.y + w.height; ++y) {
    const std::uint32_t* row =
        job.frame.first_sample.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(job.frame.width) + w.x;
    most = std::max(most, row[w.width] - row[0]);
  }
  return most > most_row_samples ? 0 : static_cast<int>(most);
}

}  // namespace

EstimateRun::EstimateRun(Session& session, const NetworkProgram& program, const EstimateJob& job, int first, int end,
                         std::size_t items, bool keep_all)
    : session_(session),
      program_(program),
      job_(job),
      items_(items),
      steps_(job.plan, job.window, sample_count(job), first, end, keep_all, row_samples(job)),
      samples_(session, program, job, items, keep_all ? &sample_trace_ : nullptr),
      halve_(program.kernel("halve")),
      embed_(program.kernel("embed")),
      weigh_pixels_(program.kernel("weigh_pixels")),
      filter_pass_(program.kernel("filter_pass")),
      finish_(program.kernel("finish")),
      first_(first),
      end_(end) {
  for (std::size_t i = 0; i < steps_.grids.size(); ++i) {
    const EstimateGrid& g = steps_.grids[i];
    const int rows = steps_.pipeline.rows(static_cast<int>(i));
    const std::size_t floats = static_cast<std::size_t>(rows) * static_cast<std::size_t>(g.pitch());
    grids_.push_back({session_.buffer(floats * sizeof(float) + read_behind), {rows, g.pitch()}, g.stored});
  }
}

template <typename... Values>
void EstimateRun::launch(cl::Kernel& kernel, const Values&... values) {
  cl_uint number = 0;
  (kernel.setArg(number++, values), ...);
  session_.enqueue(kernel, items_, 1);
}

kernel::rpf_area EstimateRun::area(const EstimateStep& step, int first, int end) const {
  const EstimateGrid& g = steps_.grids[static_cast<std::size_t>(step.out.front())];
  return {g.width, g.height, first, end, part_cells(g.width, items_)};
}

void EstimateRun::run_layer(const EstimateStep& step, const DeviceLayer& layer, int first, int end) {
  const DeviceGrid &coarse = grid(step.in.front()), &own = grid(step.in.back()), &out = grid(step.out.front());
  kernel::rpf_layer l{};
  l.area = area(step, first, end);
  l.coarse = coarse.rows;
  l.own = own.rows;
  l.out = out.rows;
  cl::Kernel kernel = layer.kernel;
  launch(kernel, coarse.buffer, own.buffer, layer.weights, layer.bias, out.buffer, l);
}

void EstimateRun::run_halve(const EstimateStep& step, int first, int end) {
  const DeviceGrid &in = grid(step.in.front()), &out = grid(step.out.front());
  const EstimateGrid& fine = steps_.grids[static_cast<std::size_t>(step.in.front())];
  launch(halve_, in.buffer, out.buffer, area(step, first, end), in.rows, out.rows, fine.width, fine.height, in.stored);
}

void EstimateRun::run_embed(const EstimateStep& step, int first, int end) {
  const DeviceGrid &cells = grid(step.in[0]), &guides = grid(step.in[1]), &out = grid(step.out.front());
  const bool keeps_logits = step.out.size() > 1;
  const DeviceGrid& logits = grid(step.out.back());
  const DeviceLayer& head = program_.head(step.number);
  launch(embed_, cells.buffer, guides.buffer, head.weights, head.bias, out.buffer, logits.buffer,
         area(step, first, end), cells.rows, guides.rows, out.rows, keeps_logits ? logits.rows : kernel::rpf_grid{},
         cells.stored, job_.plan.network->embedding);
}

void EstimateRun::run_weigh(const EstimateStep& step, int first, int end) {
  const DeviceGrid &embedded = grid(step.in.front()), &out = grid(step.out.front());
  launch(weigh_pixels_, embedded.buffer, out.buffer, area(step, first, end), embedded.rows, out.rows,
         job_.plan.network->dilation(step.number), embedded.stored - 1);
}

void EstimateRun::run_pass(const EstimateStep& step, int first, int end) {
  const DeviceGrid &in = grid(step.in[0]), &weights = grid(step.in[1]), &out = grid(step.out.front());
  const kernel::rpf_network_pass pass{
      area(step, first, end), weights.rows, in.rows, out.rows, job_.plan.network->dilation(step.number), in.stored};
  launch(filter_pass_, weights.buffer, in.buffer, out.buffer, pass);
}

void EstimateRun::run_finish(const EstimateStep& step, int first, int end) {
  const DeviceGrid &sums = grid(step.in[0]), &albedo = grid(step.in[1]), &heads = grid(step.in[2]);
  launch(finish_, sums.buffer, albedo.buffer, heads.buffer, result_, area(step, first, end), sums.rows, albedo.rows,
         heads.rows, region_, heads.stored, static_cast<int>(job_.plan.carried), job_.plan.has_albedo ? 1 : 0);
}

void EstimateRun::run_step(const EstimateStep& step, int first, int end, const Part& part) {
  switch (step.kind) {
    case Kind::see:
      return samples_.see(area(step, first, end),
                          {grid(steps_.enter), grid(steps_.guides), grid(steps_.albedo), optional_grid(steps_.kept),
                           optional_grid(steps_.pixel)},
                          part);
    case Kind::sum:
      return samples_.sum(area(step, first, end), grid(step.in[0]), optional_grid(steps_.kept), grid(step.out[0]),
                          part);
    case Kind::layer:
      run_layer(step, program_.layer(static_cast<std::size_t>(step.number)), first, end);
      break;
    case Kind::head:
      run_layer(step, program_.first_head(), first, end);
      break;
    case Kind::halve:
      run_halve(step, first, end);
      break;
    case Kind::embed:
      run_embed(step, first, end);
      break;
    case Kind::weigh:
      run_weigh(step, first, end);
      break;
    case Kind::pass:
      run_pass(step, first, end);
      break;
    case Kind::finish:
      run_finish(step, first, end);
      break;
  }
  part(1);
}

std::vector<float> EstimateRun::run(int x, int width, const EstimateProgress& progress) {
  std::vector<float> pixels(static_cast<std::size_t>(end_ - first_) * static_cast<std::size_t>(width) *
                            job_.plan.carried);
  const std::size_t bytes = pixels.size() * sizeof(float);
  region_ = {x, first_, width};
  result_ = session_.host_buffer(pixels.data(), bytes, CL_MEM_WRITE_ONLY);
  try {
    make(progress);
  } catch (...) {
    abandon();
    throw;
  }
  session_.read_back(result_, 0, bytes, pixels.data());
  result_ = {};
  return pixels;
}

// What was asked for reads and writes what is about to go.
void EstimateRun::abandon() {
  try {
    session_.finish();
  } catch (const std::exception&) {  // a device that is lost: what stopped the run is told, not this
  }
  result_ = {};
}

void EstimateRun::make(const EstimateProgress& progress) {
  const double all = steps_.work(), at_once = std::min(work_at_once * static_cast<double>(items_), all / least_waits);
  double asked_for = 0, marked = 0;  // since the latest mark, and before it
  cl::Event latest;
  // Of two marks the first is waited for, so that the device has work all the while.
  const auto wait = [&] {
    const cl::Event mark = session_.mark();
    if (latest() != nullptr) latest.wait();
    latest = mark;
    progress(std::exchange(marked, std::exchange(asked_for, 0)) / all);
  };
  steps_.pipeline.run([&](int number, int first, int end) {
    const EstimateStep& step = steps_.steps[static_cast<std::size_t>(number)];
    const double work = step.row_work * (end - first);
    run_step(step, first, end, [&](double share) {
      asked_for += work * share;
      if (asked_for > at_once) wait();
    });
  });
  session_.finish();
  progress((marked + asked_for) / all);
}

std::vector<float> EstimateRun::values_of(int number) {
  const EstimateGrid& g = steps_.grids[static_cast<std::size_t>(number)];
  const auto pitch = static_cast<std::size_t>(g.pitch());
  const std::vector<float> all =
      session_.read<float>(grid(number).buffer, 0, static_cast<std::size_t>(g.height) * pitch);
  const std::size_t stored = static_cast<std::size_t>(g.stored), plane = pitch / stored;
  std::vector<float> values;
  for (std::size_t y = 0; y < static_cast<std::size_t>(g.height); ++y)
    for (std::size_t x = 0; x < static_cast<std::size_t>(g.width); ++x)
      for (std::size_t k = 0; k < static_cast<std::size_t>(g.values); ++k)
        values.push_back(all[y * pitch + (g.planes ? k * plane + RPF_MARGIN + x : (x + RPF_BORDER) * stored + k)]);
  return values;
}

EstimateStage EstimateRun::stage(int number, const std::string& name) {
  return {name, static_cast<std::size_t>(steps_.grids[static_cast<std::size_t>(number)].values), values_of(number)};
}

EstimateStage EstimateRun::head_stage() {
  std::vector<EstimateStage> parts;
  for (const EstimateStep& step : steps_.steps)
    if (step.kind == Kind::head || step.kind == Kind::embed) parts.push_back(stage(step.out.back(), ""));
  EstimateStage all{"head", 0, {}};
  for (const EstimateStage& part : parts) all.channels += part.channels;
  for (std::size_t pixel = 0; pixel < job_.window.pixel_count(); ++pixel)
    for (const EstimateStage& part : parts) {
      const auto first = part.values.begin() + static_cast<std::ptrdiff_t>(pixel * part.channels);
      all.values.insert(all.values.end(), first, first + static_cast<std::ptrdiff_t>(part.channels));
    }
  return all;
}

std::vector<EstimateStage> EstimateRun::trace() {
  const std::vector<float> pixels = run(0, job_.window.width, [](double /*part*/) {});
  const auto features = static_cast<std::size_t>(job_.plan.network->sample_features);
  std::vector<EstimateStage> stages = {{"inputs", RPF_INPUTS, sample_trace_.inputs},
                                       {"sample1", features, sample_trace_.sample1},
                                       {"sample2", features, sample_trace_.sample2}};
  const std::string last_of_color = "pass" + std::to_string(job_.plan.network->color_passes() - 1);
  for (std::size_t i = 0; i < steps_.grids.size(); ++i) {
    const int number = static_cast<int>(i);
    const std::string& name = steps_.grids[i].name;
    if (number == steps_.heads) stages.push_back(head_stage());
    if (name == "sums") stages.push_back({"weights", 1, sample_trace_.weights});
    if (name.empty() || name == "guides" || name == "albedo" || number == steps_.result) continue;
    stages.push_back(stage(number, name));
    if (name == last_of_color) stages.push_back(stage(steps_.albedo, "albedo"));
  }
  stages.push_back({"result", job_.plan.carried, pixels});
  return stages;
}

}  // namespace rpf
