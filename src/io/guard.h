// Turns the exceptions of other libraries into rpf::Error.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <new>
#include <string>

#include "rpf/error.h"

namespace rpf::io {

/// Libraries collect their messages line by line; the first says what went wrong.
inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Runs `work` on an input file. Whatever it throws becomes Error(input) with the file's name and the thrown text;
/// a failed allocation becomes Error(memory).
template <class Work>
auto guard_input(const std::string& path, Work work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::memory,
                fmt::format("\"{}\" does not fit into the memory that is left; free memory or crop the file", path));
  } catch (const std::exception& error) {
    throw Error(ErrorKind::input, fmt::format("\"{}\" cannot be read ({}); copy or render the file again", path,
                                              first_line(error.what())));
  }
}

}  // namespace rpf::io
