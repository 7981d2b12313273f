// rpf bench ab: two settings or two binaries in turns, and a verdict only where the difference is beyond the spread.
#include <fmt/format.h>

#include "bench/child.h"
#include "cli/bench.h"
#include "cli/signals.h"
#include "rpf/error.h"

namespace rpf::cli {
namespace {

using Json = nlohmann::ordered_json;

/// A or B.
struct Side {
  std::string binary;  ///< empty: measured in this process
  bench::SweepSetting setting;
  std::vector<double> cpu = {}, wall = {};
};

/// What one round takes in another binary: it measures itself, so that its start does not count.
bench::Cost ask_binary(const Side& side, const bench::SweepFrame& frame) {
  const Json json = Json::parse(bench::output_of({side.binary, "bench", "frames", frame.samples, "--set",
                                                  "run=" + side.setting.options, "--rounds", "1", "--json"}));
  const Json& run = json.at("frames").at(0);
  return {run.at("cpu").at("median").get<double>(), run.at("wall").at("median").get<double>()};
}

void measure(Side& side, const bench::SweepFrame& frame) {
  const bench::Cost cost =
      side.binary.empty() ? bench::run_frame(job_of(frame, side.setting), stoppable()).cost : ask_binary(side, frame);
  side.cpu.push_back(cost.cpu);
  side.wall.push_back(cost.wall);
}

void measure_rounds(Side& a, Side& b, const bench::SweepFrame& frame, int rounds) {
  std::vector<bench::FrameJob> jobs;  // of both, before either runs: one may be refused
  for (const Side* side : {&a, &b})
    if (side->binary.empty()) jobs.push_back(job_of(frame, side->setting));
  // What another binary takes is its own to say; it is given files.
  for (const bench::FrameJob& job : jobs.empty() ? std::vector{job_of(frame, {})} : jobs)
    check_frame(frame, job, "--size");
  make_scene_files(frame, stoppable());
  for (const bench::FrameJob& job : jobs) bench::warm_up(job, stoppable());
  for (int round = 0; round < rounds; ++round) {
    show_status(fmt::format("{}: round {} of {}", frame.name, round + 1, rounds));
    const bool a_first = round % 2 == 0;  // whoever is first finds another machine than who is second
    measure(a_first ? a : b, frame);
    measure(a_first ? b : a, frame);
    if (received_signal() != 0) throw Error(ErrorKind::cancelled, "stopped by a signal");
  }
  show_status("");
}

void print_row(const char* what, const std::vector<double>& a, const std::vector<double>& b) {
  const bench::Ratio ratio = bench::compare_rounds(a, b);
  fmt::print("  {:<4} A {:.3f} s, B {:.3f} s, B / A {:.4f} ({:.4f} .. {:.4f} with {:.1f} %): {}\n", what,
             bench::median(a), bench::median(b), ratio.median, ratio.low, ratio.high, 100 * ratio.confidence,
             bench::text_of(ratio.verdict));
}

Json json_of_cost(const std::vector<double>& a, const std::vector<double>& b) {
  const bench::Ratio ratio = bench::compare_rounds(a, b);
  return {{"a", json_of(bench::summarize(a), a)},
          {"b", json_of(bench::summarize(b), b)},
          {"ratio", ratio.median},
          {"low", ratio.low},
          {"high", ratio.high},
          {"confidence", ratio.confidence},
          {"verdict", bench::text_of(ratio.verdict)}};
}

/// Where one side is another binary both run as children, alike.
std::string binary_of(const std::string& named, const AbOptions& options) {
  if (options.binary_a.empty() && options.binary_b.empty()) return "";
  return named.empty() ? "/proc/self/exe" : named;
}

}  // namespace

int run_ab(const AbOptions& options) {
  const SignalGuard guard;
  const TemporaryFolder folder;
  Json json;
  for (const bench::SweepFrame& frame : frames_of(options.frames, folder.path())) {
    Side a{binary_of(options.binary_a, options), {"A", options.a}},
        b{binary_of(options.binary_b, options), {"B", options.b}};
    measure_rounds(a, b, frame, options.rounds);
    if (options.json) {
      json["frames"].push_back(
          {{"frame", frame.name}, {"cpu", json_of_cost(a.cpu, b.cpu)}, {"wall", json_of_cost(a.wall, b.wall)}});
      continue;
    }
    fmt::print("{}, {} rounds\n", frame.name, options.rounds);
    print_row("CPU", a.cpu, b.cpu);
    print_row("wall", a.wall, b.wall);
  }
  if (options.json) fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  return 0;
}

}  // namespace rpf::cli
