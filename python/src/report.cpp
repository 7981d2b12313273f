#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "rpf/filter.h"

namespace rpf::python {

namespace nb = nanobind;

void bind_report(nb::module_& module) {
  nb::class_<InputNote>(module, "InputNote", "What was found in the input, and how it was treated.")
      .def_ro("what", &InputNote::what)
      .def_ro("count", &InputNote::count)
      .def_ro("x", &InputNote::x, "Pixel of the first one, as the data window counts.")
      .def_ro("y", &InputNote::y)
      .def("__repr__",
           [](const InputNote& n) { return "rpf.InputNote(" + std::to_string(n.count) + " " + n.what + ")"; });
  nb::class_<PassReport>(module, "PassReport", "Means over the filtered pixels that have samples.")
      .def_ro("box_width", &PassReport::box_width)
      .def_ro("neighbors", &PassReport::neighbors)
      .def_ro("acceptance", &PassReport::acceptance)
      .def_ro("fraction_random", &PassReport::fraction_random)
      .def_ro("alpha", &PassReport::alpha)
      .def_ro("beta", &PassReport::beta)
      .def_ro("energy", &PassReport::energy, "Sum of the image / sum of the plain mean of the samples.")
      .def_ro("seconds", &PassReport::seconds);
  nb::class_<Report>(module, "Report", "What filter() found and did.")
      .def_ro("backend", &Report::backend, "That ran, with its device; for auto why.")
      .def_ro("model", &Report::model, "Name of the network of a learned estimate.")
      .def_ro("model_hash", &Report::model_hash)
      .def_ro("random", &Report::random)
      .def_ro("features", &Report::features)
      .def_ro("dropped", &Report::dropped, "Channels that are constant over the frame.")
      .def_ro("uninformative", &Report::uninformative)
      .def_ro("notes", &Report::notes)
      .def_ro("passes", &Report::passes)
      .def_ro("seconds", &Report::seconds, "Wall time.");
  nb::class_<Progress>(module, "Progress", "How far a run is.")
      .def_ro("pass_", &Progress::pass, "0 is the first.")
      .def_ro("passes", &Progress::passes)
      .def_ro("compiling", &Progress::compiling, "Kernels are compiled just now.")
      .def_ro("fraction", &Progress::fraction, "Of the whole work, 0 to 1.")
      .def_ro("seconds", &Progress::seconds, "Since the start.")
      .def_ro("seconds_left", &Progress::seconds_left, "Negative while there is no estimate yet.");
}

}  // namespace rpf::python
