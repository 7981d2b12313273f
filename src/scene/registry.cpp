#include "scene/registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "rpf/error.h"
#include "rpf/scene.h"

namespace rpf::scene {

const std::vector<Entry>& registry() {
  static const std::vector<Entry> entries = {
      {"dof", "spheres and cards at several depths over a checkered floor, defocused in front and behind", dof},
      {"dof-edge", "two half-planes at two depths: the blurred edge has a closed form", dof_edge},
      {"dof-thin", "hundreds of thin blades, defocused: hardly a pixel sees a single surface", dof_thin},
      {"dof-hdr",
       "small bright lights out of focus: bokeh, and samples a hundred times brighter than their surroundings",
       dof_hdr},
      {"motion", "moving and rotating spheres and boxes over the shutter interval", motion},
      {"soft-shadow", "a large area light: wide penumbras on plain and checkered surfaces", soft_shadow},
      {"glossy", "a curved glossy body in a Cornell box, two bounces: noise from the BSDF", glossy},
      {"menger", "a Menger sponge of level 2 in a Cornell box: fine geometry, strong features", menger},
      {"column", "a textured column with a sharp corner and one side with flipped normals", column},
      {"random-texture", "a fine texture that looks like noise: the known weakness of the method", random_texture},
      {"combined", "lens, time and light at once", combined},
      {"constant", "every sample has the radiance 0.25, 0.5, 0.75: nothing may change", constant},
      {"noise", "colors and features that depend on nothing: no feature may help, no random number may explain", noise},
      {"two-values", "R depends on the lens only, G on the time only, B on the albedo only: known mutual information",
       two_values}};
  return entries;
}

const Entry& find_scene(const std::string& name) {
  const auto& entries = registry();
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return name == e.name; });
  if (found != entries.end()) return *found;
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const Entry& entry : entries) names.emplace_back(entry.name);
  throw Error(ErrorKind::usage, fmt::format("scene '{}': no such scene; there are {}", name, fmt::join(names, ", ")));
}

}  // namespace rpf::scene

namespace rpf {

std::vector<SceneInfo> scenes() {
  std::vector<SceneInfo> infos;
  for (const scene::Entry& entry : scene::registry()) infos.push_back({entry.name, entry.purpose});
  return infos;
}

}  // namespace rpf
