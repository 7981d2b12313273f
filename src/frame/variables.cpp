#include "frame/variables.h"

namespace rpf {

std::string group_of_variable(const std::string& name) { return name.substr(0, name.find('.')); }

bool is_world_position(const std::string& group) { return group == "P" || group == "P2"; }

bool is_second_hit(const std::string& group) { return !group.empty() && group.back() == '2'; }

}  // namespace rpf
