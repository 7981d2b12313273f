#include "cli/sequence.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <future>
#include <optional>

#include "cli/filter_frame.h"
#include "cli/frame_log.h"
#include "cli/frame_numbers.h"
#include "cli/print.h"
#include "cli/sequence_files.h"
#include "cli/signals.h"
#include "rpf/error.h"

namespace rpf::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// A frame on its way: what is known of it before it is filtered.
struct Upcoming {
  bool is_made = false;  ///< and to be skipped
  std::optional<OpenFrame> frame;
  std::optional<ReadFrame> read;
  std::exception_ptr failure;
};

std::string frame_path(const char* option, const std::string& text, int frame) {
  const FramePattern pattern(text);
  if (!text.empty() && !pattern.has_place())
    throw Error(ErrorKind::usage, fmt::format("{} {}: all frames would be one file; a place for their number is "
                                              "expected, such as out.####.exr",
                                              option, text));
  return pattern.path_of(frame);
}

std::vector<int> numbers_of(const FramePattern& input, const FilterOptions& filter, const SequenceOptions& o) {
  std::vector<int> frames = o.frames.empty() ? input.existing() : frame_numbers(o.frames);
  if (frames.empty())
    throw Error(ErrorKind::input,
                fmt::format("\"{}\": no such file is there; name the frames with --frames", filter.input));
  return o.chunk.empty() ? frames : chunk_of(frames, o.chunk);
}

std::vector<FrameTask> tasks_of(const FilterOptions& filter, const SequenceOptions& o) {
  const FramePattern input(filter.input);
  if (!input.has_place() && (!o.frames.empty() || !o.chunk.empty()))
    throw Error(ErrorKind::usage,
                fmt::format("--frames and --chunk: \"{}\" has no place for the number of a frame; one "
                            "is expected, such as in.####.exr",
                            filter.input));
  if (!input.has_place()) return {{filter.input, filter}};
  std::vector<FrameTask> tasks;
  for (const int number : numbers_of(input, filter, o)) {
    FrameTask task{std::to_string(number), filter};
    task.options.input = input.path_of(number);
    for (const FrameFile& file : frame_files)
      task.options.*file.path = frame_path(file.option, filter.*file.path, number);
    tasks.push_back(task);
  }
  return tasks;
}

/// The tasks themselves, once it is known that their frames are there and that none spoils what another one has.
std::vector<FrameTask> checked(std::vector<FrameTask> tasks, const FilterOptions& filter, const SequenceOptions& o) {
  const FramePattern pattern(filter.input);
  std::vector<std::string> inputs;
  if (pattern.has_place())
    for (const int number : pattern.listed()) inputs.push_back(pattern.path_of(number));
  check_sequence_files(tasks, inputs, filter, o.log);
  if (pattern.has_place() && !o.skip_bad_frames) check_frames_are_there(tasks);
  return tasks;
}

bool was_made(const OpenFrame& frame) {
  const FilterOptions& options = frame.options;
  if (options.output.empty()) return false;
  const Origin origin = origin_of(frame);
  const auto is_it = [&](const Image& image) { return is_wanted(frame, image); };
  std::error_code unknown;
  return is_made(options.output, origin, is_it) && (options.aov.empty() || is_made(options.aov, origin, is_it)) &&
         (options.report.empty() || std::filesystem::is_regular_file(options.report, unknown));
}

int exit_code_of(const Error& error) {
  return error.kind() == ErrorKind::cancelled ? 128 + received_signal() : static_cast<int>(error.kind());
}

/// Whether the next frame may go better: not where it is the machine that failed, or somebody who stopped it.
bool may_go_on(int exit_code) {
  return exit_code == static_cast<int>(ErrorKind::usage) || exit_code == static_cast<int>(ErrorKind::input) ||
         exit_code == static_cast<int>(ErrorKind::memory);
}

class Sequence {
 public:
  Sequence(const FilterOptions& filter, const SequenceOptions& options)
      : options_(options),
        tasks_(checked(tasks_of(filter, options), filter, options)),
        log_(options.log, filter.quiet) {}

  int run() {
    std::size_t done = 0;
    std::future<Upcoming> next = std::async(std::launch::deferred, [this] { return load(0, 0); });
    for (bool goes_on = true; goes_on && done < tasks_.size(); ++done) {
      Upcoming upcoming = next.get();
      if (done + 1 < tasks_.size()) next = load_ahead(done + 1, upcoming);
      goes_on = finish(tasks_[done], std::move(upcoming)) && received_signal() == 0;
    }
    log_.finish(tasks_.size() - done);
    return received_signal() == 0 ? log_.exit_code() : 128 + received_signal();
  }

 private:
  /// `taken`: bytes that the frame before it needs meanwhile. Where both are too much, this one is read later.
  Upcoming load(std::size_t number, std::uint64_t taken) const {
    Upcoming upcoming;
    try {
      upcoming.frame = open_frame(tasks_[number].options);
      upcoming.is_made = options_.skip_existing && was_made(*upcoming.frame);
      const bool has_room = taken + read_bytes(*upcoming.frame) <= upcoming.frame->settings.max_memory;
      if (!upcoming.is_made && !upcoming.frame->options.dry_run && (taken == 0 || has_room))
        upcoming.read = read_frame(*upcoming.frame);
    } catch (...) {
      upcoming.failure = std::current_exception();
    }
    return upcoming;
  }

  std::future<Upcoming> load_ahead(std::size_t number, const Upcoming& meanwhile) const {
    const std::uint64_t taken = meanwhile.frame && !meanwhile.is_made ? meanwhile.frame->need : 0;
    return std::async(std::launch::async, [=] { return load(number, taken); });
  }

  /// False where the sequence ends here.
  bool finish(const FrameTask& task, Upcoming upcoming) {
    FrameOutcome outcome;
    outcome.name = task.name, outcome.input = task.options.input, outcome.output = task.options.output;
    std::optional<Result> result;
    try {
      if (upcoming.failure) std::rethrow_exception(upcoming.failure);
      result = work(upcoming, outcome);
      if (result) outcome.report = &result->report;
    } catch (const Error& error) {
      outcome.status = FrameStatus::failed;
      outcome.exit_code = exit_code_of(error);
      outcome.error = error.what();
    }
    const auto now = Clock::now();
    outcome.seconds = std::chrono::duration<double>(now - latest_).count();
    latest_ = now;
    log_.add(outcome);
    if (result && !task.options.quiet) print_notes(result->report);
    if (result && task.options.verbose) print_report(result->report, upcoming.frame->settings.method);
    return outcome.exit_code == 0 || (options_.skip_bad_frames && may_go_on(outcome.exit_code));
  }

  static std::optional<Result> work(Upcoming& upcoming, FrameOutcome& outcome) {
    const OpenFrame& frame = *upcoming.frame;
    if (upcoming.is_made) outcome.status = FrameStatus::skipped;
    if (!upcoming.is_made && frame.options.dry_run) outcome.status = FrameStatus::checked;
    if (upcoming.is_made || frame.options.dry_run) return std::nullopt;
    ReadFrame read = upcoming.read ? std::move(*upcoming.read) : read_frame(frame);
    return filter_and_write(frame, frame.settings, std::move(read));
  }

  const SequenceOptions options_;
  const std::vector<FrameTask> tasks_;
  FrameLog log_;
  Clock::time_point latest_ = Clock::now();
};

}  // namespace

void add_sequence_options(CLI::App& app, SequenceOptions& o) {
  const std::string group = "Sequences (docs/sequences.md)";
  app.add_option("--frames", o.frames,
                 "Frames of in.####.exr or in.%04d.exr, such as 1-100x2,105; all that are there if not given")
      ->type_name("LIST")
      ->group(group);
  app.add_option("--chunk", o.chunk, "Only the first, second, ... of so many parts of the frames, such as 2/10")
      ->type_name("PART/PARTS")
      ->group(group);
  app.add_flag("--skip-existing", o.skip_existing,
               "Leave out frames whose image is there, whole, and made from this input with these settings")
      ->group(group);
  app.add_flag("--skip-bad-frames", o.skip_bad_frames, "Go on behind a frame that cannot be filtered")->group(group);
  app.add_option("--log-json", o.log, "Append a line of JSON for every frame to this file")
      ->type_name("FILE")
      ->group(group);
}

bool is_sequence(const FilterOptions& filter, const SequenceOptions& o) {
  return !o.frames.empty() || !o.chunk.empty() || !o.log.empty() || o.skip_existing || o.skip_bad_frames ||
         FramePattern(filter.input).has_place();
}

int run_sequence(const FilterOptions& filter, const SequenceOptions& options) {
  if (!filter.time_budget.empty())
    throw Error(ErrorKind::usage,
                "--time-budget: frames of a sequence would get different presets; name one with --preset");
  return Sequence(filter, options).run();
}

}  // namespace rpf::cli
