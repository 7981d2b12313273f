// Reports as Markdown and JSON.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rpf/conformance.h"
#include "rpf/version.h"

namespace rpf {
namespace {

std::string cell(const StageResult& stage) {
  return stage.different == 0 ? "=" : fmt::format("{} ULP", stage.largest_ulp);
}

/// The stages of all cases, in order.
std::vector<std::string> stage_names(const ConformanceReport& report) {
  std::vector<std::string> names;
  for (const CaseResult& c : report.cases)
    for (const StageResult& s : c.stages)
      if (std::find(names.begin(), names.end(), s.stage) == names.end()) names.push_back(s.stage);
  return names;
}

std::string row(const CaseResult& c, const std::vector<std::string>& stages) {
  std::string text = "| " + c.name + " |";
  for (const std::string& name : stages) {
    const auto found =
        std::find_if(c.stages.begin(), c.stages.end(), [&](const StageResult& s) { return s.stage == name; });
    text += " " + (found == c.stages.end() ? "" : cell(*found)) + " |";
  }
  return text + "\n";
}

}  // namespace

std::string summary_of(const ConformanceReport& report) {
  std::uint64_t values = 0;
  for (const CaseResult& c : report.cases)
    for (const StageResult& s : c.stages) values += s.compared;
  return fmt::format("rpf {}, device {} ({}, driver {}): {} of {} cases within {} ULP, {} values compared, {:.0f} s",
                     version(), report.device.name, report.device.platform, report.device.driver,
                     report.cases.size() - report.failures(), report.cases.size(), report.tolerance, values,
                     report.seconds);
}

std::string markdown_of(const ConformanceReport& report) {
  const std::vector<std::string> stages = stage_names(report);
  std::string text = "# Conformance\n\n" + summary_of(report) + "\n\nTolerance: " + report.tolerance_reason +
                     ". \"=\": all bits are equal.\n\n| case |";
  for (const std::string& name : stages) text += " " + name + " |";
  text += "\n|---|";
  for (std::size_t i = 0; i < stages.size(); ++i) text += "---|";
  text += "\n";
  for (const CaseResult& c : report.cases) text += row(c, stages);
  for (const CaseResult& c : report.cases)
    if (!c.first_difference.empty()) text += fmt::format("\n{}: {}\n", c.name, c.first_difference);
  return text;
}

std::string json_of(const ConformanceReport& report) {
  nlohmann::json out = {
      {"version", version()},           {"device", report.device.name},    {"platform", report.device.platform},
      {"driver", report.device.driver}, {"tolerance", report.tolerance},   {"seconds", report.seconds},
      {"failures", report.failures()},  {"cases", nlohmann::json::array()}};
  for (const CaseResult& c : report.cases) {
    nlohmann::json entry = {{"name", c.name}, {"seconds", c.seconds}, {"first_difference", c.first_difference}};
    for (const StageResult& s : c.stages)
      entry["stages"][s.stage] = {{"compared", s.compared}, {"different", s.different}, {"largest_ulp", s.largest_ulp}};
    out["cases"].push_back(entry);
  }
  return out.dump(2) + "\n";
}

}  // namespace rpf
