// All scenes by name. Each family of scenes is a file of its own.
#pragma once

#include <string>
#include <vector>

#include "scene/world.h"

namespace rpf::scene {

struct Entry {
  const char* name;
  const char* purpose;  ///< one line
  World (*build)();
};

const std::vector<Entry>& registry();

/// Throws Error(usage) for an unknown name, naming those there are.
const Entry& find_scene(const std::string& name);

// scenes_defocus.cpp
World dof();
World dof_edge();
World dof_thin();
World dof_hdr();
// scenes_motion.cpp
World motion();
World combined();
// scenes_light.cpp
World soft_shadow();
World glossy();
World menger();
// scenes_texture.cpp
World column();
World random_texture();
// scenes_statistics.cpp
World constant();
World noise();
World two_values();

}  // namespace rpf::scene
