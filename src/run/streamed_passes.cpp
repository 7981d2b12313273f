#include "run/streamed_passes.h"

#include <algorithm>
#include <utility>

#include "frame/resolve.h"
#include "parallel/thread_count.h"
#include "run/backends.h"
#include "run/tiles.h"

namespace rpf {
namespace {

std::vector<PassStep> steps_at(const SampleRows& rows, const Plan& plan, const Window& crop, std::uint64_t at_once) {
  return steps_of(plan, crop, [&](int row) { return rows.end_within(row, at_once); });
}

/// Samples that are in memory at once.
std::uint64_t most_samples(const std::vector<PassStep>& steps, const SampleRows& rows) {
  std::uint64_t most = 0;
  for (const PassStep& step : steps) most = std::max(most, rows.sample_count(step.rows.first, step.rows.end));
  return most;
}

}  // namespace

StreamedPasses::StreamedPasses(SampleRows& rows, const FrameFindings& found, const Settings& settings, const Plan& plan,
                               PreparedFrame& prepared, std::uint64_t at_once)
    : settings_(settings),
      plan_(plan),
      prepared_(prepared),
      steps_(steps_at(rows, plan, prepared.facts.crop, at_once)),
      window_(rows, found, settings, prepared, plan.passes.size(), most_samples(steps_, rows)),
      told_(plan.passes.size()),
      pixels_(rows.frame().data_window.pixel_count() * plan.carried) {}

void StreamedPasses::run(std::unique_ptr<Backend>& backend, const Control& control, ProgressMeter& meter) {
  for (const PassStep& step : steps_) {
    read(step);
    for (std::size_t pass = 0; pass < step.passes.size(); ++pass)
      if (step.passes[pass].first < step.passes[pass].end) filter(pass, step.passes[pass], backend, control, meter);
  }
}

void StreamedPasses::read(const PassStep& step) {
  window_.move_to(step);
  const RowRange rows{step.read_from, step.rows.end};
  add_energy(resolved(rows, window_.colors(0), plan_.passes.empty()), prepared_.facts, rows.first, rows.end,
             plain_energy_);
}

void StreamedPasses::filter(std::size_t pass, const RowRange& rows, std::unique_ptr<Backend>& backend,
                            const Control& control, ProgressMeter& meter) {
  const int number = static_cast<int>(pass);
  const bool is_last = pass + 1 == plan_.passes.size();
  const double start = meter.seconds();
  Window region = plan_.passes[pass].region;
  region.y = rows.first;
  region.height = rows.end - rows.first;
  load(window_.colors(pass), backend, meter);
  meter.add(number, 0);
  for (const Window& tile : cut_into_tiles(plan_, number, region, control, thread_count(settings_))) {
    backend->run(number, tile);
    meter.add(number, tile.pixel_count());
  }
  backend->end_pass();
  const std::vector<float> made = backend->take_colors();
  Told& told = told_[pass];
  told.summary.add(backend->statistics(), prepared_.frame, region);
  add_energy(resolved(rows, made, is_last), prepared_.facts, rows.first, rows.end, told.energy);
  window_.take(made, rows, pass + 1);
  told.seconds += meter.seconds() - start;
}

void StreamedPasses::load(std::vector<float> colors, std::unique_ptr<Backend>& backend, ProgressMeter& meter) {
  if (std::exchange(is_loaded_, true))
    backend->load(prepared_.frame, std::move(colors), plan_);
  else
    load_backend(backend, settings_, prepared_.frame, std::move(colors), plan_, meter);
}

Pixels StreamedPasses::resolved(const RowRange& rows, const std::vector<float>& colors, bool is_result) {
  Pixels pixels = resolve_rows(prepared_.frame, colors, plan_.carried, rows.first, rows.end);
  const std::size_t row = static_cast<std::size_t>(plan_.width) * plan_.carried;
  if (is_result)
    std::copy(pixels.begin(), pixels.end(), pixels_.begin() + static_cast<std::ptrdiff_t>(rows.first * row));
  return pixels;
}

std::vector<PassReport> StreamedPasses::reports() const {
  std::vector<PassReport> reports;
  for (std::size_t pass = 0; pass < told_.size(); ++pass) {
    reports.push_back(told_[pass].summary.report(plan_.passes[pass]));
    reports.back().energy = share_of_energy(told_[pass].energy, plain_energy_);
    reports.back().seconds = told_[pass].seconds;
  }
  return reports;
}

}  // namespace rpf
