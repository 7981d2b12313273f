#include "run/pass_bands.h"

#include <algorithm>

#include "run/memory.h"
#include "run/pass_steps.h"
#include "run/row_scan.h"

namespace rpf {
namespace {

constexpr std::uint64_t word = sizeof(float);

/// What passes can be at most over a frame of which its header is known.
struct LargestPasses {
  FrameFacts facts;
  Plan plan;
};

LargestPasses largest_passes(const SampleRows& rows, std::uint32_t most_samples, const Settings& settings) {
  const SampleBuffer& frame = rows.frame();
  const Window& window = frame.data_window;
  LargestPasses passes;
  FrameFacts& facts = passes.facts =
      largest_facts({window.pixel_count(), rows.sample_count(), most_samples, window.width}, frame.layout, settings);
  facts.height = window.height;
  facts.crop = settings.crop.value_or(window);
  facts.crop.x -= window.x;
  facts.crop.y -= window.y;
  passes.plan = make_plan(facts, settings);
  return passes;
}

/// Everything, where rows with so many samples are in memory of which those of `read` come at once.
std::uint64_t need(const LargestPasses& passes, const SampleRows& rows, std::uint64_t held, std::uint64_t read,
                   const Backend& backend) {
  const SampleBuffer& frame = rows.frame();
  const std::uint64_t records = passes.facts.variables.count(), carried = passes.facts.carried;
  const std::uint64_t weight = frame.layout.find("weight") ? 1 : 0;
  // Records; c' of every pass; c' and c'' of the backend.
  const std::uint64_t per_sample =
      records + weight + carried * (std::max<std::size_t>(passes.plan.passes.size(), 1) + 2);
  const std::uint64_t per_sample_read = frame.layout.size() + spare_columns + records + weight + carried;
  const std::uint64_t per_pixel = pixel_bytes(carried) + word;  // where samples of rows begin that are read
  return word * (held * per_sample + read * per_sample_read) + frame.data_window.pixel_count() * per_pixel +
         backend.scratch_bytes(passes.plan, held);
}

}  // namespace

PassBands pass_bands(const SampleRows& rows, std::uint32_t most_samples, const Settings& settings,
                     const Backend& backend) {
  const LargestPasses passes = largest_passes(rows, most_samples, settings);
  for (std::uint64_t at_once = 8 * bytes_at_once;; at_once /= 2) {
    PassBands bands{at_once, 0, 0, 0};
    std::uint64_t held = 0, read = 0;
    for (const PassStep& step :
         steps_of(passes.plan, passes.facts.crop, [&](int row) { return rows.end_within(row, at_once); })) {
      held = std::max(held, rows.sample_count(step.rows.first, step.rows.end));
      read = std::max(read, rows.sample_count(step.read_from, step.rows.end));
      bands.rows_held = std::max(bands.rows_held, step.rows.end - step.rows.first);
      bands.rows_read = std::max(bands.rows_read, step.rows.end - step.read_from);
    }
    bands.bytes = need(passes, rows, held, read, backend);
    if (bands.bytes <= settings.max_memory || bands.rows_read <= 1) return bands;
  }
}

}  // namespace rpf
