// A scene as the renderer takes it: plain data, built by the files of the scenes.
#pragma once

#include <functional>
#include <vector>

#include "scene/camera.h"
#include "scene/material.h"
#include "scene/path.h"
#include "scene/shapes.h"

namespace rpf::scene {

/// A rectangle that shines to the side of its normal.
struct AreaLight {
  Rectangle shape;
  Vec3 radiance;
};

/// Which random parameters change anything in a scene.
struct Usage {
  bool lens = false, time = false, light = false, bsdf = false;
};

struct World {
  Camera camera;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Solid> solids;
  std::vector<AreaLight> lights;
  Vec3 sky;  ///< radiance of rays that leave the scene
  int scatterings =
      2;  ///< how often light may be scattered between its source and the camera; 0: only sources are seen
  /// Where given, samples come from here and there is no geometry. film_x, film_y: pixels.
  std::function<Path(const Draw&, float film_x, float film_y)> direct;

  Usage usage() const;

  // For building: each adds one thing and returns or uses the material's number.
  std::uint32_t add(const Material& material);
  void add(const Rectangle& rectangle, std::uint32_t material);
  void add(const Solid& solid) { solids.push_back(solid); }
  /// An area light with the mesh that makes it visible.
  void add(const AreaLight& light);
};

// Materials in short.
Material plain(const Vec3& color);
Material textured(const Texture& texture);
Material metal(const Vec3& color, float roughness);
Material mirror(const Vec3& color);
Material glowing(const Vec3& radiance, const Vec3& color);

}  // namespace rpf::scene
