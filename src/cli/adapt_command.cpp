#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <sstream>

#include "bench/child.h"
#include "cli/bench.h"
#include "cli/commands.h"
#include "cli/dropped.h"
#include "cli/environment.h"
#include "cli/filter_options.h"
#include "cli/needs.h"
#include "cli/numbers.h"
#include "cli/print.h"
#include "cli/sample_options.h"
#include "cli/signals.h"
#include "rpf/density.h"
#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

struct Options {
  std::string file;
  std::vector<std::string> command;
  int samples = 16;
  double error = 0;                 ///< 0: not given
  std::uint64_t max_memory_mb = 0;  ///< 0: not given
  bool quiet = false;
};

/// A file that is gone at the end, whatever happens.
struct Passing {
  std::string path;
  ~Passing() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

/// What stands in a command for the density to render with, the seed, and the file to write.
constexpr const char *density_word = "{density}", *seed_word = "{seed}", *output_word = "{output}";

std::string replaced(std::string word, const std::string& name, const std::string& value) {
  for (std::size_t at = word.find(name); at != std::string::npos; at = word.find(name, at + value.size()))
    word.replace(at, name.size(), value);
  return word;
}

void check_command(const std::vector<std::string>& command) {
  for (const char* name : {density_word, seed_word, output_word})
    if (std::none_of(command.begin(), command.end(),
                     [&](const std::string& word) { return word.find(name) != std::string::npos; }))
      throw Error(
          ErrorKind::usage,
          fmt::format("adapt: the command has no {}, as in rpf adapt all.exr -- rpf scene dof --spp 1 --density "
                      "{} --seed {} -o {}",
                      name, density_word, seed_word, output_word));
}

/// One that no part of the frame was rendered with, as far as it says: one above the largest.
std::uint32_t next_seed(const Metadata& metadata) {
  std::int64_t largest = 1;
  if (const auto one = metadata.find(seed_attribute); one != metadata.end())
    if (const auto* seed = std::get_if<std::int32_t>(&one->second)) largest = std::max<std::int64_t>(largest, *seed);
  if (const auto all = metadata.find(seeds_attribute); all != metadata.end())
    if (const auto* text = std::get_if<std::string>(&all->second)) {
      std::string numbers = *text;
      std::replace_if(
          numbers.begin(), numbers.end(), [](char c) { return c < '0' || c > '9'; }, ' ');
      std::istringstream in(numbers);
      for (std::int64_t seed = 0; in >> seed;) largest = std::max(largest, seed);
    }
  return static_cast<std::uint32_t>(std::min<std::int64_t>(largest + 1, std::numeric_limits<std::int32_t>::max()));
}

double mean_samples(const SampleBuffer& frame) {
  return static_cast<double>(frame.sample_count()) / static_cast<double>(frame.data_window.pixel_count());
}

/// A sample file, and how it grows round by round. What is written is whole, so a run that was stopped goes on from it.
class Growing {
 public:
  explicit Growing(const Options& options) : o_(options) {
    read_.max_memory = memory_limit(o_.max_memory_mb);
    const SampleFileInfo info = inspect_samples(o_.file, read_);
    const std::uint64_t pixels = info.data_window.pixel_count();
    const std::uint64_t samples = std::max(info.sample_count, pixels * static_cast<std::uint64_t>(o_.samples));
    check_need(info, "adapt", merging_bytes(pixels, samples, info.channels.size(), 2), read_.max_memory,
               " or lower --spp");
    check_outputs({{o_.file, OutputKind::samples, {}, {}, true}}, {o_.file});
    check_in_place(info, o_.file);
    files_ = {info};
    frame_ = read_samples(o_.file, read_);
    if (!o_.quiet) tell_not_finite(frame_);
  }

  /// The rounds so far, in a line. Returns the estimated error.
  double tell() const {
    const double error = mean_error(frame_);
    show_status("");
    if (!o_.quiet) {
      print("round {}: {:.2f} samples a pixel, estimated relMSE {:.4g}\n", round_, mean_samples(frame_), error);
      std::fflush(stdout);  // a round may take hours
    }
    return error;
  }

  /// As many samples again as there are, until the budget: each round knows twice as much as the one before.
  int further() const {
    const double mean = mean_samples(frame_);
    return static_cast<int>(std::min(std::max(mean, 1.0), o_.samples - mean));
  }

  void grow(int samples) {
    ++round_;
    show_status(fmt::format("round {}: {} more samples a pixel", round_, samples));
    const std::string stem = fmt::format("{}.{}.", o_.file, getpid());
    const Passing density{stem + "density.exr"}, rendered{stem + "round.exr"};
    write_image(density.path, sample_density(frame_, samples));
    render(density.path, rendered.path);
    files_.push_back(checked(rendered.path));
    std::vector<SamplePart> parts;
    parts.push_back({o_.file, std::move(frame_)});
    parts.push_back({"the command's file", read_samples(rendered.path, read_)});
    frame_ = merge_samples(std::move(parts));
    write_samples(o_.file, frame_, half_slots_of(files_));
  }

 private:
  [[noreturn]] void refuse(ErrorKind kind, const std::string& what) const {
    throw Error(kind, fmt::format("adapt: round {}: {}; \"{}\" has what was rendered before", round_, what, o_.file));
  }

  /// A signal ends the renderer too.
  void render(const std::string& density, const std::string& output) const {
    std::vector<std::string> command = o_.command;
    for (std::string& word : command) {
      word = replaced(word, density_word, density);
      word = replaced(word, seed_word, std::to_string(next_seed(frame_.metadata)));
      word = replaced(word, output_word, output);
    }
    try {
      if (received_signal() == 0) bench::output_of(command);
    } catch (const Error& e) {
      if (received_signal() == 0) refuse(e.kind() == ErrorKind::cancelled ? ErrorKind::internal : e.kind(), e.what());
    }
    if (received_signal() != 0) throw Error(ErrorKind::cancelled, "cancelled");
  }

  /// What the command wrote. A density is 1 or more everywhere, so that each round leads on.
  SampleFileInfo checked(const std::string& rendered) const {
    if (!std::filesystem::exists(rendered))
      refuse(ErrorKind::input, fmt::format("\"{}\" has written no file {}", o_.command.front(), output_word));
    SampleFileInfo info = inspect_samples(rendered, read_);
    if (info.sample_count < frame_.data_window.pixel_count())
      refuse(ErrorKind::input, fmt::format("\"{}\" has rendered {} samples, fewer than one a pixel; it is to render as "
                                           "many as {} says",
                                           o_.command.front(), info.sample_count, density_word));
    return info;
  }

  const Options& o_;
  SampleReadOptions read_;
  SampleBuffer frame_;
  std::vector<SampleFileInfo> files_;  ///< the one to begin with, and each round's
  int round_ = 0;
};

int run(const Options& o) {
  check_command(o.command);
  const SignalGuard guard;  // what is whole stays
  Growing frame(o);
  while (frame.tell() > o.error && frame.further() >= 1) frame.grow(frame.further());
  return received_signal() == 0 ? 0 : 128 + received_signal();
}

}  // namespace

Command add_adapt_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "adapt", "Render more samples where the noise is, round by round, with a command that takes a density");
  command->add_option("FILE", options->file, "Samples to begin with, or to go on with; it grows by every round")
      ->required();
  command
      ->add_option("COMMAND", options->command,
                   "Behind --: what renders a round; {density}, {seed} and {output} stand for what it is to use")
      ->required();
  restrict_to(command->add_option("--spp", options->samples, "Samples a pixel in all, on average"), ranges::samples)
      ->capture_default_str();
  restrict_to(command->add_option("--until", options->error, "Stop at this estimated relMSE of the plain mean"),
              ranges::error);
  command->add_flag("-q,--quiet", options->quiet, "Do not tell the rounds");
  add_memory_option(*command, options->max_memory_mb);
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
