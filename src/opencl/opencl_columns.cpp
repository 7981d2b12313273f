// Columns of pixels on a device: point after point, some rows at a time.
#include <algorithm>

#include "opencl/opencl_backend.h"

namespace rpf {
namespace {

constexpr const char* file = "nearest.cl";

/// Pixels whose points an item looks up before it is waited for: some tenths of a second.
constexpr double pixels_at_once = 5e4;

}  // namespace

void OpenClBackend::get_ready_columns(const std::function<void()>& check) {
  on_device("compiling", [&] { session_.rehearse(file, "", "", check); });
}

std::vector<float> OpenClBackend::integrate_columns(const PixelColumns& columns, const EstimateProgress& progress) {
  std::vector<float> sums(columns.sums());
  const SampleTree& tree = columns.tree;
  if (tree.leaves == 0) return sums;
  return on_device("filtering", [&] {
    const cl::Buffer sum_buffer = session_.host_buffer(sums.data(), sums.size() * sizeof(float), CL_MEM_READ_WRITE);
    const cl::Buffer inputs[] = {session_.input(tree.axis),      session_.input(tree.split),
                                 session_.input(tree.first),     session_.input(tree.places),
                                 session_.input(tree.samples),   session_.input(columns.metrics),
                                 session_.input(columns.colors), session_.input(columns.means)};
    cl::Kernel kernel(session_.program(file, ""), "integrate_rows");
    kernel.setArg(0, columns.shape);
    cl_uint argument = 2;
    for (const cl::Buffer& input : inputs) kernel.setArg(argument++, input);
    kernel.setArg(argument++, sum_buffer);
    const int height = columns.shape.height;
    const int rows = std::max(1, static_cast<int>(pixels_at_once * static_cast<double>(items_) / columns.shape.width));
    for (const kernel::rpf_point& point : columns.points) {
      kernel.setArg(1, point);
      for (int row = 0; row < height; row += rows) {
        const int end = std::min(row + rows, height);
        kernel.setArg(argument, row);
        kernel.setArg(argument + 1, end);
        session_.launch(kernel, items_, 1);
        progress(static_cast<double>(end - row) / height / static_cast<double>(columns.points.size()));
      }
    }
    session_.read_back(sum_buffer, 0, sums.size() * sizeof(float), sums.data());
    return std::move(sums);
  });
}

}  // namespace rpf
