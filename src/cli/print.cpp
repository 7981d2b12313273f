#include "cli/print.h"

#include <fcntl.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

#include "rpf/error.h"

namespace rpf::cli {
namespace {

int first_failure = 0;  ///< errno of the first write to standard output that failed

void keep_failure() {
  if (first_failure == 0) first_failure = errno;
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, " "));
}

void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0) ::open("/dev/null", O_RDWR);  // takes the lowest number that is free
}

void print_text(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) keep_failure();
}

void remark_text(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void print_notes(const Report& report) {
  for (const InputNote& note : report.notes)
    remark("rpf: note: {}: {} (first at pixel {},{})\n", note.what, note.count, note.x, note.y);
}

void finish_printing() {
  if (!std::cout.flush().good() || std::fflush(stdout) != 0) keep_failure();  // --help goes to std::cout
  if (first_failure == 0 || first_failure == EPIPE) return;
  throw Error(ErrorKind::output,
              fmt::format("standard output cannot be written ({}), so what was to be printed is lost; files that were "
                          "written are whole",
                          std::system_category().message(first_failure)));
}

}  // namespace rpf::cli
