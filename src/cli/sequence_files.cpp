#include "cli/sequence_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include "cli/filter_input.h"
#include "cli/frame_numbers.h"
#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

namespace fs = std::filesystem;

/// Who has a file, by file_identity().
using Owners = std::map<std::string, std::string>;

Owners readers_of(const std::vector<FrameTask>& tasks, const std::vector<std::string>& inputs) {
  Owners readers;
  for (const FrameTask& task : tasks)
    for (const std::string& file : files_read(task.options))
      if (!file.empty()) readers.emplace(file_identity(file), "frame " + task.name);
  for (const std::string& input : inputs) readers.emplace(file_identity(input), "another frame of the sequence");
  return readers;
}

/// No file of any frame, whether it is filtered now or not, and no image.
void check_log(const std::string& log, const FilterOptions& sequence, const Owners& readers, const Owners& writers) {
  if (log.empty()) return;
  for (const Owners* owners : {&readers, &writers})
    if (const auto owner = owners->find(file_identity(log)); owner != owners->end())
      throw Error(ErrorKind::usage,
                  fmt::format("--log-json \"{}\" is a file of {}; name another file", log, owner->second));
  for (const FrameFile& file : frame_files)
    if (FramePattern(sequence.*file.path).names(log))
      throw Error(ErrorKind::usage,
                  fmt::format("--log-json \"{}\" is a file of another frame, by {} {}; name another file", log,
                              file.option, sequence.*file.path));
  check_text_name(log);
}

}  // namespace

void check_sequence_files(const std::vector<FrameTask>& tasks, const std::vector<std::string>& inputs,
                          const FilterOptions& sequence, const std::string& log) {
  const Owners readers = readers_of(tasks, inputs);
  Owners writers;
  for (const FrameTask& task : tasks) {
    const std::string name = "frame " + task.name;
    for (const FrameFile& file : frame_files) {
      const std::string& path = task.options.*file.path;
      if (path.empty() || !file.is_result) continue;
      const std::string identity = file_identity(path);
      const auto reader = readers.find(identity);
      if (reader != readers.end() && reader->second != name)
        throw Error(ErrorKind::usage,
                    fmt::format("{} of frame {}: \"{}\" is what {} reads, and would be lost; name results so that no "
                                "frame's is a file of another",
                                file.option, task.name, path, reader->second));
      const auto [writer, is_new] = writers.emplace(identity, name);
      if (!is_new)
        throw Error(
            ErrorKind::usage,
            fmt::format("{} of frame {}: \"{}\" is written by {} too; name results so that no frame's is a file "
                        "of another",
                        file.option, task.name, path, writer->second));
    }
  }
  check_log(log, sequence, readers, writers);
}

void check_frames_are_there(const std::vector<FrameTask>& tasks) {
  constexpr std::size_t listed = 10;
  std::vector<std::string> missing;
  std::string first;
  for (const FrameTask& task : tasks) {
    std::error_code unknown;  // opening it says what else is wrong
    if (fs::status(task.options.input, unknown).type() != fs::file_type::not_found) continue;
    if (missing.empty()) first = task.options.input;
    missing.push_back(task.name);
  }
  if (missing.empty()) return;
  const std::size_t count = missing.size();
  missing.resize(std::min(count, listed));
  throw Error(
      ErrorKind::input,
      fmt::format("\"{}\" is not there: {} of {} frames are missing ({}{}); render them, name others with --frames, "
                  "or leave them out with --skip-bad-frames",
                  first, count, tasks.size(), fmt::join(missing, ","), count > listed ? ", ..." : ""));
}

}  // namespace rpf::cli
