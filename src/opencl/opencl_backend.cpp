#include "opencl/opencl_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "opencl/launch_work.h"
#include "opencl/trace_reader.h"
#include "plan/box.h"
#include "rpf_math.h"

namespace rpf {
namespace {

constexpr float unlimited = std::numeric_limits<float>::infinity();

/// Keeps what is laid out for a band small beside the frame, where the rows that a tile reads are not more. It costs
/// little: bands overlap by a box width.
constexpr std::uint64_t most_band_bytes = 256U << 20U;

/// Work-items for each compute unit of a device that hides latency by switching between them.
constexpr std::size_t items_per_gpu_unit = 64;

/// One work-item for each unit that works at once: on a CPU no more than threads are wanted.
std::size_t work_items(const cl::Device& device, int threads) {
  const std::size_t units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  if ((device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0)
    return std::min(units, static_cast<std::size_t>(std::max(threads, 1)));
  return units * items_per_gpu_unit;
}

/// The numbers of the plan that are compiled in (frame.cl).
std::string definitions(const Frame& frame, const Plan& plan, bool long_pixels) {
  const std::uint32_t most = plan.most_samples;
  const bool uniform = std::uint64_t{most} * (frame.first_sample.size() - 1) == frame.sample_count();
  return fmt::format(
      "-DRPF_VARIABLES={} -DRPF_RANDOM={} -DRPF_FEATURES={} -DRPF_REJECTING={} -DRPF_BINS={} -DRPF_CARRIED={} "
      "-DRPF_SAMPLES={} -DRPF_MISSING={}{}{}",
      plan.variables.count(), plan.variables.random_names.size(), plan.variables.feature_names.size(), plan.rejecting,
      2 * plan.half_bins + 1, plan.carried, uniform ? most : 0, frame.has_missing ? 1 : 0,
      plan.explain ? " -DRPF_EXPLAIN=1" : "", long_pixels ? " -DRPF_LONG=1" : "");
}

/// One value a feature, filled up to whole vectors with what rejects nothing.
std::vector<float> padded(std::vector<float> per_feature) {
  per_feature.resize((per_feature.size() + RPF_LANES - 1) / RPF_LANES * RPF_LANES, unlimited);
  return per_feature;
}

/// Candidates to draw for a pixel, by its number of samples.
std::vector<std::uint32_t> draws_by_samples(const PassPlan& pass, std::uint32_t most) {
  std::vector<std::uint32_t> draws(std::size_t{most} + 1);
  for (std::uint32_t samples = 0; samples <= most; ++samples) draws[samples] = pass.neighborhood.draws(samples);
  return draws;
}

/// The coordinates of fixed weights, as two columns.
std::vector<std::uint32_t> variables_of(const PassPlan& pass) {
  std::vector<std::uint32_t> variables;
  for (const Coordinate& c : pass.coordinates) variables.push_back(c.variable);
  return variables;
}

std::vector<float> scales_of(const PassPlan& pass) {
  std::vector<float> scales;
  for (const Coordinate& c : pass.coordinates) scales.push_back(c.scale);
  return scales;
}

int reach_of(const PassPlan& pass) { return box_reach(pass.box_width); }

/// The rows that a pass reads for a tile.
Rows rows_read(const Plan& plan, int pass, const Window& tile) {
  const int reach = reach_of(plan.passes[static_cast<std::size_t>(pass)]);
  return {std::max(tile.y - reach, 0), std::min(tile.y + tile.height + reach, plan.height)};
}

}  // namespace

OpenClBackend::OpenClBackend(const OpenClOptions& options)
    : session_(Session::of(find_device(options.device))),
      band_bytes_(options.band_bytes),
      weights_at_once_(options.weights_at_once),
      phases_(options.phases > 0 ? fmt::format(" -DRPF_PHASES={}", options.phases) : ""),
      items_(work_items(session_.device(), options.threads)),
      blocking_(options.blocking) {}

std::string OpenClBackend::description() const {
  return "opencl (" + session_.device().getInfo<CL_DEVICE_NAME>() + ")";
}

OpenClBackend::KernelProgram OpenClBackend::program_for(const Frame& frame, const Plan& plan) const {
  const bool fixed = plan.method != Method::rpf;
  return {fixed ? "box.cl" : "filter.cl",
          definitions(frame, plan, has_long_pixels(plan, weights_at_once_)) + (fixed ? "" : phases_)};
}

void OpenClBackend::get_ready(const Frame& frame, const Plan& plan, const std::function<void()>& check) {
  if (plan.passes.empty()) return;
  const KernelProgram needed = program_for(frame, plan);
  on_device("compiling", [&] { session_.rehearse(needed.file, needed.definitions, "", check); });
}

void OpenClBackend::load(const Frame& frame, std::vector<float> colors, const Plan& plan) {
  frame_ = &frame;
  plan_ = &plan;
  colors_ = std::move(colors);
  next_colors_ = colors_;
  statistics_.assign(frame.first_sample.size() - 1, {});
  band_.reset();
  tables_.clear();
  if (plan.passes.empty()) return;
  on_device("preparing the filter", [&] {
    const bool fixed = has_fixed_weights();
    const KernelProgram needed = program_for(frame, plan);
    const cl::Program& program = session_.program(needed.file, needed.definitions);
    kernel_ = cl::Kernel(program, fixed ? "filter_box" : "filter_tile");
    layout_kernel_ = cl::Kernel(program, fixed ? "lay_out_columns" : "lay_out_records");
    centers_ = session_.copy(plan.centers);
    rejection_factor_ = session_.copy(padded(plan.rejection_factor));
    minimum_tolerance_ = session_.copy(padded(plan.minimum_tolerance));
    scratch_ = std::make_unique<Scratch>(session_, plan, items_);
  });
}

const OpenClBackend::PassTables& OpenClBackend::tables(int pass) {
  while (tables_.size() <= static_cast<std::size_t>(pass)) {
    const PassPlan& p = plan_->passes[tables_.size()];
    PassTables t;
    if (has_fixed_weights()) {
      t.variables = session_.copy(variables_of(p));
      t.scales = session_.copy(scales_of(p));
    } else {
      t.offsets = session_.copy(p.offsets);
      t.draws = session_.copy(draws_by_samples(p, plan_->most_samples));
      t.entropy = session_.copy(p.entropy.units);
    }
    tables_.push_back(t);
  }
  return tables_[static_cast<std::size_t>(pass)];
}

BandLimit OpenClBackend::device_limit() const {
  const std::uint64_t memory = session_.device().getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  const std::uint64_t scratch = items_ * scratch_->sizes.bytes();
  const std::uint64_t left = memory > scratch ? memory - scratch : 0;
  return {band_bytes_ > 0 ? band_bytes_ : left, session_.device().getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>()};
}

BandLimit OpenClBackend::band_limit() const {
  const BandLimit limit = device_limit();
  return {std::min(limit.total, most_band_bytes), limit.buffer};
}

const Band& OpenClBackend::band_for(int pass, const Rows& needed) {
  if (!band_ || band_->pass != pass || !band_->rows.contains(needed)) {
    const Rows rows = rows_that_fit(*frame_, SampleFloats(*plan_), needed, band_limit());
    band_.reset();
    band_ = std::make_unique<Band>(
        make_band(session_, {*frame_, colors_, next_colors_, statistics_, SampleFloats(*plan_)}, pass, rows));
    lay_out(*band_);
  }
  return *band_;
}

void OpenClBackend::lay_out(const Band& band) {
  layout_kernel_.setArg(0, band.records);
  layout_kernel_.setArg(1, band.colors);
  layout_kernel_.setArg(2, band.chunks);
  layout_kernel_.setArg(3, band.samples);
  if (has_fixed_weights()) layout_kernel_.setArg(4, centers_);
  session_.launch(layout_kernel_, items_, 1);
}

kernel::rpf_pass OpenClBackend::arguments(int pass, const Window& tile, const Band& band) const {
  const PassPlan& p = plan_->passes[static_cast<std::size_t>(pass)];
  kernel::rpf_pass a{};
  a.width = plan_->width;
  a.height = plan_->height;
  a.tile_x = tile.x;
  a.tile_y = tile.y;
  a.tile_width = tile.width;
  a.tile_height = tile.height;
  a.first_pixel = band.first_pixel;
  a.first_sample = band.first_sample;
  a.samples = band.samples;
  a.seed = plan_->seed;
  a.pass = static_cast<std::uint32_t>(pass);
  a.attempts = plan_->attempts;
  a.capacity = scratch_->sizes.capacity;
  a.most_samples = scratch_->sizes.most_samples;
  a.entropy_slack = plan_->entropy_slack;
  a.nats_per_unit = p.nats_per_unit;
  a.information_bias = plan_->information_bias;
  a.alpha_factor = plan_->alpha_factor;
  a.growth = p.growth;
  a.noise = plan_->noise;
  a.outlier_step = plan_->outlier_step ? 1 : 0;
  a.reach = reach_of(p);
  a.coordinates = static_cast<std::uint32_t>(p.coordinates.size());
  a.end_own = a.end_block = std::numeric_limits<std::uint32_t>::max();  // all
  return a;
}

std::vector<cl::Buffer> OpenClBackend::buffers(int pass, const Band& band, const Results& results) {
  const PassTables& t = tables(pass);
  if (has_fixed_weights())
    return {band.first_samples,  band.chunks,        t.variables,         t.scales,
            scratch_->neighbors, scratch_->records,  scratch_->columns,   scratch_->sums,
            results.next_colors, results.statistics, results.trace_values};
  return {band.first_samples,
          band.chunks,
          t.offsets,
          t.draws,
          t.entropy,
          rejection_factor_,
          minimum_tolerance_,
          scratch_->candidates,
          scratch_->neighbors,
          scratch_->records,
          scratch_->planes,
          scratch_->columns,
          scratch_->sums,
          results.next_colors,
          results.statistics,
          results.explained,
          results.trace_values,
          results.trace_histograms};
}

void OpenClBackend::launch(const kernel::rpf_pass& arguments, const Band& band, std::size_t items,
                           const Results& results) {
  cl_uint number = 0;
  for (const cl::Buffer& buffer : buffers(static_cast<int>(arguments.pass), band, results))
    kernel_.setArg(number++, buffer);
  kernel_.setArg(number, arguments);
  session_.launch(kernel_, items, 1);
}

std::size_t OpenClBackend::explained_floats(const Window& tile) const {
  return tile.pixel_count() * (pair_count(plan_->variables) + 1);
}

cl::Buffer OpenClBackend::explanation_buffer(const Window& tile) {
  return plan_->explain ? session_.copy(std::vector<float>(explained_floats(tile), 0.0F)) : cl::Buffer();
}

void OpenClBackend::run(int pass, const Window& tile) {
  tile_ = tile;
  explained_.assign(plan_->explain ? explained_floats(tile) : 0, 0.0F);
  run_part(pass, tile);
}

void OpenClBackend::run_part(int pass, const Window& tile) {
  const Rows needed = rows_read(*plan_, pass, tile);
  // A row of pixels is filtered at once: it may need more than a band has elsewhere.
  const BandLimit limit = tile.height > 1 ? band_limit() : device_limit();
  if (!fits(*frame_, SampleFloats(*plan_), needed, limit)) {
    run_halves(pass, tile);
    return;
  }
  on_device("filtering", [&] {
    const Band& band = band_for(pass, needed);
    launch_pieces(pass, tile, band);
    collect(tile, band);
  });
}

void OpenClBackend::launch_pieces(int pass, const Window& tile, const Band& band) {
  // What is explained is added up in one slot.
  const std::size_t at_once = plan_->explain ? 1 : items_;
  if (tile.pixel_count() > at_once && (work_of(*frame_, *plan_, pass, tile) > weights_at_once_ * items_ ||
                                       most_work(*frame_, *plan_, pass, tile).weights() > weights_at_once_))
    for (const Window& half : halves_of(tile)) launch_pieces(pass, half, band);
  else
    launch_piece(pass, tile, band);
}

void OpenClBackend::launch_piece(int pass, const Window& piece, const Band& band) {
  const cl::Buffer explained = explanation_buffer(piece);
  const Results results{band.next_colors, band.statistics, explained, {}, {}};
  if (most_work(*frame_, *plan_, pass, piece).weights() > weights_at_once_)
    launch_long_pixels(pass, piece, band, results);
  else
    launch(arguments(pass, piece, band), band, items_, results);
  if (plan_->explain) keep_explained(piece, explained);
  if (check_) check_();
}

void OpenClBackend::launch_long_pixels(int pass, const Window& piece, const Band& band, const Results& results) {
  const PixelWork most = most_work(*frame_, *plan_, pass, piece);
  const auto own = static_cast<std::uint32_t>(most.own);
  const std::uint32_t blocks = kernel::rpf_blocks(static_cast<std::uint32_t>(most.neighbors));
  const auto part = [&](std::uint64_t weights_each, std::uint32_t left) {
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(weights_at_once_ / weights_each, 1, left));
  };
  kernel::rpf_pass a = arguments(pass, piece, band);
  const auto launch_next = [&] {
    launch(a, band, plan_->explain ? 1 : items_, results);
    if (check_) check_();
  };
  a.outlier_step = 0;
  a.end_block = 0;
  for (a.first_own = 0; a.first_own < own; a.first_own = a.end_own) {
    a.end_own = a.first_own + part(most.weights() / most.own, own - a.first_own);
    launch_next();
  }
  for (a.first_block = 0; plan_->explain && a.first_block < blocks; a.first_block = a.end_block) {
    a.end_block = a.first_block + part(most.weights() / blocks, blocks - a.first_block);
    launch_next();
  }
  if (!plan_->outlier_step) return;
  a.outlier_step = 1;
  launch_next();
}

void OpenClBackend::keep_explained(const Window& piece, const cl::Buffer& explained) {
  const std::vector<float> values = session_.read<float>(explained, 0, explained_floats(piece));
  const std::size_t floats = pair_count(plan_->variables) + 1, row = floats * static_cast<std::size_t>(piece.width);
  for (int y = 0; y < piece.height; ++y) {
    const std::size_t place = static_cast<std::size_t>(piece.y + y - tile_.y) * tile_.width + piece.x - tile_.x;
    std::copy_n(values.data() + row * static_cast<std::size_t>(y), row, explained_.data() + place * floats);
  }
}

void OpenClBackend::run_halves(int pass, const Window& tile) {
  if (tile.height == 1)
    throw Error(ErrorKind::device,
                fmt::format("the device cannot hold the rows that a pass of box width {} reads; use smaller --boxes, "
                            "leave channels out with --features, or use --backend=cpu",
                            plan_->passes[static_cast<std::size_t>(pass)].box_width));
  const int upper = tile.height / 2;
  run_part(pass, {tile.x, tile.y, tile.width, upper});
  run_part(pass, {tile.x, tile.y + upper, tile.width, tile.height - upper});
}

void OpenClBackend::collect(const Window& tile, const Band& band) {
  const std::size_t begin = static_cast<std::size_t>(tile.y) * plan_->width + tile.x;
  const std::size_t end = static_cast<std::size_t>(tile.y + tile.height - 1) * plan_->width + tile.x + tile.width;
  const std::size_t color = plan_->carried * sizeof(float);
  const std::size_t first = frame_->first_sample[begin], last = frame_->first_sample[end];
  session_.read_back(band.next_colors, (first - band.first_sample) * color, (last - first) * color,
                     next_colors_.data() + band.first_sample * plan_->carried);
  session_.read_back(band.statistics, (begin - band.first_pixel) * sizeof(PixelStatistics),
                     (end - begin) * sizeof(PixelStatistics), statistics_.data() + band.first_pixel);
}

void OpenClBackend::end_pass() {
  band_.reset();  // it refers to the colors that are exchanged here
  colors_.swap(next_colors_);
}

std::uint64_t OpenClBackend::scratch_bytes(const Plan& plan, std::uint64_t samples) const {
  int rows = 0;  // that a row of pixels reads
  for (const PassPlan& pass : plan.passes) rows = std::max(rows, pass.box_width);
  const std::uint64_t sample_bytes = SampleFloats(plan).chunks * sizeof(float);
  const std::uint64_t row_band = std::uint64_t(rows) * plan.width * plan.most_samples * sample_bytes;
  return items_ * ScratchSizes(plan).bytes() + std::min(samples * sample_bytes, std::max(row_band, most_band_bytes));
}

PixelTrace OpenClBackend::trace(int pass, std::uint32_t pixel) {
  const Window tile{static_cast<int>(pixel) % plan_->width, static_cast<int>(pixel) / plan_->width, 1, 1};
  if (frame_->samples(pixel) == 0) return empty_trace(pass, pixel);
  return on_device("tracing a pixel", [&] {
    const Band& band = band_for(pass, rows_read(*plan_, pass, tile));
    TraceReader reader(session_, *plan_, pass, pixel, frame_->samples(pixel));
    // The kernel finds a pixel's place in the band; these stand in for the band's, so that nothing changes.
    const cl::Buffer next_colors = session_.buffer(band.next_colors.getInfo<CL_MEM_SIZE>());
    const cl::Buffer statistics = session_.buffer(band.statistics.getInfo<CL_MEM_SIZE>());
    launch(arguments(pass, tile, band), band, 1,
           {next_colors, statistics, explanation_buffer(tile), reader.values(), reader.histograms()});
    const std::size_t own = (frame_->first_sample[pixel] - band.first_sample) * plan_->carried;
    const auto found = session_.read<PixelStatistics>(statistics, pixel - band.first_pixel, 1).front();
    return reader.read(*scratch_, found.neighbors, session_.read<float>(next_colors, own, reader.colors()));
  });
}

}  // namespace rpf
