#pragma once

#include <nlohmann/json.hpp>

#include "rpf/metrics.h"

namespace rpf::report {

/// The errors of one image: names and numbers as docs/commands.md lists them.
nlohmann::ordered_json json_of(const ImageError& error);

}  // namespace rpf::report
