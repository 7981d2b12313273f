#include <fmt/format.h>

#include <filesystem>

#include "cli/commands.h"
#include "cli/environment.h"
#include "cli/filter_options.h"
#include "cli/frame_page.h"
#include "cli/print.h"
#include "cli/signals.h"
#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

struct Options {
  FilterOptions machine;  ///< those that this command shares with filtering, and the page as its output
  std::vector<std::string> files;
};

int run(const Options& o) {
  if (o.files.size() < 2 || o.files.size() > 3 || o.machine.output.empty())
    throw Error(
        ErrorKind::usage,
        "report: samples, the image made of them, a reference where there is one, and a page are expected, as in "
        "rpf report render.samples.exr filtered.exr reference.exr -o page.html");
  FramePageJob job{o.files[0], o.files[1], o.files.size() > 2 ? o.files[2] : "", o.machine.output, {}, {}, ""};
  job.machine = settings_of(o.machine);
  job.read = read_options_of(o.machine, job.machine);
  job.progress = o.machine.quiet ? "never" : o.machine.progress;
  check_outputs({{job.page, OutputKind::page}}, o.files);
  write_frame_page(job);
  if (!o.machine.quiet)
    print("{}: {:.1f} MB\n", job.page, static_cast<double>(std::filesystem::file_size(job.page)) / megabyte);
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

}  // namespace

Command add_report_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("report", "One page about a frame, before and after, that needs no other file");
  command
      ->add_option("FILES", options->files,
                   "Samples, the image made of them and, where there is one, a reference image")
      ->type_name("IN OUT [REF]");
  command->add_option("-o,--output", options->machine.output, "The page")->type_name("FILE.html");
  add_map_option(*command, options->machine.map);
  add_running_options(*command, options->machine);
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
