#include "cli/choices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/environment.h"

namespace rpf::cli {

CLI::Validator one_of(const std::vector<std::string>& names, const std::string& variable) {
  const auto refusal = [=](const std::string& text) -> std::string {
    if (std::find(names.begin(), names.end(), text) != names.end()) return "";
    return fmt::format("{}: expected {}", quoted_with_source(text, variable), fmt::join(names, ", "));
  };
  return {refusal, fmt::format("{{{}}}", fmt::join(names, ","))};
}

}  // namespace rpf::cli
