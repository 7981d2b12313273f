#include "rpf/conformance.h"

#include <algorithm>
#include <chrono>

#include "conformance/cases.h"
#include "conformance/lockstep.h"
#include "conformance/tolerances.h"
#include "opencl/session.h"
#include "parallel/thread_count.h"
#include "rpf/error.h"
#include "seam/backend.h"

namespace rpf {
namespace {

std::vector<ConformanceCase> chosen_cases(const ConformanceOptions& options) {
  std::vector<ConformanceCase> chosen;
  for (ConformanceCase& c : all_conformance_cases()) {
    if (!options.full && !c.quick) continue;
    if (c.name.find(options.filter) == std::string::npos) continue;
    chosen.push_back(std::move(c));
  }
  return chosen;
}

bool is_above(const CaseResult& result, std::uint64_t tolerance) {
  return std::any_of(result.stages.begin(), result.stages.end(),
                     [&](const StageResult& s) { return s.largest_ulp > tolerance; });
}

}  // namespace

std::size_t ConformanceReport::failures() const {
  return static_cast<std::size_t>(
      std::count_if(cases.begin(), cases.end(), [&](const CaseResult& c) { return is_above(c, tolerance); }));
}

std::vector<std::string> conformance_cases(const ConformanceOptions& options) {
  std::vector<std::string> names;
  for (const ConformanceCase& c : chosen_cases(options)) names.push_back(c.name);
  return names;
}

ConformanceReport check_conformance(const ConformanceOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<ConformanceCase> cases = chosen_cases(options);
  if (cases.empty()) throw Error(ErrorKind::usage, "no conformance case has '" + options.filter + "' in its name");
  ConformanceReport report;
  report.device = devices().at(static_cast<std::size_t>(find_device(options.device)));
  const ConformanceTolerance tolerance = tolerance_of(report.device);
  report.tolerance = tolerance.ulp;
  report.tolerance_reason = tolerance.reason;
  const int threads = thread_count(options.threads);
  for (const ConformanceCase& c : cases) {
    if (options.progress && !options.progress(report.cases.size(), cases.size(), c.name))
      throw Error(ErrorKind::cancelled, "cancelled");
    report.cases.push_back(run_in_lockstep(c, options.device, threads));
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace rpf
