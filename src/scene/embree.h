// Embree, loaded when the first scene is rendered: who filters needs no renderer.
#pragma once

#include <embree3/rtcore.h>

namespace rpf::scene {

/// The functions of Embree that tracer.cpp calls, under Embree's names.
struct EmbreeLibrary {
  decltype(&rtcAttachGeometry) attach_geometry = nullptr;
  decltype(&rtcCommitGeometry) commit_geometry = nullptr;
  decltype(&rtcCommitScene) commit_scene = nullptr;
  decltype(&rtcGetDeviceError) get_device_error = nullptr;
  decltype(&rtcIntersect1) intersect_1 = nullptr;
  decltype(&rtcNewDevice) new_device = nullptr;
  decltype(&rtcNewGeometry) new_geometry = nullptr;
  decltype(&rtcNewScene) new_scene = nullptr;
  decltype(&rtcOccluded1) occluded_1 = nullptr;
  decltype(&rtcReleaseDevice) release_device = nullptr;
  decltype(&rtcReleaseGeometry) release_geometry = nullptr;
  decltype(&rtcReleaseScene) release_scene = nullptr;
  decltype(&rtcSetGeometryBoundsFunction) set_geometry_bounds_function = nullptr;
  decltype(&rtcSetGeometryIntersectFunction) set_geometry_intersect_function = nullptr;
  decltype(&rtcSetGeometryOccludedFunction) set_geometry_occluded_function = nullptr;
  decltype(&rtcSetGeometryUserData) set_geometry_user_data = nullptr;
  decltype(&rtcSetGeometryUserPrimitiveCount) set_geometry_user_primitive_count = nullptr;
  decltype(&rtcSetNewGeometryBuffer) set_new_geometry_buffer = nullptr;
  decltype(&rtcSetSceneFlags) set_scene_flags = nullptr;
};

/// Throws Error(device) where it is not installed.
const EmbreeLibrary& embree();

}  // namespace rpf::scene
