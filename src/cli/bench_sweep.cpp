// rpf bench sweep: a plan's settings on a plan's frames. What the results file has is not measured again.
#include <fmt/format.h>

#include <set>

#include "bench/results_file.h"
#include "cli/bench.h"
#include "cli/signals.h"
#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Measures what one round still lacks.
class Sweep {
 public:
  Sweep(bench::SweepPlan plan, const std::string& output) : plan_(std::move(plan)), results_(output, "frame") {}

  /// What the rounds lack must be possible, before anything is rendered.
  void check_rounds(int rounds) const {
    std::set<std::string> checked;  // a later round has no other need
    for (int round = 0; round < rounds; ++round)
      for_missing(round, [&](const bench::SweepFrame& frame, const bench::SweepSetting& setting) {
        if (!checked.insert(key_of(frame, setting, 0)).second) return;
        naming(frame, setting,
               [&] { check_frame(frame, round_job(frame, setting, round), "size or spp in the plan"); });
      });
  }

  void run_round(int round) {
    for_missing(round, [&](const bench::SweepFrame& frame, const bench::SweepSetting& setting) {
      show_status(fmt::format("round {}: {}, {}", round + 1, frame.name, setting.name));
      naming(frame, setting,
             [&] { results_.add(key_of(frame, setting, round), measured_line(frame, setting, round)); });
      ++measured_;
    });
  }

  std::size_t measured() const { return measured_; }
  std::size_t known() const { return results_.lines().size() - measured_; }

 private:
  template <class Work>
  void for_missing(int round, const Work& work) const {
    for (const bench::SweepFrame& frame : plan_.frames)
      for (const bench::SweepSetting& setting : plan_.settings)
        if (applies(setting, frame) && !results_.has(key_of(frame, setting, round))) work(frame, setting);
  }

  /// Runs the work; its errors say on what.
  template <class Work>
  static void naming(const bench::SweepFrame& frame, const bench::SweepSetting& setting, const Work& work) {
    try {
      work();
    } catch (const Error& e) {
      throw Error(e.kind(), fmt::format("{}, {}: {}", frame.name, setting.name, e.what()));
    }
  }

  static bench::FrameJob round_job(const bench::SweepFrame& frame, const bench::SweepSetting& setting, int round) {
    bench::FrameJob job = job_of(frame, setting);
    if (round > 0) job.reference.clear();  // the image is the same in every round
    return job;
  }

  Json measured_line(const bench::SweepFrame& frame, const bench::SweepSetting& setting, int round) {
    make_scene_files(frame, stoppable());
    const bench::FrameJob job = round_job(frame, setting, round);
    if (warm_.insert(frame.samples + setting.options).second) bench::warm_up(job, stoppable());
    Json line{{"frame", frame.name}, {"setting", setting.name}, {"options", setting.options}, {"round", round}};
    line.update(bench::json_of(bench::run_frame(job, stoppable())));
    return line;
  }

  bench::SweepPlan plan_;
  bench::ResultsFile results_;
  std::set<std::string> warm_;
  std::size_t measured_ = 0;
};

}  // namespace

int run_sweep(const SweepOptions& options) {
  const SignalGuard guard;
  const bench::SweepPlan plan = bench::read_sweep_plan(options.plan, options.output + ".scenes");
  for (const bench::SweepSetting& setting : plan.settings)
    job_of({}, setting);  // a bad option shows before hours of work
  std::vector<std::string> inputs = {options.plan};
  for (const bench::SweepFrame& frame : plan.frames) inputs.insert(inputs.end(), {frame.samples, frame.reference});
  check_outputs({{options.output, OutputKind::page}}, inputs);
  Sweep sweep(plan, options.output);
  const int rounds = options.rounds > 0 ? options.rounds : plan.rounds;
  sweep.check_rounds(rounds);
  for (int round = 0; round < rounds; ++round) sweep.run_round(round);
  show_status("");
  fmt::print("{}: {} measured, {} were there\n", options.output, sweep.measured(), sweep.known());
  return 0;
}

}  // namespace rpf::cli
