#include "cli/numbers.h"

#include <fmt/format.h>

#include <charconv>

#include "cli/environment.h"

namespace rpf::cli {

std::string refusal_of(const std::string& text, const NumberRange& range, const std::string& variable) {
  double value = 0;
  const char *begin = text.data() + (text[0] == '+' ? 1 : 0), *end = text.data() + text.size();
  // Not strtod(), which asks the locale.
  const auto [stop, failure] = std::from_chars(begin, end, value);
  if (failure == std::errc() && stop == end && range.has(value) &&
      (!range.whole || text.find_first_of(".eE") == std::string::npos))
    return "";
  return fmt::format("{}: {}", quoted_with_source(text, variable), range.expected());
}

std::string decimal(const std::string& text) {
  const std::size_t first = text.find_first_not_of("+0");
  return first == std::string::npos ? "0" : text.substr(first);
}

}  // namespace rpf::cli
