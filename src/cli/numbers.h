// Options that are numbers: what they can be is said in one line, whether the command line or the environment has them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "rpf/ranges.h"

namespace rpf::cli {

/// Why `text` is no such number, naming `variable` of the environment where it comes from there; empty where it is one.
std::string refusal_of(const std::string& text, const NumberRange& range, const std::string& variable = {});

/// A whole number without the leading zeros that CLI11 would take for octal: "10" of "0010".
std::string decimal(const std::string& text);

/// Lets the option take such numbers only, also from `variable`.
inline CLI::Option* restrict_to(CLI::Option* option, const NumberRange& range, const std::string& variable = {}) {
  if (!variable.empty()) option->envname(variable);
  return option->transform(CLI::Validator(
      [=](std::string& text) {
        std::string refusal = refusal_of(text, range, variable);
        if (refusal.empty() && range.whole) text = decimal(text);
        return refusal;
      },
      ""));
}

namespace ranges {
using namespace rpf::ranges;
constexpr NumberRange seed{0, 4294967295.0, "1", true};
constexpr NumberRange megabytes{1, 1 << 30, "8000", true};
constexpr NumberRange rounds{1, 1 << 20, "9", true};
constexpr NumberRange samples{1, 1 << 20, "8", true};
constexpr NumberRange reference_samples{2, 1 << 20, "512", true};
constexpr NumberRange error{0, 1e30, "0.01"};
constexpr NumberRange world_scale{1e-12, 1e12, "1"};
constexpr NumberRange world_offset{-1e12, 1e12, "0"};
}  // namespace ranges

}  // namespace rpf::cli
