#pragma once

#include <fmt/format.h>

#include <string>

#include "rpf/error.h"

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

}  // namespace rpf::cli
