// The light field on the reference: view after view, each parallel over samples and then over rows.
#include "cpu/cpu_backend.h"
#include "plan/view_cells.h"

namespace rpf {

std::vector<float> CpuBackend::see_views(const LightField& light, const EstimateProgress& progress) {
  const kernel::rpf_light_field& field = light.field;
  const std::size_t samples = light.samples();
  std::vector<float> ends(samples * RPF_ENDS), places(samples * RPF_PLACE), sums(light.sums());
  Workers workers(threads_);
  const auto for_samples = [&](const auto& body) {
    constexpr std::size_t piece = 4096;
    workers.for_all(0, (samples + piece - 1) / piece, [&](std::size_t p, std::size_t /*worker*/) {
      for (std::size_t i = p * piece; i < std::min(samples, (p + 1) * piece); ++i)
        body(i, &light.tracks[i * RPF_TRACK]);
    });
  };
  ViewCells sorted(field);
  const kernel::rpf_view_sums to = {light.colors.data(), light.means.data(), sums.data(), light.pixels(), field.carried};
  for (const kernel::rpf_view& view : light.views) {
    for_samples([&](std::size_t i, const float* track) {
      kernel::rpf_move(track, &field.lens, &view, places.data() + i * RPF_PLACE, ends.data() + i * RPF_ENDS);
    });
    sorted.sort(places);
    const kernel::rpf_cells cells = {sorted.first().data(), sorted.places().data(), sorted.samples().data()};
    workers.for_all(0, static_cast<std::size_t>(field.height), [&](std::size_t y, std::size_t /*worker*/) {
      kernel::rpf_see_run(&field, &view, &cells, ends.data(), &to, static_cast<int>(y), 0, field.width);
    });
    progress(1.0 / static_cast<double>(light.views.size()));
  }
  return sums;
}

}  // namespace rpf
