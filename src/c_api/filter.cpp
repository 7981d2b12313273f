#include "rpf/filter.h"

#include <memory>

#include "c_api/objects.h"
#include "c_api/setting_names.h"

using rpf::c_api::guarded;
using rpf::c_api::require;

namespace {

rpf::Control control_of(rpf_progress_function* progress, void* user) {
  rpf::Control control;
  if (progress != nullptr)
    control.progress = [=](const rpf::Progress& p) { return progress(p.fraction, p.seconds_left, user) != 0; };
  return control;
}

}  // namespace

rpf_status rpf_filter(rpf_sample_buffer** buffer, const rpf_settings* settings, rpf_progress_function* progress,
                      void* user, rpf_image** image, rpf_image** features) {
  return guarded([&] {
    require(buffer, "rpf_filter: buffer");
    const std::unique_ptr<rpf_sample_buffer> taken(*buffer);
    *buffer = nullptr;
    require(taken.get(), "rpf_filter: buffer");
    require(image, "rpf_filter: image");
    *image = nullptr;
    if (features != nullptr) *features = nullptr;
    rpf::Result result = rpf::filter(std::move(taken->value),
                                     settings == nullptr ? rpf::c_api::settings_named("balanced") : settings->value,
                                     control_of(progress, user));
    auto filtered = std::make_unique<rpf_image>(rpf_image{std::move(result.image)});
    if (features != nullptr && !result.features.pixels.empty()) *features = new rpf_image{std::move(result.features)};
    *image = filtered.release();
  });
}
