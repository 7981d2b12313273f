// Microfacets after Walter et al. 2007 (GGX), visible normals after Heitz (JCGT 7(4), 2018).
#pragma once

#include "scene/sampler.h"
#include "scene/vector.h"

namespace rpf::scene {

/// How many microfacets, a steradian, have the normal `half`.
float ggx_normals(const Vec3& half, float alpha);

/// G1: the part of the microfacets that is visible from `direction`.
float ggx_visible(const Vec3& direction, float alpha);

/// G2: the part that is visible from both directions (height-correlated).
float ggx_visible(const Vec3& out, const Vec3& in, float alpha);

/// A microfacet normal, chosen by how much of it is visible from `out`.
Vec3 ggx_sample_normal(const Vec3& out, float alpha, Pair random);

}  // namespace rpf::scene
