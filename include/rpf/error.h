// Errors. The library throws rpf::Error and nothing else of its own; it never prints and never exits.
#pragma once

#include <stdexcept>
#include <string>

namespace rpf {

/// What went wrong, in the terms of the command line's exit codes (docs/commands.md).
enum class ErrorKind {
  internal = 1,    ///< a defect of this program
  usage = 2,       ///< an option or a setting that cannot be
  input = 3,       ///< a file or sample buffer that cannot be used
  output = 4,      ///< a result that could not be written
  device = 5,      ///< a backend or device that is missing or failed
  memory = 6,      ///< more memory needed than the limit allows
  cancelled = 130  ///< stopped on request (signal or callback)
};

/// `text` with ? for control characters: a file's name must not break a line or steer a terminal.
inline std::string printable(std::string text) {
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) letter = '?';
  return text;
}

/// The only exception type this library throws on purpose. what() is one sentence that names the file, channel, pixel
/// or option, says what was expected and what to do next; on one line, whatever the names in it are.
class Error : public std::runtime_error {
 public:
  /// `message`: one sentence, as above.
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(printable(message)), kind_(kind) {}
  /// What went wrong.
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace rpf
