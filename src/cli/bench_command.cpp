#include "cli/bench.h"
#include "cli/commands.h"
#include "cli/numbers.h"

namespace rpf::cli {
namespace {

void add_frames(CLI::App& command, BenchFrames& frames) {
  command.add_option("FILES", frames.files, "Sample files; the scene where none is named")->type_name("FILE");
  command.add_option("--reference", frames.references, "Reference image of each file, in their order")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command.add_option("--scene", frames.scene, "Scene of `rpf scene --list`")->capture_default_str();
  command.add_option("--size", frames.size, "Pixels of the scene")->type_name("WxH")->capture_default_str();
}

void add_rounds(CLI::App& command, int& rounds, bool& json) {
  restrict_to(command.add_option("--rounds", rounds, "How often each is measured, in turns"), ranges::rounds)
      ->capture_default_str();
  command.add_flag("--json", json, "For programs");
}

CLI::App* add_frames_command(CLI::App& bench, FramesOptions& o) {
  CLI::App* command = bench.add_subcommand("frames", "CPU and wall seconds, and errors, of settings on frames");
  add_frames(*command, o.frames);
  command->add_option("--set", o.sets, "A setting: options of the filter, such as small='--boxes 21,11,5'")
      ->type_name("NAME=OPTIONS")
      ->allow_extra_args(false);
  add_rounds(*command, o.rounds, o.json);
  return command;
}

CLI::App* add_ab_command(CLI::App& bench, AbOptions& o) {
  CLI::App* command = bench.add_subcommand("ab", "Two settings or two binaries in turns, with a verdict");
  add_frames(*command, o.frames);
  command->add_option("-a,--a", o.a, "Options of the filter in A")->type_name("OPTIONS");
  command->add_option("-b,--b", o.b, "Options of the filter in B")->type_name("OPTIONS");
  command->add_option("--binary-a", o.binary_a, "Another rpf to run A with; this one if not given")->type_name("FILE");
  command->add_option("--binary-b", o.binary_b, "Another rpf to run B with")->type_name("FILE");
  add_rounds(*command, o.rounds, o.json);
  return command;
}

CLI::App* add_sweep_command(CLI::App& bench, SweepOptions& o) {
  CLI::App* command =
      bench.add_subcommand("sweep", "All settings of a plan on all its frames; goes on where it was stopped");
  command->add_option("PLAN", o.plan, "Frames and settings as JSON (docs/bench.md)")->required()->type_name("FILE");
  command->add_option("-o,--output", o.output, "Results, one line of JSON each")->required()->type_name("FILE");
  restrict_to(command->add_option("--rounds", o.rounds, "In place of the plan's number"), ranges::rounds);
  return command;
}

}  // namespace

Command add_bench_command(CLI::App& app) {
  CLI::App* bench = app.add_subcommand("bench", "Measure the filter's speed, and its errors beside it");
  bench->require_subcommand(1);
  auto frames = std::make_shared<FramesOptions>();
  auto ab = std::make_shared<AbOptions>();
  auto sweep = std::make_shared<SweepOptions>();
  const CLI::App* frames_command = add_frames_command(*bench, *frames);
  const CLI::App* ab_command = add_ab_command(*bench, *ab);
  add_sweep_command(*bench, *sweep);
  return [=] {
    if (bench->got_subcommand(frames_command)) return run_frames(*frames);
    return bench->got_subcommand(ab_command) ? run_ab(*ab) : run_sweep(*sweep);
  };
}

}  // namespace rpf::cli
