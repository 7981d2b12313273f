// Where the parts of the library lie that are started or loaded only when something needs them.
#pragma once

#include <string>
#include <vector>

namespace rpf {

/// Where a part with this file name can lie, the likeliest first: beside the program; beside the object that this code
/// is in (librpf.so, a module of another language); in the folder "rpf" of the libraries, where it is installed; where
/// it was built. Whether it is there is for the caller to see.
std::vector<std::string> places_of_part(const std::string& name);

}  // namespace rpf
