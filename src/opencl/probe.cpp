#include "opencl/probe.h"

#include <fmt/format.h>

#include <mutex>
#include <set>

#include "opencl/binaries.h"
#include "opencl/cache_file.h"
#include "opencl/cache_lock.h"
#include "opencl/kernel_cache.h"
#include "opencl/kernel_source.h"
#include "opencl/machine_state.h"
#include "opencl/verdicts.h"
#include "rpf/error.h"

namespace rpf {
namespace {

using std::chrono::seconds;

/// Of work: PoCL answers in a tenth of a second, compiles the self-test in one, and a filter's kernels in some seconds.
constexpr seconds to_answer{20}, to_compile{180};

/// For another process that asks the same.
constexpr seconds to_wait{600};

constexpr const char* what_to_do =
    "use --backend=cpu; another driver is chosen with OCL_ICD_VENDORS, "
    "and `rpf devices` asks again";

[[noreturn]] void fail(const std::string& reason) {
  throw Error(ErrorKind::device, fmt::format("the OpenCL driver {}; {}", reason, what_to_do));
}

/// "<kind>\n<rest>", as answer_probe() makes them. A kind that is a number is an Error's.
struct Answer {
  std::string kind, rest;
};

Answer parsed(const std::string& text) {
  const std::size_t line = text.find('\n');
  return {text.substr(0, line), line == std::string::npos ? "" : text.substr(line + 1)};
}

/// Throws what the child caught.
Answer without_errors(const Answer& answer) {
  if (answer.kind.size() == 1 && answer.kind[0] >= '1' && answer.kind[0] <= '9')
    throw Error(static_cast<ErrorKind>(answer.kind[0] - '0'), answer.rest);
  return answer;
}

Answer ask(const std::vector<std::string>& question, seconds limit, const Check& check) {
  prepare_kernel_cache();
  const ChildAnswer answer = ask_child(question, "", limit, check);
  if (!answer.complete) fail(answer.text);
  return without_errors(parsed(answer.text));
}

/// The same, where how a driver fails is remembered: an abort or a hang, no mere error.
Answer ask_and_keep(const std::vector<std::string>& question, const std::string& input, const std::string& name,
                    seconds limit, const Check& check) {
  const Verdicts verdicts(verdict_folder());
  if (const auto verdict = verdicts.find(name)) {
    if (verdict->works) return {"ok", {}};
    fail(verdict->reason + " within the last hour");
  }
  const ChildAnswer answer = ask_child(question, input, limit, check);
  if (!answer.complete && !answer.stopped) verdicts.keep(name, {false, answer.text});
  if (!answer.complete) fail(answer.text);
  Answer result = without_errors(parsed(answer.text));
  if (result.kind == "ok") verdicts.keep(name, {true, {}});
  return result;
}

std::string name_of(const std::string& question) {
  static const std::string state = machine_state();
  return question + "\n" + state;
}

}  // namespace

void probe_drivers() { ask({"list"}, to_answer, {}); }

std::string probe_device(int index) {
  const Answer answer = ask({"test", std::to_string(index)}, to_answer, {});
  if (answer.kind != "ok") return parsed(answer.rest).rest;
  Verdicts(verdict_folder()).forget_failures();  // what failed may work again: the next run asks
  return "";
}

void require_working_device(const std::string& wanted) {
  static std::mutex mutex;
  static std::set<std::string> known;  // in this process
  const std::lock_guard<std::mutex> lock(mutex);
  if (known.count(wanted) != 0) return;
  prepare_kernel_cache();
  const std::string name = name_of(fmt::format("test {} {:016x}", wanted, checksum(kernel_source("self_test.cl"))));
  const CacheLock alone(name, to_wait, {});
  const Answer answer = ask_and_keep({"test", wanted}, "", name, to_answer, {});
  if (answer.kind != "ok") {
    const Answer failure = parsed(answer.rest);
    throw Error(
        ErrorKind::device,
        fmt::format("device '{}' does not keep the numeric contract: {}; use --backend=cpu or another device of "
                    "`rpf devices`",
                    failure.kind, failure.rest));
  }
  known.insert(wanted);
}

void require_compiled(const KernelBuild& build, const Check& check) {
  prepare_kernel_cache();
  const CacheLock alone(build.source, to_wait, check);
  if (build.is_kept_by_driver) check_kernels(build.source);
  const std::string name = name_of(fmt::format("build {:016x}", checksum(build.source)));
  const Verdicts verdicts(verdict_folder());
  const bool is_kept =
      build.is_kept_by_driver ? has_compiled_kernels(build.source) : Binaries(binary_folder()).has(build.source);
  if (const auto verdict = verdicts.find(name); !is_kept && verdict && verdict->works) verdicts.forget(name);
  ask_and_keep({"build", std::to_string(build.device), build.file, build.definitions}, build.more, name, to_compile,
               check);
}

}  // namespace rpf
