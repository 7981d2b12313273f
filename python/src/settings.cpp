#include "rpf/settings.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "arrays.h"
#include "bindings.h"
#include "rpf/devices.h"
#include "rpf/methods.h"
#include "rpf/presets.h"

namespace rpf::python {

using namespace nb::literals;

namespace {

void bind_published(nb::class_<Settings>& c) {
  c.def_rw("profile", &Settings::profile)
      .def_rw("box_widths", &Settings::box_widths, "Of each pass: odd, 1 to 255 pixels. Empty: the plain mean.")
      .def_rw("samples_factor", &Settings::samples_factor, nb::arg().none(), "M = samples_factor * b^2.")
      .def_rw("max_samples", &Settings::max_samples, "Upper limit of M; 0: none.")
      .def_rw("noise", &Settings::noise, "sigma_8^2: 0.02 for very noisy scenes, 0.002 otherwise.")
      .def_rw("bins", &Settings::bins, "Odd, 3 to 31.")
      .def_rw("drop_uninformative", &Settings::drop_uninformative)
      .def_rw("seed", &Settings::seed)
      .def_rw("alpha_factor", &Settings::alpha_factor)
      .def_rw("position_scale", &Settings::position_scale)
      .def_rw("redraws", &Settings::redraws, "0 to 15.")
      .def_rw("reject_second_hit", &Settings::reject_second_hit)
      .def_rw("bias_correction", &Settings::bias_correction)
      .def_rw("sigma_color", &Settings::sigma_color, "Linear radiance, over R, G and B together.")
      .def_rw("sigma_feature", &Settings::sigma_feature, "Standard deviations of a group over the frame.")
      .def_rw("damping", &Settings::damping, "Of nlm: larger takes patches for more alike.")
      .def_rw("gamma", &Settings::gamma, "Of gem: larger holds wide Gaussians back.")
      .def_rw("views", &Settings::views,
              "Of lightfield and multidim: places of lens and time that each pixel is seen from.")
      .def_rw("bandwidth", &Settings::bandwidth, "Of axis_aligned: larger makes filters narrower.")
      .def_rw("window", &Settings::window, "Of nlm: width of the box that neighbors come from, pixels.");
}

void bind_common(nb::class_<Settings>& c) {
  c.def(nb::init<>())
      .def(nb::init<const Settings&>(), "settings"_a, "A copy.")
      .def_rw("method", &Settings::method)
      .def_rw("model", &Settings::model, "Of Method.learned: the name of a network, or a network file.")
      .def_rw("backend", &Settings::backend, "auto, opencl or cpu.")
      .def_rw("device", &Settings::device, "OpenCL device: index or part of a name; empty: the first.")
      .def_rw("random", &Settings::random, nb::arg().none(), "Groups of random parameters; None: the default.")
      .def_rw("features", &Settings::features, nb::arg().none(), "Groups of features; None: all that there are.")
      .def_rw("clamp_negative", &Settings::clamp_negative)
      .def_rw("clamp_infinite", &Settings::clamp_infinite)
      .def_rw("filter_features", &Settings::filter_features, "Also filter the features: Image.features.")
      .def_rw("estimate_error", &Settings::estimate_error,
              "Also estimate the relative error of each pixel: channel error of Image.features. Twice the time.")
      .def_rw("threads", &Settings::threads, "0: all cores that this process may use.")
      .def_rw("max_memory", &Settings::max_memory, "Bytes; 0: no limit.")
      .def_prop_rw(
          "crop", [](const Settings& s) { return s.crop ? std::optional(tuple_of(*s.crop)) : std::nullopt; },
          [](Settings& s, const std::optional<WindowTuple>& crop) {
            s.crop = crop ? std::optional(window_of(*crop)) : std::nullopt;
          },
          nb::for_setter(nb::arg("crop").none()), "x, y, width, height of the part to filter; None: all.");
}

std::vector<std::pair<std::string, std::string>> preset_purposes() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const PresetInfo& preset : presets()) all.emplace_back(preset.name, preset.purpose);
  return all;
}

void bind_devices(nb::module_& module) {
  nb::class_<DeviceInfo>(module, "DeviceInfo", "An OpenCL device.")
      .def_ro("index", &DeviceInfo::index, "What Settings.device accepts, beside a part of the name.")
      .def_ro("platform", &DeviceInfo::platform)
      .def_ro("name", &DeviceInfo::name)
      .def_ro("driver", &DeviceInfo::driver)
      .def_ro("version", &DeviceInfo::version)
      .def_ro("type", &DeviceInfo::type, "cpu, gpu, accelerator or other.")
      .def_ro("compute_units", &DeviceInfo::compute_units)
      .def_ro("memory", &DeviceInfo::memory, "Bytes.")
      .def("__repr__", [](const DeviceInfo& d) { return "rpf.DeviceInfo(" + d.name + ", " + d.type + ")"; });
  module.def(
      "devices",
      [] {
        const nb::gil_scoped_release free_python;
        return devices();
      },
      "All OpenCL devices; empty where there is none. Raises DeviceError.");
}

}  // namespace

void bind_settings(nb::module_& module) {
  nb::enum_<Profile>(module, "Profile", "Random Parameter Filtering as published.")
      .value("thesis", Profile::thesis)
      .value("paper", Profile::paper);
  nb::enum_<Method>(module, "Method", "Where weights come from.")
      .value("rpf", Method::rpf)
      .value("gaussian", Method::gaussian)
      .value("bilateral", Method::bilateral)
      .value("cross_bilateral", Method::cross_bilateral)
      .value("learned", Method::learned)
      .value("nlm", Method::nlm)
      .value("gem", Method::gem)
      .value("sbf", Method::sbf)
      .value("axis_aligned", Method::axis_aligned)
      .value("lightfield", Method::lightfield)
      .value("multidim", Method::multidim);
  auto c = nb::class_<Settings>(module, "Settings",
                                "Everything that can be chosen; each is an option of the command with the same name "
                                "(docs/commands.md). Settings() is the published algorithm.");
  bind_common(c);
  bind_published(c);
  module.def("presets", &preset_purposes, "(name, purpose) of each preset, from the fastest to the most accurate.");
  module.def("preset_settings", &preset_settings, "name"_a, "The settings of a preset. Raises UsageError.");
  module.def("method_settings", &method_settings, "name"_a, "The settings of a method. Raises UsageError.");
  bind_devices(module);
}

}  // namespace rpf::python
