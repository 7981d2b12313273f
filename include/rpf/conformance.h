// Does a device compute what the reference computes? Both run the same frames side by side, stage by stage.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "rpf/devices.h"

namespace rpf {

/// How far the backends are apart in one stage (names and order: docs/conformance.md).
struct StageResult {
  std::string stage;
  std::uint64_t compared = 0;     ///< values
  std::uint64_t different = 0;    ///< values with other bits; both NaN counts as equal
  std::uint64_t largest_ulp = 0;  ///< units in the last place between the two, of floats; of integers the difference
};

/// A frame that ran on both, stage by stage.
struct CaseResult {
  std::string name;
  std::vector<StageResult> stages;  ///< in the order of the computation
  std::string first_difference;     ///< pass, pixel, stage and both values as hex floats; empty: all bits are equal
  double seconds = 0;
};

/// What came out.
struct ConformanceReport {
  DeviceInfo device;
  std::uint64_t tolerance = 0;  ///< largest_ulp allowed for this class of devices
  std::string tolerance_reason;
  std::vector<CaseResult> cases;
  double seconds = 0;

  /// Cases with a stage above the tolerance.
  std::size_t failures() const;
};

/// What to run.
struct ConformanceOptions {
  std::string device;  ///< as Settings::device
  bool full = false;   ///< all cases; else a choice of them that takes about a minute
  std::string filter;  ///< only cases whose name contains this
  int threads = 0;     ///< 0: available_threads()
  /// Called before every case with its number, their count and its name. Returning false cancels: Error(cancelled).
  std::function<bool(std::size_t, std::size_t, const std::string&)> progress;
};

/// The names of the cases that these options choose, in their order.
std::vector<std::string> conformance_cases(const ConformanceOptions& options);

/// Runs them. Throws Error(device) where the device cannot be used, Error(usage) where no case is left.
ConformanceReport check_conformance(const ConformanceOptions& options);

/// The report as text: a table case x stage and the first differences.
std::string summary_of(const ConformanceReport& report);  ///< one line
std::string markdown_of(const ConformanceReport& report);
std::string json_of(const ConformanceReport& report);

}  // namespace rpf
