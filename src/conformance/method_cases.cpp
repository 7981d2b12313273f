#include <fmt/ranges.h>

#include <limits>

#include "conformance/case_list.h"
#include "rpf/methods.h"

namespace rpf {
namespace {

/// The cases of one method with fixed weights: what its kernel can meet.
class MethodCases {
 public:
  MethodCases(CaseList& list, std::string method) : list_(list), method_(std::move(method)) {}

  ConformanceCase basic(int samples = 4) const {
    const Method method = method_settings(method_).method;
    const bool of_shadows = method == Method::axis_aligned, of_light = method == Method::lightfield;
    const bool of_lens_and_time = of_light || method == Method::multidim;
    ConformanceCase c = CaseList::basic(of_shadows ? "soft-shadow" : of_lens_and_time ? "combined" : "dof", samples);
    c.options.penumbra = of_shadows;
    c.options.lightfield = of_light;
    c.settings = method_settings(method_);
    c.settings.views = 9;
    c.settings.box_widths = {9, 5};
    return c;
  }
  void add(const std::string& what, ConformanceCase c) {
    c.name = fmt::format("method/{}/{}", method_, what);
    list_.cases.push_back(c);
  }
  void add(const std::string& what, const std::function<void(Settings&)>& set) {
    ConformanceCase c = basic();
    set(c.settings);
    add(what, c);
  }

 private:
  CaseList& list_;
  std::string method_;
};

void add_method_frames(MethodCases& list) {
  for (const int samples : {1, 2, 3, 4, 16, CaseList::varying}) {
    ConformanceCase c = list.basic(samples);
    c.quick = samples == 4 || samples == CaseList::varying;
    list.add(count_name(samples), c);
    c.quick = false;
    c.band_rows = 9;
    list.add("band/" + count_name(samples), c);
  }
  constexpr int sizes[][2] = {{1, 1}, {1, 17}, {17, 1}, {17, 5}};
  for (const auto& size : sizes) {
    ConformanceCase c = list.basic(CaseList::varying);
    c.options.width = size[0];
    c.options.height = size[1];
    list.add(fmt::format("size/{}x{}", size[0], size[1]), c);
  }
  for (const int width : {1, 3, 11, 21, 55})
    list.add(fmt::format("box/{}", width), [&](Settings& s) { s.box_widths = {width}; });
  for (const auto& [name, change] : extremes()) {
    ConformanceCase c = list.basic();
    c.change = change;
    list.add("extreme/" + name, c);
  }
  ConformanceCase nowhere = list.basic();
  nowhere.change = poison("film.X", std::numeric_limits<float>::quiet_NaN(), 3);
  list.add("extreme/nan-film", nowhere);
}

/// Frames for methods that filter pixels, which need two samples in some.
void add_pixel_frames(MethodCases& list) {
  for (const int samples : {2, 3, 4, 16, CaseList::varying}) {
    ConformanceCase c = list.basic(samples);
    c.quick = samples == 4 || samples == CaseList::varying;
    list.add(count_name(samples), c);
  }
  constexpr int sizes[][2] = {{1, 1}, {1, 17}, {17, 1}, {17, 5}, {300, 3}};
  for (const auto& size : sizes) {
    ConformanceCase c = list.basic();
    c.options.width = size[0];
    c.options.height = size[1];
    list.add(fmt::format("size/{}x{}", size[0], size[1]), c);
  }
  for (const auto& [name, change] : extremes()) {
    ConformanceCase c = list.basic();
    c.change = change;
    list.add("extreme/" + name, c);
  }
}

void add_windows_of_patches(MethodCases& list) {
  for (const int width : {1, 3, 55}) list.add(fmt::format("window/{}", width), [&](Settings& s) { s.window = width; });
  for (const float damping : {1e-3F, 0.1F, 1e3F})
    list.add(fmt::format("damping/{:g}", damping), [&](Settings& s) { s.damping = damping; });
}

void add_colors(MethodCases& list) {
  for (const float sigma : {1e-30F, 1e-3F, 1e30F})
    list.add(fmt::format("sigma-color/{:g}", sigma), [&](Settings& s) { s.sigma_color = sigma; });
}

void add_features(MethodCases& list) {
  for (const float sigma : {1e-6F, 1e6F})
    list.add(fmt::format("sigma-feature/{:g}", sigma), [&](Settings& s) { s.sigma_feature = sigma; });
}

void add_feature_groups(MethodCases& list) {
  for (const char* group : {"N", "P2"})
    list.add(fmt::format("features/{}", group), [&](Settings& s) { s.features = {group}; });
  list.add("features/none", [](Settings& s) { s.features = std::vector<std::string>{}; });
  list.add("features/all", [](Settings& s) { s.features.reset(); });
}

void add_gammas(MethodCases& list) {
  for (const float gamma : {0.01F, 0.5F})
    list.add(fmt::format("gamma/{:g}", gamma), [&](Settings& s) { s.gamma = gamma; });
}

void add_shadows(MethodCases& list) {
  for (const float bandwidth : {1e-3F, 0.1F, 1e3F})
    list.add(fmt::format("bandwidth/{:g}", bandwidth), [&](Settings& s) { s.bandwidth = bandwidth; });
  const std::vector<std::vector<std::string>> features = {{"P", "penumbra"}, {"P", "penumbra", "N"}};
  for (const auto& groups : features)
    list.add(fmt::format("features/{}", fmt::join(groups, ",")), [&](Settings& s) { s.features = groups; });
  for (const auto& [slot, value] : {std::pair{"feature.penumbra.width", 1e15F},
                                    {"feature.penumbra.slope", -1.0F},
                                    {"feature.penumbra.width", 1e-42F},
                                    {"feature.albedo.R", 0.0F}}) {
    ConformanceCase c = list.basic();
    c.change = poison(slot, value, 3);
    list.add(fmt::format("extreme/{}{:g}", slot, value), c);
  }
  list.add("1spp", list.basic(1));
}

/// What the methods for noise of lens and time can meet; `slots` are those that they read.
void add_views(MethodCases& list, const std::vector<const char*>& scenes, const std::vector<const char*>& slots,
               const std::vector<float>& extremes) {
  for (const int views : {1, 130}) list.add(fmt::format("views/{}", views), [&](Settings& s) { s.views = views; });
  for (const char* scene : scenes) {
    ConformanceCase c = list.basic();
    c.scene = scene;
    list.add(fmt::format("scene/{}", scene), c);
  }
  for (const char* slot : slots)
    for (const float value : extremes) {
      ConformanceCase c = list.basic();
      c.change = poison(slot, value, 3);
      list.add(fmt::format("extreme/{}{:g}", slot, value), c);
    }
  for (const int samples : {1, 64}) list.add(count_name(samples), list.basic(samples));
}

void add_light_field(MethodCases& list) {
  add_views(list, {"dof", "motion", "dof-edge"},
            {"feature.P.X", "feature.P.Z", "feature.opening.Y", "feature.closing.Z", "random.time"},
            {std::numeric_limits<float>::quiet_NaN(), -1e3F, 1e30F});
}

void add_columns(MethodCases& list) {
  add_views(list, {"dof", "motion", "soft-shadow"}, {"random.lens.U", "random.lens.V", "random.time"},
            {std::numeric_limits<float>::quiet_NaN(), -1e3F, 1e30F, 3e38F});
}

void add_common_settings(MethodCases& list) {
  list.add("carried/features", [](Settings& s) { s.filter_features = true; });
  list.add("crop", [](Settings& s) { s.crop = Window{3, 5, 11, 7}; });
}

}  // namespace

void add_methods(CaseList& all) {
  for (const std::string& name : method_names()) {
    const Method method = method_settings(name).method;
    if (method == Method::rpf || method == Method::learned) continue;  // those have cases of their own
    MethodCases list(all, name);
    if (needs_whole_frame(method)) {
      add_pixel_frames(list);
      add_common_settings(list);
      if (method == Method::nlm) add_windows_of_patches(list);
      if (method == Method::gem) add_gammas(list);
      if (method == Method::sbf) add_feature_groups(list);
      if (method == Method::axis_aligned) add_shadows(list);
      if (method == Method::lightfield) add_light_field(list);
      if (method == Method::multidim) add_columns(list);
      continue;
    }
    add_method_frames(list);
    add_common_settings(list);
    if (method != Method::gaussian) add_colors(list);
    if (method == Method::cross_bilateral) {
      add_features(list);
      add_feature_groups(list);
    }
  }
}

}  // namespace rpf
