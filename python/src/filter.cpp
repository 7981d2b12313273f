#include "rpf/filter.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <exception>

#include "bindings.h"
#include "rpf/explain.h"
#include "rpf/rows.h"

namespace rpf::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

/// Signals and the caller's own progress, looked at between tiles. What either raises ends the run and is raised after
/// it.
class Watch {
 public:
  explicit Watch(nb::object tell) : tell_(std::move(tell)) {}

  Control control() {
    Control control;
    control.progress = [this](const Progress& progress) { return goes_on(progress); };
    return control;
  }
  void raise() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  bool goes_on(const Progress& progress) {
    const nb::gil_scoped_acquire python;
    try {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      return tell_.is_none() || !tell_(progress).is(nb::handle(Py_False));
    } catch (...) {
      raised_ = std::current_exception();
      return false;
    }
  }

  nb::object tell_;
  std::exception_ptr raised_;
};

/// Runs what takes long without Python's lock.
template <class Work>
auto watched(const nb::object& tell, const Work& work) {
  Watch watch(tell);
  try {
    const nb::gil_scoped_release free_python;
    return work(watch.control());
  } catch (...) {
    watch.raise();
    throw;
  }
}

Picture run_filter(Samples& samples, const Settings& settings, bool keep, const nb::object& progress) {
  Result result =
      watched(progress, [&](const Control& control) { return filter(samples.release(keep), settings, control); });
  Picture picture{std::make_shared<Image>(std::move(result.image)), std::move(result.report)};
  if (settings.filter_features || settings.estimate_error) picture.features = std::make_shared<Image>(std::move(result.features));
  return picture;
}

struct ExplainedFrame {
  Picture layers;
  std::vector<std::string> groups;
};

ExplainedFrame run_explain(Samples& samples, const Settings& settings, bool keep, const nb::object& progress) {
  Explanation all =
      watched(progress, [&](const Control& control) { return explain(samples.release(keep), settings, control); });
  return {{std::make_shared<Image>(std::move(all.layers)), std::move(all.report)}, std::move(all.groups)};
}

void convert(const std::filesystem::path& source, const std::filesystem::path& target) {
  const auto rows = open_sample_rows(source.string());
  watched(nb::none(), [&](const Control& control) {
    write_sample_rows(target.string(), *rows, rows->frame().half_slots, control);
    return true;
  });
}

}  // namespace

void bind_filter(nb::module_& module) {
  module.def("run_filter", &run_filter, "samples"_a, "settings"_a, "keep"_a, "progress"_a.none());
  module.def(
      "convert", &convert, "source"_a, "target"_a,
      "Writes a sample file as another: .exr is deep OpenEXR, .rpf raw floats. A few MB of memory, however large the "
      "file is. Raises InputError, OutputError.");
  module.def("available_memory", &available_memory, "Bytes that this process can have.");
  module.def(
      "needed_slots", [](const std::vector<std::string>& slots, const Settings& s) { return needed_slots({slots}, s); },
      "slots"_a, "settings"_a, "Those of the slots that filter() uses; without the others the bits are the same.");
}

void bind_explain(nb::module_& module) {
  nb::class_<ExplainedFrame>(module, "Explanation", "What the filter thinks of a frame (docs/explain.md).")
      .def_ro("layers", &ExplainedFrame::layers, "An Image over the data window, a channel for each layer.")
      .def_ro("groups", &ExplainedFrame::groups, "Groups of random parameters, those of the channels share.*");
  module.def("run_explain", &run_explain, "samples"_a, "settings"_a, "keep"_a, "progress"_a.none());
  module.def("explain_settings", &explain_settings, "One pass, of box width 21 with M = b^2 s / 2.");
}

}  // namespace rpf::python
