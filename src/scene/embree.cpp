#include "scene/embree.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "rpf/error.h"

namespace rpf::scene {
namespace {

constexpr const char* library_name = "libembree3.so.3";

[[noreturn]] void fail() {
  throw Error(ErrorKind::device, fmt::format("scenes are rendered by Embree, which cannot be loaded ({}); install it "
                                             "(Debian: apt-get install libembree3-3)",
                                             dlerror()));
}

template <class Function>
void load(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) fail();
}

/// The library stays loaded.
EmbreeLibrary load_all() {
  void* library = dlopen(library_name, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) fail();
  EmbreeLibrary embree;
  load(library, "rtcAttachGeometry", embree.attach_geometry);
  load(library, "rtcCommitGeometry", embree.commit_geometry);
  load(library, "rtcCommitScene", embree.commit_scene);
  load(library, "rtcGetDeviceError", embree.get_device_error);
  load(library, "rtcIntersect1", embree.intersect_1);
  load(library, "rtcNewDevice", embree.new_device);
  load(library, "rtcNewGeometry", embree.new_geometry);
  load(library, "rtcNewScene", embree.new_scene);
  load(library, "rtcOccluded1", embree.occluded_1);
  load(library, "rtcReleaseDevice", embree.release_device);
  load(library, "rtcReleaseGeometry", embree.release_geometry);
  load(library, "rtcReleaseScene", embree.release_scene);
  load(library, "rtcSetGeometryBoundsFunction", embree.set_geometry_bounds_function);
  load(library, "rtcSetGeometryIntersectFunction", embree.set_geometry_intersect_function);
  load(library, "rtcSetGeometryOccludedFunction", embree.set_geometry_occluded_function);
  load(library, "rtcSetGeometryUserData", embree.set_geometry_user_data);
  load(library, "rtcSetGeometryUserPrimitiveCount", embree.set_geometry_user_primitive_count);
  load(library, "rtcSetNewGeometryBuffer", embree.set_new_geometry_buffer);
  load(library, "rtcSetSceneFlags", embree.set_scene_flags);
  return embree;
}

}  // namespace

const EmbreeLibrary& embree() {
  static const EmbreeLibrary library = load_all();
  return library;
}

}  // namespace rpf::scene
