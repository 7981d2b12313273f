
#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <csignal>
#include <new>

#include "cli/commands.h"
#include "cli/manual_command.h"
#include "cli/print.h"
#include "cli/signals.h"
#include "rpf/error.h"
#include "rpf/version.h"

namespace rpf::cli {
namespace {

constexpr const char* footer = R"(Examples:
  rpf render.samples.exr -o filtered.exr
  rpf --preset high render.samples.exr -o filtered.png
  rpf --time-budget 10s render.samples.exr -o filtered.exr
  rpf --preset balanced render.samples.exr -o filtered.exr
  rpf 'render.####.exr' -o 'filtered.####.exr' --frames 1-100 --skip-existing
  rpf --method bilateral picture.png -o filtered.png
  rpf info render.samples.exr
  rpf compare before.exr filtered.exr reference.exr --side-by-side picture.png
  rpf report render.samples.exr filtered.exr -o page.html
  rpf merge seed-1.samples.exr seed-2.samples.exr -o both.samples.exr
  rpf facts render.samples.exr -o facts.json
  rpf render.samples.exr -o part.2.exr --rows 2/4 --facts facts.json
  rpf join part.1.exr part.2.exr part.3.exr part.4.exr -o filtered.exr
  rpf explain render.samples.exr -o explained --pixel 120,80
  rpf density render.samples.exr --spp 4 -o density.exr
  rpf adapt all.exr --spp 32 -- rpf scene dof --spp 1 --density {density} --seed {seed} -o {output}
  rpf convert theirs.exr -o ours.samples.exr
  rpf scene dof -o dof.samples.exr
  rpf bench frames render.samples.exr --set all='--backend opencl' --set small='--backend opencl --boxes 21,11,5'
  rpf study features -o study --quick

Exit codes: 0 ok, 1 internal, 2 usage, 3 input, 4 output, 5 device, 6 memory, 128 + signal when stopped;
rpf compare --max-error: 1 when an image is above it.)";

/// What stands before a command is read as the filter's, which does not run.
void check_comes_first(const std::string& command, const std::string& first) {
  if (first != command)
    throw Error(ErrorKind::usage, fmt::format("{0}: the command comes first, but {1} stands before it; write rpf {0} "
                                              "and then its options, which rpf {0} --help lists",
                                              command, first));
}

/// An empty value is mostly a variable of a script that is not set; as if the option were missing, something else would
/// be done than was asked for.
void check_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& value : option->results())
      if (value.empty() && option->nonpositional())
        throw Error(ErrorKind::usage,
                    fmt::format("{}: its value is empty; give one, or leave the option out", option->get_name()));
  for (const CLI::App* command : app.get_subcommands()) check_values(*command);
}

int run(int argc, char** argv) {
  CLI::App app(
      "Random Parameter Filtering: removes the noise of lens, motion, soft shadow and gloss from Monte Carlo samples.",
      "rpf");
  app.set_version_flag("--version", std::string("rpf ") + version());
  app.footer(footer);
  app.require_subcommand(0, 1);
  const Command filter_command = add_filter_command(app, {argv + 1, argv + argc});
  const std::pair<const char*, Command> subcommands[] = {
      {"info", add_info_command(app)},         {"compare", add_compare_command(app)},
      {"merge", add_merge_command(app)},       {"convert", add_convert_command(app)},
      {"scene", add_scene_command(app)},       {"devices", add_devices_command(app)},
      {"report", add_report_command(app)},     {"explain", add_explain_command(app)},
      {"selftest", add_selftest_command(app)}, {"bench", add_bench_command(app)},
      {"study", add_study_command(app)},       {"manual", add_manual_command(app)},
      {"density", add_density_command(app)},   {"adapt", add_adapt_command(app)},
      {"join", add_join_command(app)},         {"facts", add_facts_command(app, {argv + 1, argv + argc})},
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    throw;
  }
  check_values(app);
  for (const auto& [name, command] : subcommands)
    if (app.got_subcommand(name)) {
      check_comes_first(name, argv[1]);
      return command();
    }
  return filter_command();
}

int report(const char* message, ErrorKind kind) {
  // The compiler inside PoCL reacts to signals by removing its files, and then fails.
  if (kind == ErrorKind::device && received_signal() != 0) return report("cancelled", ErrorKind::cancelled);
  remark("rpf: error: {}\n", message);
  return kind == ErrorKind::cancelled ? 128 + received_signal() : static_cast<int>(kind);
}

/// Frames come one after another: what one gives back the next takes, and the system is not asked for it page by page.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

}  // namespace
}  // namespace rpf::cli

int main(int argc, char** argv) {
  using namespace rpf;
  cli::keep_freed_memory();
  // As errors of a write they are reported and cleaned up after; as signals they would leave a temporary file behind.
  for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);
  cli::open_standard_streams();
  try {
    const int code = cli::run(argc, argv);
    cli::finish_printing();
    return code;
  } catch (const Error& e) {
    return cli::report(e.what(), e.kind());
  } catch (const CLI::ParseError& e) {
    return cli::report((std::string(e.what()) + "; rpf --help lists the options").c_str(), ErrorKind::usage);
  } catch (const std::bad_alloc&) {
    return cli::report("out of memory; lower --max-memory or --threads, or leave channels out", ErrorKind::memory);
  } catch (const std::exception& e) {
    return cli::report(e.what(), ErrorKind::internal);
  }
}
