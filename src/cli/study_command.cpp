#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <tuple>

#include "cli/bench.h"
#include "cli/commands.h"
#include "cli/filter_options.h"
#include "cli/numbers.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "cli/signals.h"
#include "report/html_page.h"
#include "rpf/error.h"
#include "rpf/outputs.h"
#include "study/harness.h"

namespace rpf::cli {
namespace {

struct Options {
  std::string name, folder, size;
  bool quick = false;
  std::string backend = "auto", device;
  int threads = 0;  ///< 0: as filtering chooses
};

study::Extent extent_of(const Options& o, const study::Experiment& experiment) {
  study::Extent extent = experiment.full;
  if (o.quick) extent = {std::min(192, extent.width), std::min(108, extent.height), 256, true};
  if (!o.size.empty()) std::tie(extent.width, extent.height) = size_of(o.size);
  return extent;
}

Settings run_settings(const Options& o, const std::string& options) {
  try {
    Settings settings = settings_of(parse_filter_options(CLI::detail::split_up(options)));
    settings.backend = o.backend;
    settings.device = o.device;
    if (o.threads > 0) settings.threads = o.threads;
    return settings;
  } catch (const CLI::ParseError& e) {
    throw Error(ErrorKind::internal, fmt::format("study: options \"{}\": {}; report this defect", options, e.what()));
  }
}

bool show(const std::string& name, const study::StudyProgress& p) {
  show_status(fmt::format("{}: run {} of {}, {:.0f} %, {} left: {}", name, p.run, p.runs, 100 * p.fraction,
                          clock_time(p.seconds_left), p.what));
  return received_signal() == 0;
}

study::StudyOptions study_options(const Options& o, const study::Experiment& experiment) {
  return {o.folder, extent_of(o, experiment), [&o](const std::string& text) { return run_settings(o, text); }};
}

void run_one(const Options& o, const study::Experiment& experiment) {
  const study::StudyDone done =
      study::run_experiment(experiment, study_options(o, experiment),
                            [&](const study::StudyProgress& p) { return show(experiment.name, p); });
  show_status("");
  print("{}: {} runs measured, {} were there\n", done.page, done.measured, done.known);
}

std::string index_of(const Options& o) { return (std::filesystem::path(o.folder) / "index.html").string(); }

void write_index(const Options& o) {
  report::HtmlPage page("rpf study all");
  for (const study::Experiment& experiment : study::experiments()) {
    page.link(fmt::format("{}.html", experiment.name), experiment.name);
    page.paragraph(experiment.question);
  }
  page.write(index_of(o));
  print("{}\n", index_of(o));
}

/// A line each, every line behind `before`.
std::string list(const std::string& before) {
  std::string text;
  for (const study::Experiment& experiment : study::experiments())
    text += fmt::format("{}{:<16} {}\n", before, experiment.name, experiment.question);
  return text + fmt::format("{}{:<16} {}", before, "all", "all of them, and a page that leads to theirs");
}

void run_named(const Options& o) {
  if (o.name != "all") return run_one(o, study::find_experiment(o.name));
  for (const study::Experiment& experiment : study::experiments())
    check_experiment(experiment, study_options(o, experiment));
  check_outputs({{index_of(o), OutputKind::page}}, {});
  for (const study::Experiment& experiment : study::experiments()) run_one(o, experiment);
  write_index(o);
}

int run(const Options& o) {
  if (o.name.empty()) {
    print("{}\n", list(""));
    return 0;
  }
  if (o.name != "all") study::find_experiment(o.name);
  if (o.folder.empty())
    throw Error(ErrorKind::usage, "study: no output; name the folder to write to with -o, as in -o study");
  const SignalGuard guard;
  try {
    run_named(o);
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::cancelled) throw;
    throw Error(
        ErrorKind::cancelled,
        fmt::format("stopped; what was measured is in \"{}\", and the same command goes on from there", o.folder));
  }
  return 0;
}

std::string description() {
  return "Run an experiment and write a page about it; goes on where it was stopped. Experiments:\n" + list("  ");
}

}  // namespace

Command add_study_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("study", description());
  command->add_option("NAME", options->name, "Which experiment; without it they are listed");
  command->add_option("-o,--output", options->folder, "Folder for pages, results and pictures")->type_name("DIR");
  command->add_flag("--quick", options->quick, "Smaller pictures and fewer points: under two minutes each");
  command
      ->add_option("--size", options->size,
                   "Pixels of the scenes; 320x180, contemporaries 160x90, others 192x108 if quick")
      ->type_name("WxH");
  add_backend_options(*command, options->backend, options->device);
  restrict_to(command->add_option("-t,--threads", options->threads, "Threads; all cores if not given"), ranges::threads,
              "RPF_NUM_THREADS");
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
