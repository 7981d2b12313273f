#include "cli/sequence_files.h"

#include <fmt/format.h>

#include <map>

#include "cli/filter_input.h"
#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

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

void check_log(const std::string& log, const Owners& readers, const Owners& writers) {
  if (log.empty()) return;
  for (const Owners* owners : {&readers, &writers})
    if (const auto owner = owners->find(file_identity(log)); owner != owners->end())
      throw Error(ErrorKind::usage,
                  fmt::format("--log-json \"{}\" is a file of {}; name another file", log, owner->second));
}

}  // namespace

void check_sequence_files(const std::vector<FrameTask>& tasks, const std::vector<std::string>& inputs,
                          const std::string& log) {
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
      if (!is_new && writer->second != name)  // of one frame they are compared with all else that it writes
        throw Error(
            ErrorKind::usage,
            fmt::format("{} of frame {}: \"{}\" is written by {} too; name results so that no frame's is a file "
                        "of another",
                        file.option, task.name, path, writer->second));
    }
  }
  check_log(log, readers, writers);
}

}  // namespace rpf::cli
