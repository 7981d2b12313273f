#include "bench/frame_run.h"

#include <sys/resource.h>

#include <chrono>

namespace rpf::bench {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Cost now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now().time_since_epoch();
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), wall.count()};
}

/// What the filter takes of the file, as the command reads it.
SampleBuffer read_frame(const FrameJob& job) {
  SampleLayout all;
  for (const SampleFileChannel& channel : inspect_samples(job.samples, job.read).channels)
    if (!channel.slot.empty()) all.slots.push_back(channel.slot);
  SampleReadOptions read = job.read;
  read.slots = needed_slots(all, job.settings);
  return read_samples(job.samples, read);
}

}  // namespace

CostClock::CostClock() : start_(now()) {}

Cost CostClock::elapsed() const {
  const Cost end = now();
  return {end.cpu - start_.cpu, end.wall - start_.wall};
}

void warm_up(const FrameJob& job, const Control& control) {
  Settings settings = job.settings;
  SampleBuffer samples = read_frame(job);
  const Window frame = settings.crop.value_or(samples.data_window);
  settings.crop = Window{frame.x + frame.width / 2, frame.y + frame.height / 2, 1, 1};
  filter(std::move(samples), settings, control);
}

FrameRun run_frame(const FrameJob& job, const Control& control) {
  const CostClock clock;
  SampleBuffer samples = read_frame(job);
  const CostClock filtering;
  Result result = filter(std::move(samples), job.settings, control);
  FrameRun run{clock.elapsed(), filtering.elapsed(), std::move(result.report), {}};
  if (!job.reference.empty())
    run.error = compare_images(result.image, read_image(job.reference, job.settings.max_memory));
  return run;
}

}  // namespace rpf::bench
