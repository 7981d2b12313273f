// The variables of a record: which there are, and what their names say.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rpf {

/// The variables of a record, in this order: color 3, position 2, random parameters, features.
struct Variables {
  static constexpr std::size_t color = 0, position = 3, random = 5;
  std::vector<std::string> random_names, feature_names;  ///< "lens.U", "N.X"

  std::size_t features() const { return random + random_names.size(); }
  std::size_t count() const { return features() + feature_names.size(); }
};

/// "N" of the variable "N.X"; group_of() does it for slots, such as "feature.N.X".
std::string group_of_variable(const std::string& name);

/// Whether a group of features is of the second hit: its name ends in 2, as in "N2".
bool is_second_hit(const std::string& group);

/// Whether a group of features holds world positions: "P" or "P2".
bool is_world_position(const std::string& group);

}  // namespace rpf
