// Columns of pixels on the reference: point after point, each parallel over rows.
#include "cpu/cpu_backend.h"

namespace rpf {

std::vector<float> CpuBackend::integrate_columns(const PixelColumns& columns, const EstimateProgress& progress) {
  const SampleTree& tree = columns.tree;
  std::vector<float> sums(columns.sums());
  if (tree.leaves == 0) return sums;
  const kernel::rpf_sample_tree of = {tree.axis.data(),   tree.split.data(),   tree.first.data(),
                                      tree.places.data(), tree.samples.data(), columns.metrics.data()};
  const kernel::rpf_view_sums to = {columns.colors.data(), columns.means.data(), sums.data(), columns.pixels(),
                                    columns.shape.carried};
  Workers workers(threads_);
  for (const kernel::rpf_point& point : columns.points) {
    workers.for_all(0, static_cast<std::size_t>(columns.shape.height), [&](std::size_t y, std::size_t /*worker*/) {
      kernel::rpf_integrate_run(&columns.shape, &point, &of, &to, static_cast<int>(y), 0, columns.shape.width);
    });
    progress(1.0 / static_cast<double>(columns.points.size()));
  }
  return sums;
}

}  // namespace rpf
