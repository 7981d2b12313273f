#include "cli/frame_log.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "cli/print.h"
#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

const char* const status_names[] = {"done", "skipped", "checked", "failed"};

const char* name_of(FrameStatus status) { return status_names[static_cast<int>(status)]; }

std::string line_of(const FrameOutcome& o) {
  switch (o.status) {
    case FrameStatus::done:
      return fmt::format("frame {}: {} done in {:.1f} s", o.name, o.output, o.seconds);
    case FrameStatus::skipped:
      return fmt::format("frame {}: {} skipped, made before", o.name, o.output);
    case FrameStatus::checked:
      return fmt::format("frame {}: {} can be made", o.name, o.output);
    case FrameStatus::failed:
      break;
  }
  return fmt::format("frame {}: {} failed, exit code {}", o.name, o.output, o.exit_code);
}

std::string json_of(const FrameOutcome& o) {
  nlohmann::ordered_json line = {{"frame", o.name},          {"input", o.input},
                                 {"output", o.output},       {"status", name_of(o.status)},
                                 {"exit_code", o.exit_code}, {"seconds", o.seconds}};
  if (!o.error.empty()) line["error"] = o.error;
  if (o.report != nullptr) {
    line["backend"] = o.report->backend;
    line["notes"] = nlohmann::ordered_json::array();
    for (const InputNote& note : o.report->notes)
      line["notes"].push_back({{"what", note.what}, {"count", note.count}, {"x", note.x}, {"y", note.y}});
  }
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

[[noreturn]] void refuse(const std::string& path) {
  throw Error(ErrorKind::output, fmt::format("--log-json \"{}\" cannot be written ({}); name another file", path,
                                             std::system_category().message(errno)));
}

}  // namespace

FrameLog::FrameLog(const std::string& path, bool quiet) : path_(path), quiet_(quiet) {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // for whoever watches a long run
  if (path.empty()) return;
  check_target(path);
  file_.reset(std::fopen(path.c_str(), "a"));
  if (!file_) refuse(path);
}

void FrameLog::add(const FrameOutcome& outcome) {
  ++counts_[static_cast<int>(outcome.status)];
  exit_code_ = std::max(exit_code_, outcome.exit_code);
  if (outcome.status == FrameStatus::failed) {
    failed_.push_back(printable(outcome.name));
    remark("rpf: error: frame {}: {}\n", failed_.back(), outcome.error);
  }
  if (!quiet_) print("{}\n", printable(line_of(outcome)));
  if (file_ && (std::fputs(json_of(outcome).c_str(), file_.get()) < 0 || std::fflush(file_.get()) != 0)) refuse(path_);
}

void FrameLog::finish(std::size_t left) {
  if (quiet_) return;
  std::vector<std::string> parts;
  for (std::size_t status = 0; status < std::size(status_names); ++status)
    if (counts_[status] > 0) parts.push_back(fmt::format("{} {}", counts_[status], status_names[status]));
  if (!failed_.empty()) parts.back() += fmt::format(" ({})", fmt::join(failed_, ","));
  if (left > 0) parts.push_back(fmt::format("{} not begun", left));
  cli::print("frames: {}\n", parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", ")));
}

}  // namespace rpf::cli
