// What `rpf compare` prints.
#pragma once

#include <string>
#include <vector>

#include "rpf/metrics.h"

namespace rpf::cli {

struct ComparedImage {
  std::string file;
  ImageError error;
};

struct Comparison {
  std::vector<ComparedImage> images;
  std::string reference;
  std::string diff;  ///< the heat map's file, empty without one
};

std::string table_of(const Comparison& comparison);

/// Names and numbers as docs/commands.md lists them; what is not finite is null.
std::string json_of(const Comparison& comparison);

}  // namespace rpf::cli
