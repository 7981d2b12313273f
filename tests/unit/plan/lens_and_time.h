// What tests of the methods for noise of lens and time begin with.
#pragma once

#include <string>
#include <vector>

#include "rpf/filter.h"
#include "rpf/methods.h"
#include "rpf/scene.h"
#include "test_frames.h"

namespace rpf::test {

inline SceneOptions small_scene(int samples = 4) {
  SceneOptions options;
  options.width = 40;
  options.height = 24;
  options.samples = samples;
  options.lightfield = true;
  options.threads = 1;
  return options;
}

inline Settings few_views(const std::string& method, int views = 16) {
  Settings s = method_settings(method);
  s.backend = backend_under_test();
  s.threads = 1;
  s.views = views;
  return s;
}

inline Settings plain_mean() {
  Settings s = few_views("rpf");
  s.box_widths.clear();
  return s;
}

inline std::vector<float> filtered(const SampleBuffer& samples, const Settings& s) {
  return filter(samples, s).image.pixels;
}

}  // namespace rpf::test
