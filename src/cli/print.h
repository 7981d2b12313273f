// What the command says. A stream that is full, closed or has lost its reader must not cost an image, so nothing here
// throws; main() looks at the end whether results were lost.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "rpf/filter.h"

namespace rpf::cli {

/// The unit of the sizes that are told.
constexpr double megabyte = 1 << 20;

/// Names side by side, as in "N.X N.Y"; "none" where there are none.
std::string listed(const std::vector<std::string>& names);

/// Opens /dev/null for the standard streams that are closed, or else the first files to be opened would take their
/// numbers and receive what is printed.
void open_standard_streams();

/// Results, to standard output.
void print_text(const std::string& text);
template <class... T>
void print(fmt::format_string<T...> format, T&&... values) {
  print_text(fmt::format(format, std::forward<T>(values)...));
}

/// Remarks, to standard error, at once; lost where that cannot be written.
void remark_text(const std::string& text);
template <class... T>
void remark(fmt::format_string<T...> format, T&&... values) {
  remark_text(fmt::format(format, std::forward<T>(values)...));
}

/// What was found in the input.
void print_notes(const Report& report);

/// Hands over what is still buffered. Throws Error(output) where results were lost; a reader that left early, as in
/// `rpf info FILE | head -1`, has what it wanted.
void finish_printing();

}  // namespace rpf::cli
