#include "rpf/filter.h"

#include <memory>

#include "c_api/objects.h"
#include "rpf/presets.h"

using rpf::c_api::guarded;
using rpf::c_api::require;

namespace {

rpf::Settings settings_or_default(const rpf_settings* settings) {
  if (settings != nullptr) return settings->value;
  rpf::Settings named = rpf::preset_settings("balanced");
  named.backend = "auto";
  return named;
}

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
    rpf::Result result =
        rpf::filter(std::move(taken->value), settings_or_default(settings), control_of(progress, user));
    auto filtered = std::make_unique<rpf_image>(rpf_image{std::move(result.image)});
    if (features != nullptr && !result.features.pixels.empty()) *features = new rpf_image{std::move(result.features)};
    *image = filtered.release();
  });
}
