// rpf bench frames: every setting on every frame, in rounds, so that what disturbs the machine disturbs all alike.
#include <fmt/format.h>

#include "cli/bench.h"
#include "cli/signals.h"

namespace rpf::cli {
namespace {

using Json = nlohmann::ordered_json;

/// A setting on a frame, and what the rounds took.
struct Series {
  bench::SweepFrame frame;
  bench::SweepSetting setting;
  bench::FrameJob job;
  std::vector<double> cpu, wall, filter_cpu, filter_wall;
  bench::FrameRun first;  ///< with the errors: the image is the same in every round
};

std::vector<Series> series_of(const FramesOptions& options, const std::string& folder) {
  std::vector<std::string> sets = options.sets;
  if (sets.empty()) sets = {"default="};
  std::vector<Series> series;
  for (const bench::SweepFrame& frame : frames_of(options.frames, folder))
    for (const std::string& text : sets) {
      const bench::SweepSetting setting = setting_of(text);
      series.push_back({frame, setting, job_of(frame, setting), {}, {}, {}, {}, {}});
    }
  return series;
}

void measure(Series& series, int round) {
  show_status(fmt::format("round {}: {}, {}", round + 1, series.frame.name, series.setting.name));
  bench::FrameJob job = series.job;
  if (round > 0) job.reference.clear();
  bench::FrameRun run = bench::run_frame(job, stoppable());
  series.cpu.push_back(run.cost.cpu);
  series.wall.push_back(run.cost.wall);
  series.filter_cpu.push_back(run.filtering.cpu);
  series.filter_wall.push_back(run.filtering.wall);
  if (round == 0) series.first = std::move(run);
}

std::string cost_text(const std::vector<double>& rounds) {
  const bench::Summary s = bench::summarize(rounds);
  return fmt::format("{:8.2f} ({:.2f} .. {:.2f})", s.median, s.lowest, s.highest);
}

/// Accepted of all candidates drawn, over the passes.
double acceptance(const Report& report) {
  double accepted = 0, drawn = 0;
  for (const PassReport& pass : report.passes) {
    if (pass.acceptance <= 0) continue;
    accepted += pass.neighbors;
    drawn += pass.neighbors / pass.acceptance;
  }
  return drawn > 0 ? accepted / drawn : 0;
}

void print_table(const std::vector<Series>& all, int rounds) {
  fmt::print("{:<28} {:<28} {:>6} {:>8} {:>8} {:>7}  {:<28} {}\n", "CPU seconds", "wall seconds", "accept", "relMSE",
             "FLIP", "energy", "frame", "setting");
  for (const Series& s : all) {
    const auto error = [&](auto member) {
      return s.first.error ? fmt::format("{:.4f}", (*s.first.error).*member) : "-";
    };
    fmt::print("{:<28} {:<28} {:>6.3f} {:>8} {:>8} {:>7.4f}  {:<28} {}\n", cost_text(s.cpu), cost_text(s.wall),
               acceptance(s.first.report), error(&ImageError::relmse), error(&ImageError::flip),
               bench::kept_energy(s.first.report), s.frame.name, s.setting.name);
  }
  fmt::print(
      "reading and filtering, kernels loaded; median (lowest .. highest) of {} interleaved rounds; energy against the "
      "plain mean\n",
      rounds);
}

void print_json(const std::vector<Series>& all) {
  Json json;
  for (const Series& s : all) {
    Json entry{{"frame", s.frame.name}, {"setting", s.setting.name}, {"options", s.setting.options}};
    entry.update(bench::json_of(s.first));
    entry["cpu"] = json_of(bench::summarize(s.cpu), s.cpu);
    entry["wall"] = json_of(bench::summarize(s.wall), s.wall);
    entry["filter_cpu"] = json_of(bench::summarize(s.filter_cpu), s.filter_cpu);
    entry["filter_wall"] = json_of(bench::summarize(s.filter_wall), s.filter_wall);
    entry["acceptance"] = acceptance(s.first.report);
    json["frames"].push_back(entry);
  }
  fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

int run_frames(const FramesOptions& options) {
  const SignalGuard guard;
  const TemporaryFolder folder;
  std::vector<Series> all = series_of(options, folder.path());
  for (const Series& series : all) check_frame(series.frame, series.job, "--size");
  for (const Series& series : all) bench::make_scene_files(series.frame, stoppable());
  for (const Series& series : all) bench::warm_up(series.job, stoppable());
  for (int round = 0; round < options.rounds; ++round)
    for (Series& series : all) measure(series, round);
  show_status("");
  if (options.json)
    print_json(all);
  else
    print_table(all, options.rounds);
  return 0;
}

}  // namespace rpf::cli
