// Floors, lights, boxes: what several scenes share. y is up, the camera looks along -z.
#pragma once

#include <functional>

#include "scene/world.h"

namespace rpf::scene {

/// A pinhole at `position` that looks at `target`; the frame's width is `width_at_one` at distance 1.
Camera look(const Vec3& position, const Vec3& target, float width_at_one);

/// Opens the lens: radius in scene units, sharp at `focus`.
void open_lens(Camera& camera, float radius, float focus);

/// A square of 24 units around the origin at height 0, with checks of one unit.
void add_checkered_floor(World& world);
void add_floor(World& world, const Texture& texture);

/// A square light of edge `size` that shines straight down from `center`.
void add_ceiling_light(World& world, const Vec3& center, float size, const Vec3& radiance);

/// An upright rectangle that faces the camera; `foot` is the middle of its lower edge.
void add_card(World& world, const Vec3& foot, float width, float height, std::uint32_t material);

Solid sphere(const Vec3& center, float radius, std::uint32_t material);
Solid box(const Vec3& center, const Vec3& half_size, std::uint32_t material);

/// A Cornell box as wide as the frame: x from -1.78 to 1.78, y from 0 to 2, z from -1 to 1, open towards the camera.
World cornell_box();

/// Adds the surface point(u, v), u and v in [0, 1], as columns x rows quadrilaterals with smooth normals, which point
/// along (derivative by u) x (derivative by v).
void add_surface(Mesh& mesh, int columns, int rows, const std::function<Vec3(float, float)>& point);

}  // namespace rpf::scene
