// The compiled part of the Python package: the public C++ API, with arrays over its memory (docs/python.md).
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <exception>

#include "bindings.h"
#include "rpf/error.h"
#include "rpf/version.h"

namespace rpf::python {

namespace nb = nanobind;

/// rpf.errors has a class for each kind; it knows which.
void bind_errors(nb::module_& /*module*/) {
  nb::register_exception_translator([](const std::exception_ptr& failure, void* /*unused*/) {
    try {
      std::rethrow_exception(failure);
    } catch (const Error& error) {
      const nb::object type = nb::module_::import_("rpf.errors").attr("error_of_kind")(static_cast<int>(error.kind()));
      PyErr_SetString(type.ptr(), error.what());
    }
  });
}

}  // namespace rpf::python

NB_MODULE(_core, module) {
  using namespace rpf::python;
  module.def("version", &rpf::version, "Version of the library, as `rpf --version` prints it.");
  bind_errors(module);
  bind_samples(module);
  bind_report(module);
  bind_image(module);
  bind_settings(module);
  bind_filter(module);
  bind_explain(module);
}
