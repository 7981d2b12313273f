// The parts of the module rpf._core.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>
#include <optional>

#include "rpf/filter.h"
#include "rpf/image.h"
#include "rpf/samples.h"

namespace rpf::python {

/// rpf.Samples. The buffer is shared with the arrays that look into it; none: it was handed over.
struct Samples {
  std::shared_ptr<SampleBuffer> buffer;

  const SampleBuffer& get() const;
  /// A buffer to work in: this one, where `keep` is false and no array looks into it, else a copy.
  SampleBuffer release(bool keep);
};

/// rpf.Image, shared with the arrays that look into it, and what filter() tells beside it.
struct Picture {
  std::shared_ptr<Image> image;
  std::optional<Report> report = {};
  std::shared_ptr<Image> features = {};
};

void bind_errors(nanobind::module_& module);
void bind_samples(nanobind::module_& module);
void bind_image(nanobind::module_& module);
void bind_settings(nanobind::module_& module);
void bind_report(nanobind::module_& module);
void bind_filter(nanobind::module_& module);
void bind_explain(nanobind::module_& module);

}  // namespace rpf::python
