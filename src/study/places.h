// Parts of scenes that experiments look at.
#pragma once

#include "study/regions.h"

namespace rpf::study {

// column: its front edge is in the middle of the picture, a brick wall to each side.
constexpr Region corner = {"corner", -0.031, -0.156, 0.062, 0.25};
constexpr Region bricks = {"bricks", 0.031, -0.156, 0.144, 0.25};
constexpr Region column_front = {"front", -0.125, -0.156, 0.3125, 0.25};

// menger: the sponge, its front edge, its right side with holes.
constexpr Region sponge = {"sponge", -0.19, -0.06, 0.4, 0.3};
constexpr Region edge = {"edge", -0.068, 0.015, 0.05, 0.18};
constexpr Region holes = {"holes", -0.03, -0.016, 0.18, 0.19};

// menger and glossy: the lamp at the ceiling, and what it lights.
constexpr Region lamp = {"lamp", -0.125, -0.281, 0.25, 0.078};
constexpr Region ceiling = {"ceiling", -0.2, -0.281, 0.4, 0.22};

// random-texture: the floor in front, the ball.
constexpr Region floor_grain = {"floor", -0.4, 0.17, 0.8, 0.11};
constexpr Region ball_grain = {"ball", -0.281, -0.094, 0.1625, 0.156};
constexpr Region ball_and_floor = {"ball and floor", -0.281, -0.094, 0.25, 0.25};

// soft-shadow: the floor at the right, where the shadows of pillars and box meet.
constexpr Region penumbra = {"penumbra", 0.224, 0.047, 0.265, 0.213};

// All scenes: what stands in the middle.
constexpr Region center = {"center", -0.125, -0.07, 0.25, 0.14};

}  // namespace rpf::study
