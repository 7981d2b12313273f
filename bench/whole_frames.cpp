// Whole frames, reading the file included. Names: dof.4spp.<size>.<backend>.<profile>; time: wall, CPU: of all threads.
#include <unistd.h>

#include <filesystem>
#include <map>

#include "bench/frame_run.h"
#include "bench_frame.h"

namespace rpf::measure {
namespace {

/// A sample file that is removed at the end of the program.
class TemporaryFile {
 public:
  explicit TemporaryFile(const SampleBuffer& samples)
      : path_((std::filesystem::temp_directory_path() / ("rpf-bench-" + std::to_string(getpid()) + "-" +
                                                         std::to_string(samples.data_window.width) + ".samples.exr"))
                  .string()) {
    write_samples(path_, samples);
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

const std::string& file_of(int width, int height) {
  static std::map<int, TemporaryFile> files;
  return files.try_emplace(width, frame_of(width, height)).first->second.path();
}

/// Accepted of all candidates drawn, and neighbors over the passes.
void count_neighbors(benchmark::State& state, const Report& report, double pixels, double seconds) {
  double accepted = 0, drawn = 0;
  for (const PassReport& pass : report.passes) {
    accepted += pass.neighbors;
    drawn += pass.acceptance > 0 ? pass.neighbors / pass.acceptance : 0;
  }
  state.counters["acceptance"] = accepted / drawn;
  state.counters["ns/neighbor"] = 1e9 * seconds / (accepted * pixels);
  state.counters["us/pixel"] = 1e6 * seconds / pixels;
}

void measure(benchmark::State& state, int width, int height, const Settings& settings) {
  const bench::FrameJob job{file_of(width, height), "", settings, {}};
  bench::warm_up(job, {});
  bench::FrameRun run;
  double seconds = 0;
  for (auto iteration : state) {
    run = bench::run_frame(job, {});
    seconds += run.cost.cpu;
  }
  count_neighbors(state, run.report, static_cast<double>(width) * height,
                  seconds / static_cast<double>(state.iterations()));
}

void register_frame(int width, int height, const std::string& backend, Profile profile) {
  Settings settings = settings_for(profile, {55, 35, 17, 7});
  settings.backend = backend;
  settings.threads = available_threads();
  const std::string label = "dof.4spp." + std::to_string(width) + "x" + std::to_string(height) + "." + backend + "." +
                            (profile == Profile::paper ? "paper" : "thesis");
  benchmark::RegisterBenchmark(label.c_str(), measure, width, height, settings)
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_frames() {
  for (const Profile profile : {Profile::thesis, Profile::paper}) {
    register_frame(240, 135, "opencl", profile);
    register_frame(96, 54, "opencl", profile);
    register_frame(96, 54, "cpu", profile);
  }
}

}  // namespace rpf::measure
