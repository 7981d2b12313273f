#include <unistd.h>

#include <cstdio>

#include "cli/commands.h"
#include "cli/print.h"
#include "cli/signals.h"
#include "rpf/conformance.h"

namespace rpf::cli {
namespace {

constexpr int exit_on_difference = 1;

struct Options {
  ConformanceOptions conformance;
  bool list = false, markdown = false, json = false;
};

void print_summary(const ConformanceReport& report) {
  for (const CaseResult& c : report.cases)
    if (!c.first_difference.empty()) print("{}: {}\n", c.name, c.first_difference);
  print("{}\n", summary_of(report));
}

int run(const Options& options) {
  if (options.list) {
    for (const std::string& name : conformance_cases(options.conformance)) print("{}\n", name);
    return 0;
  }
  const SignalGuard guard;
  ConformanceOptions conformance = options.conformance;
  conformance.progress = [](std::size_t number, std::size_t count, const std::string& name) {
    if (isatty(STDERR_FILENO) == 1) remark("\r\033[K{} of {}: {}", number + 1, count, name);
    return received_signal() == 0;
  };
  const ConformanceReport report = check_conformance(conformance);
  if (isatty(STDERR_FILENO) == 1) remark("\r\033[K");
  if (options.markdown)
    print("{}", markdown_of(report));
  else if (options.json)
    print("{}", json_of(report));
  else
    print_summary(report);
  return report.failures() == 0 ? 0 : exit_on_difference;
}

}  // namespace

Command add_selftest_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("selftest", "Compare an OpenCL device with the reference, bit by bit, stage by stage");
  command->add_option("-d,--device", options->conformance.device, "Index of `rpf devices` or a part of the name")
      ->envname("RPF_DEVICE");
  command->add_flag("--full", options->conformance.full, "All cases, some minutes; else a choice, under a minute");
  command->add_option("--filter", options->conformance.filter, "Only cases whose name contains this, such as box/35");
  CLI::Option* markdown = command->add_flag("--markdown", options->markdown, "Print the whole report, case by case");
  command->add_flag("--json", options->json, "The same as JSON")->excludes(markdown);
  command->add_flag("--list", options->list, "Only name the cases");
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
