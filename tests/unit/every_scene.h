// Tests that run once for every scene.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "rpf/scene.h"

namespace rpf::test {

inline std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneInfo& scene : scenes()) names.push_back(scene.name);
  return names;
}

/// The scene's name as a part of a test's name.
inline std::string name_of_scene(const testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace rpf::test
