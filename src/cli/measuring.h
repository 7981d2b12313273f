#pragma once

#include <fmt/format.h>

#include <string>

#include "cli/print.h"
#include "rpf/error.h"
#include "rpf/image.h"

namespace rpf::cli {

/// Runs what measures an image against a reference; its errors name the two files.
template <class Work>
auto measuring(const std::string& image, const std::string& reference, const Work& work) {
  try {
    return work();
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format(R"("{}", measured against "{}": {})", image, reference, e.what()));
  }
}

/// The same pixels in another frame: they can be compared, but one of the two may be wrong, which is told on standard
/// error. `other`: "its reference".
inline void tell_display_window(const std::string& image, const Window& window, const char* other,
                                const Window& expected) {
  if (window == expected) return;
  remark("rpf: note: \"{}\" has the display window {}, {} {}\n", image, text_of(window), other, text_of(expected));
}

}  // namespace rpf::cli
