// Surfaces and light transport of synthetic scenes against what physics says.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/integrator.h"
#include "scene/penumbra.h"
#include "scene/random.h"
#include "scene/staging.h"
#include "scene/warp.h"

namespace {

using namespace rpf::scene;

/// Integral over the upper hemisphere by midpoints in (cosine, angle).
template <class Function>
double integrate(const Function& f) {
  constexpr int cosines = 1000, angles = 400;
  double sum = 0;
  for (int i = 0; i < cosines; ++i)
    for (int j = 0; j < angles; ++j) {
      const float z = (static_cast<float>(i) + 0.5F) / cosines, phi = (static_cast<float>(j) + 0.5F) * 2 * pi / angles;
      const float r = std::sqrt(1 - z * z);
      sum += f(Vec3{r * std::cos(phi), r * std::sin(phi), z});
    }
  return sum * 2 * pi / (static_cast<double>(cosines) * angles);
}

Vec3 direction_at(float degrees) { return {std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180)}; }

/// Mean weight of sampled directions: the part of the light that is reflected.
double sampled_albedo(const Material& material, const Vec3& color, const Vec3& out, int count) {
  double sum = 0;
  const PixelSampler sampler(rpf::SceneSampler::sobol, 5, static_cast<std::uint32_t>(count));
  for (int i = 0; i < count; ++i) sum += sample(material, color, out, sampler.pair(i, 0)).weight.x;
  return sum / count;
}

TEST(Reflection, SampledAndIntegratedAlbedoAgree) {
  for (const Material& material : {plain({0.5F, 0.5F, 0.5F}), metal({0.5F, 0.5F, 0.5F}, 0.3F), metal({1, 1, 1}, 0.6F)})
    for (const float degrees : {0.0F, 40.0F, 75.0F}) {
      const Vec3 out = direction_at(degrees), color = material.color.first;
      const double integrated = integrate([&](const Vec3& in) { return reflected(material, color, out, in).x; });
      EXPECT_NEAR(sampled_albedo(material, color, out, 1 << 16), integrated, 2e-3) << degrees;
      EXPECT_LE(integrated, 1.001);
    }
}

// The textbook's integral over microfacet normals (Walter et al. 2007 with Heitz's height-correlated G2), by numpy.
TEST(Reflection, WhiteMetalReflectsWhatTheTextbookSays) {
  const auto albedo = [](float alpha, float degrees) {
    const Material material = metal({1, 1, 1}, alpha);
    return integrate([&](const Vec3& in) { return reflected(material, {1, 1, 1}, direction_at(degrees), in).x; });
  };
  EXPECT_NEAR(albedo(0.2F, 0), 0.94766, 2e-3);
  EXPECT_NEAR(albedo(0.3F, 40), 0.85249, 1e-3);
  EXPECT_NEAR(albedo(0.6F, 75), 0.72714, 1e-3);
}

// Microfacets that reflect below the surface are lost, so the density of a metal may integrate to less than one.
TEST(Reflection, DensityIntegratesToTheShareOfDirectionsAbove) {
  for (const Material& material : {plain({1, 1, 1}), metal({1, 1, 1}, 0.3F), metal({1, 1, 1}, 0.6F)})
    for (const float degrees : {10.0F, 70.0F}) {
      const Vec3 out = direction_at(degrees);
      int above = 0;
      constexpr int count = 1 << 15;
      const PixelSampler sampler(rpf::SceneSampler::sobol, 9, count);
      for (int i = 0; i < count; ++i)
        if (!is_black(sample(material, {1, 1, 1}, out, sampler.pair(i, 0)).weight)) ++above;
      EXPECT_NEAR(integrate([&](const Vec3& in) { return density(material, out, in); }),
                  above / static_cast<double>(count), 3e-3);
    }
}

TEST(Reflection, IsTheSameInBothDirections) {
  const Material material = metal({0.6F, 0.6F, 0.6F}, 0.4F);
  const Vec3 a = direction_at(20), b = normalize({-0.3F, 0.6F, 0.4F});
  EXPECT_NEAR(reflected(material, {0.6F, 0, 0}, a, b).x / b.z, reflected(material, {0.6F, 0, 0}, b, a).x / a.z, 1e-5);
}

Path look_at(const World& world, const Tracer& tracer, std::uint32_t number, Strategy strategy = Strategy::both) {
  const Draw draw = PixelSampler(rpf::SceneSampler::random, 3, 1 << 20).draw(number);
  const Ray ray =
      world.camera.ray(16 + 32 * (draw.film.u - 0.5F), 9 + 18 * (draw.film.v - 0.5F), 32, 18, draw.lens, draw.time);
  return trace_path(world, tracer, ray, draw, strategy);
}

/// A sphere of that material under a sky of radiance 1 everywhere.
World furnace(const Material& material) {
  World world;
  world.camera = look({0, 0, 3}, {0, 0, 0}, 0.6F);
  world.sky = {1, 1, 1};
  world.scatterings = 3;
  world.add(sphere({0, 0, 0}, 1, world.add(material)));
  return world;
}

TEST(Furnace, WhiteDiffuseSphereAndMirrorAreInvisible) {
  for (const Material& material : {plain({1, 1, 1}), mirror({1, 1, 1})}) {
    const World world = furnace(material);
    const Tracer tracer(world);
    for (std::uint32_t i = 0; i < 500; ++i) {
      const Path path = look_at(world, tracer, i);
      EXPECT_NEAR(path.radiance.x, 1, 1e-5);
    }
  }
}

TEST(Furnace, WhiteMetalLosesLittleAndGainsNothing) {
  const World world = furnace(metal({1, 1, 1}, 0.2F));
  const Tracer tracer(world);
  double sum = 0;
  constexpr int count = 4000;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float radiance = look_at(world, tracer, i).radiance.x;
    EXPECT_LE(radiance, 1.00001F);
    sum += radiance;
  }
  EXPECT_GT(sum / count, 0.91);  // the whole sphere reflects 0.916, its rim least
}

/// A closed room whose walls shine with radiance 1 and reflect the part 0.5 of what they receive.
World bright_room() {
  World world;
  world.camera = look({0.1F, 0.2F, 0.3F}, {0, 0, -1}, 1);
  Material wall = plain({0.5F, 0.5F, 0.5F});
  wall.emission = {1, 1, 1};
  const std::uint32_t material = world.add(wall);
  const Vec3 x = {2, 0, 0}, y = {0, 2, 0}, z = {0, 0, 2}, low = {-1, -1, -1}, high = {1, 1, 1};
  for (const auto& [u, v] : {std::pair{x, y}, {y, z}, {z, x}}) {  // normals point inwards
    world.add(Rectangle{low, u, v}, material);
    world.add(Rectangle{high, -v, -u}, material);
  }
  return world;
}

TEST(Furnace, ClosedRoomAddsUpEveryScattering) {
  World world = bright_room();
  for (const int scatterings : {0, 1, 2, 5}) {
    world.scatterings = scatterings;
    const Tracer tracer(world);
    int exact = 0;
    for (std::uint32_t i = 0; i < 1000; ++i)
      if (std::fabs(look_at(world, tracer, i).radiance.x - (2 - std::pow(0.5, scatterings))) < 1e-5) ++exact;
    EXPECT_GE(exact, 997);  // a ray that starts within 0.0002 of an edge may leave the room
  }
}

TEST(Lights, AreBlackFromBehind) {
  World world;
  world.camera = look({0, 3, 0.01F}, {0, 0, 0}, 0.1F);
  add_ceiling_light(world, {0, 1, 0}, 2, {1, 1, 1});
  const Tracer from_behind(world);
  EXPECT_EQ(look_at(world, from_behind, 0).radiance.x, 0);
  world.camera.position.y = -3;
  EXPECT_EQ(look_at(world, from_behind, 0).radiance.x, 1);
}

struct Estimate {
  double mean = 0, error = 0;  ///< error: standard error
};

Estimate estimate(const World& world, Strategy strategy, std::uint32_t first, int count) {
  const Tracer tracer(world);
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const double value = look_at(world, tracer, first + i, strategy).radiance.y;
    sum += value, squares += value * value;
  }
  const double mean = sum / count;
  return {mean, std::sqrt((squares / count - mean * mean) / count)};
}

/// A glossy and a diffuse ball under two large lights, light scattered up to three times.
World two_lights() {
  World world;
  world.camera = look({0, 1.5F, 4}, {0, 0.5F, 0}, 1);
  world.scatterings = 3;
  add_checkered_floor(world);
  add_ceiling_light(world, {1, 3, 0}, 3, {3, 2, 1});
  add_ceiling_light(world, {-2, 2, 1}, 1, {5, 6, 7});
  world.add(sphere({-0.6F, 0.5F, 0}, 0.5F, world.add(metal({0.9F, 0.9F, 0.9F}, 0.2F))));
  world.add(box({0.7F, 0.5F, 0}, {0.5F, 0.5F, 0.5F}, world.add(plain({0.6F, 0.7F, 0.8F}))));
  return world;
}

TEST(Lights, AllStrategiesHaveTheSameMean) {
  const World world = two_lights();
  constexpr int count = 60000;
  const Estimate both = estimate(world, Strategy::both, 0, count);
  const Estimate lights = estimate(world, Strategy::lights_only, count, count);
  const Estimate rays = estimate(world, Strategy::rays_only, 2 * count, count);
  EXPECT_NEAR(both.mean, lights.mean, 3 * std::hypot(both.error, lights.error));
  EXPECT_NEAR(both.mean, rays.mean, 3 * std::hypot(both.error, rays.error));
  EXPECT_LT(both.error, rays.error);
  EXPECT_LT(both.error, 0.01 * both.mean);
}

// Irradiance under the middle of a square light of edge 2 at height 1, in closed form: four times the view factor of a
// corner, F = (2 / 2 pi) a / sqrt(1 + a^2) atan(b / sqrt(1 + a^2)) + ..., here a = b = 1.
TEST(Lights, SquareLightHasItsViewFactor) {
  World world;
  world.camera = look({0, 0.5F, 0.001F}, {0, 0, 0}, 1e-4F);
  world.scatterings = 1;
  add_floor(world, {Pattern::plain, {0.5F, 0.5F, 0.5F}, {}, 1});
  add_ceiling_light(world, {0, 1, 0}, 2, {1, 1, 1});
  const double corner = 1 / (2 * M_PI) * 2 / std::sqrt(2.0) * std::atan(1 / std::sqrt(2.0));
  for (const Strategy strategy : {Strategy::both, Strategy::lights_only, Strategy::rays_only}) {
    const Estimate measured = estimate(world, strategy, 0, 40000);
    EXPECT_NEAR(measured.mean, 0.5 * 4 * corner, 3 * measured.error);
  }
}

TEST(Solids, MoveAndTurnWithTime) {
  Solid ball = sphere({0, 0, -5}, 1, 0);
  ball.velocity = {4, 0, 0};
  const auto at = [](float x, float time) { return Ray{{x, 0, 0}, {0, 0, -1}, time}; };
  EXPECT_FLOAT_EQ(ball.intersect(at(0, 0), 0, 100).value(), 4);
  EXPECT_FALSE(ball.intersect(at(0, 0.5F), 0, 100));
  EXPECT_FLOAT_EQ(ball.intersect(at(2, 0.5F), 0, 100).value(), 4);
  EXPECT_FLOAT_EQ(ball.intersect(at(2, 0.5F), 4.5F, 100).value(), 6);

  Solid plank = box({0, 0, -5}, {2, 1, 0.5F}, 0);
  plank.turn = pi / 2;  // in the end it points at the viewer
  EXPECT_FLOAT_EQ(plank.intersect(at(0.1F, 0), 0, 100).value(), 4.5F);
  EXPECT_NEAR(plank.intersect(at(0.1F, 1), 0, 100).value(), 3, 1e-5);
  EXPECT_FALSE(plank.intersect(at(1, 1), 0, 100));
  const Vec3 normal = plank.surface({0.1F, 0, -3}, 1).normal;
  EXPECT_NEAR(normal.z, 1, 1e-5);
}

TEST(Solids, AreSeenWhereTheyAreAtTheTimeOfTheRay) {
  World world;
  Solid ball = sphere({-2, 0, -5}, 1, world.add(plain({1, 1, 1})));
  ball.velocity = {4, 0, 0};
  world.add(ball);
  for (int i = 0; i < 8; ++i)  // a hierarchy needs company: around a single solid it asks nobody for bounds
    world.add(sphere({-20.0F + 5 * static_cast<float>(i), 20, -30}, 1, 0));
  const Tracer tracer(world);
  for (const float time : {0.0F, 0.25F, 0.5F, 0.99F}) {
    const auto hit = tracer.nearest({{-2 + 4 * time, 0, 0}, {0, 0, -1}, time});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 4, 1e-5);
    EXPECT_NEAR(hit->normal.z, 1, 1e-5);
    EXPECT_FALSE(tracer.nearest({{-2 + 4 * time, 1.01F, 0}, {0, 0, -1}, time}));
    EXPECT_TRUE(tracer.blocked({{-2 + 4 * time, 0, 0}, {0, 0, -1}, time}, 10));
    EXPECT_FALSE(tracer.blocked({{-2 + 4 * time, 0, 0}, {0, 0, -1}, time}, 3.9F));
  }
}

// A quarter turn and a step to the right: the rightmost point of the box goes to its front, and with it.
TEST(Solids, CarryTheirPointsAlong) {
  Solid box;
  box.center = {2, 0, 0};
  box.velocity = {3, 0, 0};
  box.turn = -pi / 2;
  const Vec3 closing = box.carried({3, 0.5F, 0}, 0, 1), opening = box.carried(closing, 1, 0);
  EXPECT_NEAR(closing.x, 5, 1e-6F);
  EXPECT_NEAR(closing.y, 0.5F, 1e-6F);
  EXPECT_NEAR(closing.z, 1, 1e-6F);
  EXPECT_NEAR(length(opening - Vec3{3, 0.5F, 0}), 0, 1e-6F);
}

// Similar triangles: a plate at a quarter of the way up to a light of edge 2 blurs its edge over a third of the light.
TEST(Penumbras, AreAsWideAsSimilarTrianglesSay) {
  World world;
  const std::uint32_t white = world.add(plain({1, 1, 1}));
  world.add(Rectangle{{-9, 0, -9}, {0, 0, 18}, {18, 0, 0}}, white);
  world.add(Rectangle{{-9, 1, -9}, {0, 0, 18}, {8, 0, 0}}, white);  // ends at x = -1
  add_ceiling_light(world, {0, 4, 0}, 2, {1, 1, 1});
  const Tracer tracer(world);
  const Ray ray = {{0, 5, 0}, {0, -1, 0}, 0};
  const auto seen = [&](float x, const Vec3& normal) {
    return penumbra_of(world, tracer, ray, {true, {x, 0, 0}, normal, {1, 1, 1}, {}}, {0.3F, 0.8F});
  };
  const Penumbra dark = seen(-5, {0, 1, 0});
  EXPECT_NEAR(dark.slope, 1.0F / 3, 1e-5F);
  EXPECT_NEAR(dark.width, 1.0F / 3, 1e-5F);
  EXPECT_EQ(seen(3, {0, 1, 0}).slope, 0) << "nothing stands before the light";
  EXPECT_EQ(seen(-5, {1, 0, 0}).slope, seen(-5, {-1, 0, 0}).slope == 0 ? dark.slope : 0) << "one side faces it";
}

}  // namespace
