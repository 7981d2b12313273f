#include "scene/tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "rpf/error.h"
#include "scene/embree.h"

namespace rpf::scene {
namespace {

// ---- solids as Embree's user geometry

const Solid& solid_of(void* solids, unsigned number) { return static_cast<const Solid*>(solids)[number]; }

Ray ray_of(const RTCRay& r) { return {{r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z}, r.time}; }

void bound(const RTCBoundsFunctionArguments* arguments) {
  const Solid& solid = solid_of(arguments->geometryUserPtr, arguments->primID);
  const Vec3 a = solid.center, b = solid.center + solid.velocity;
  const float reach = 1.001F * solid.reach();  // the whole interval at once; a little more than rounding takes
  *arguments->bounds_o = {std::min(a.x, b.x) - reach, std::min(a.y, b.y) - reach, std::min(a.z, b.z) - reach, 0,
                          std::max(a.x, b.x) + reach, std::max(a.y, b.y) + reach, std::max(a.z, b.z) + reach, 0};
}

void intersect(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto* ray_hit = reinterpret_cast<RTCRayHit*>(arguments->rayhit);  // N is 1
  RTCRay& ray = ray_hit->ray;
  const Solid& solid = solid_of(arguments->geometryUserPtr, arguments->primID);
  const std::optional<float> distance = solid.intersect(ray_of(ray), ray.tnear, ray.tfar);
  if (!distance) return;
  ray.tfar = *distance;
  ray_hit->hit.geomID = arguments->geomID;
  ray_hit->hit.primID = arguments->primID;
  ray_hit->hit.instID[0] = arguments->context->instID[0];
}

void occlude(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
  const Solid& solid = solid_of(arguments->geometryUserPtr, arguments->primID);
  if (solid.intersect(ray_of(ray), ray.tnear, ray.tfar)) ray.tfar = -std::numeric_limits<float>::infinity();
}

void attach(RTCScene scene, RTCGeometry geometry) {
  embree().commit_geometry(geometry);
  embree().attach_geometry(scene, geometry);
  embree().release_geometry(geometry);
}

void attach_mesh(RTCDevice device, RTCScene scene, const Mesh& mesh) {
  RTCGeometry geometry = embree().new_geometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(embree().set_new_geometry_buffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  for (const Vertex& v : mesh.vertices)
    for (const float coordinate : {v.position.x, v.position.y, v.position.z}) *points++ = coordinate;
  auto* indices = static_cast<unsigned*>(embree().set_new_geometry_buffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) indices = std::copy(triangle.begin(), triangle.end(), indices);
  attach(scene, geometry);
}

void attach_solids(RTCDevice device, RTCScene scene, const std::vector<Solid>& solids) {
  RTCGeometry geometry = embree().new_geometry(device, RTC_GEOMETRY_TYPE_USER);
  embree().set_geometry_user_primitive_count(geometry, static_cast<unsigned>(solids.size()));
  embree().set_geometry_user_data(geometry, const_cast<Solid*>(solids.data()));  // read only
  embree().set_geometry_bounds_function(
      geometry, [](const RTCBoundsFunctionArguments* a) { bound(a); }, nullptr);
  embree().set_geometry_intersect_function(geometry, [](const RTCIntersectFunctionNArguments* a) { intersect(a); });
  embree().set_geometry_occluded_function(geometry, [](const RTCOccludedFunctionNArguments* a) { occlude(a); });
  attach(scene, geometry);
}

/// Surfaces nearer than this do not count: the one that the ray starts from.
float least_distance(const Vec3& p) { return 1e-4F * (1 + std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)})); }

RTCRay embree_ray(const Ray& ray, float distance) {
  RTCRay r{};
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.time = ray.time;
  r.tnear = least_distance(ray.origin);
  r.tfar = distance;
  r.mask = ~0U;
  return r;
}

/// The vertex at the barycentric coordinates u, v.
Vertex interpolate(const Mesh& mesh, unsigned triangle, float u, float v) {
  const auto& corners = mesh.triangles[triangle];
  const Vertex &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]], &c = mesh.vertices[corners[2]];
  const auto mix = [&](float x, float y, float z) { return x + u * (y - x) + v * (z - x); };
  const Vec3 normal = a.normal + u * (b.normal - a.normal) + v * (c.normal - a.normal);
  return {a.position + u * (b.position - a.position) + v * (c.position - a.position),
          normalize(normal),
          {mix(a.uv.u, b.uv.u, c.uv.u), mix(a.uv.v, b.uv.v, c.uv.v)}};
}

}  // namespace

struct Tracer::Embree {
  // One instruction set on every machine, so that it is not the processor that decides the last bit.
  RTCDevice device = embree().new_device("isa=sse4.2");
  RTCScene scene = nullptr;

  Embree() {
    if (device == nullptr)
      throw Error(ErrorKind::device,
                  fmt::format("Embree does not start (error {}); a processor with SSE 4.2 is expected",
                              static_cast<int>(embree().get_device_error(nullptr))));
    scene = embree().new_scene(device);
    embree().set_scene_flags(scene, RTC_SCENE_FLAG_ROBUST);  // no rays through the edges between triangles
  }
  ~Embree() {
    embree().release_scene(scene);
    embree().release_device(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
};

Tracer::Tracer(const World& world) : world_(world), embree_(std::make_unique<Embree>()) {
  for (const Mesh& mesh : world.meshes) attach_mesh(embree_->device, embree_->scene, mesh);
  if (!world.solids.empty()) attach_solids(embree_->device, embree_->scene, world.solids);
  embree().commit_scene(embree_->scene);
  if (const RTCError error = embree().get_device_error(embree_->device); error != RTC_ERROR_NONE)
    throw Error(ErrorKind::internal, fmt::format("Embree refuses the scene (error {})", static_cast<int>(error)));
}

Tracer::~Tracer() = default;

std::optional<Hit> Tracer::nearest(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{embree_ray(ray, std::numeric_limits<float>::infinity()), {}};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree().intersect_1(embree_->scene, &context, &query);
  const RTCHit& found = query.hit;
  if (found.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  if (found.geomID < world_.meshes.size()) {
    const Mesh& mesh = world_.meshes[found.geomID];
    const Vertex v = interpolate(mesh, found.primID, found.u, found.v);
    return Hit{v.position, v.normal, v.uv, &world_.materials[mesh.material], mesh.light, query.ray.tfar};
  }
  const Solid& solid = world_.solids[found.primID];
  const Vertex v = solid.surface(ray.origin + query.ray.tfar * ray.direction, ray.time);
  return Hit{v.position, v.normal, v.uv, &world_.materials[solid.material], -1, query.ray.tfar, &solid};
}

bool Tracer::blocked(const Ray& ray, float distance) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = embree_ray(ray, distance);
  embree().occluded_1(embree_->scene, &context, &query);
  return query.tfar < 0;
}

}  // namespace rpf::scene
