// The light field on a device: for every view its samples are moved there, sorted here, and looked at there.
#include <algorithm>

#include "opencl/opencl_backend.h"
#include "plan/view_cells.h"

namespace rpf {
namespace {

constexpr const char* file = "views.cl";

/// Pixels that an item looks from before it is waited for: some tenths of a second.
constexpr double pixels_at_once = 1e5;

/// A light field on a device.
class DeviceViews {
 public:
  DeviceViews(Session& session, const LightField& light, std::size_t items)
      : session_(session), light_(light), items_(items), sorted_(light.field) {
    places_.resize(light.samples() * RPF_PLACE);
    sums_.resize(light.sums());
    const cl::Program& program = session.program(file, "");
    move_ = cl::Kernel(program, "move_samples");
    see_ = cl::Kernel(program, "see_rows");
    tracks_ = session.input(light.tracks);
    place_buffer_ = session.host_buffer(places_.data(), places_.size() * sizeof(float), CL_MEM_READ_WRITE);
    sum_buffer_ = session.host_buffer(sums_.data(), sums_.size() * sizeof(float), CL_MEM_READ_WRITE);
    ends_ = session.buffer(std::max<std::size_t>(light.samples(), 1) * RPF_ENDS * sizeof(float));
    see_.setArg(0, light.field);
    see_.setArg(5, ends_);
    see_.setArg(6, colors_ = session.input(light.colors));
    see_.setArg(7, means_ = session.input(light.means));
    see_.setArg(8, sum_buffer_);
    move_.setArg(0, tracks_);
    move_.setArg(1, light.field.lens);
    move_.setArg(3, place_buffer_);
    move_.setArg(4, ends_);
    move_.setArg(5, static_cast<cl_uint>(light.samples()));
  }

  /// Where the samples stand in a view, here.
  const std::vector<float>& move(const kernel::rpf_view& view) {
    move_.setArg(2, view);
    session_.launch(move_, items_, 1);
    session_.read_back(place_buffer_, 0, places_.size() * sizeof(float), places_.data());
    return places_;
  }

  void see(const kernel::rpf_view& view, const std::function<void(double part)>& progress) {
    sorted_.sort(move(view));
    const cl::Buffer first = session_.input(sorted_.first()), place = session_.input(sorted_.places()),
                     sample = session_.input(sorted_.samples());
    see_.setArg(1, view);
    see_.setArg(2, first);
    see_.setArg(3, place);
    see_.setArg(4, sample);
    const int rows = std::max(1, static_cast<int>(pixels_at_once * static_cast<double>(items_) / light_.field.width));
    for (int row = 0; row < light_.field.height; row += rows) {
      const int end = std::min(row + rows, light_.field.height);
      see_.setArg(9, row);
      see_.setArg(10, end);
      session_.launch(see_, items_, 1);
      progress(static_cast<double>(end - row) / light_.field.height);
    }
  }

  std::vector<float> take_sums() {
    session_.read_back(sum_buffer_, 0, sums_.size() * sizeof(float), sums_.data());
    return std::move(sums_);
  }

 private:
  Session& session_;
  const LightField& light_;
  std::size_t items_;
  ViewCells sorted_;
  std::vector<float> places_, sums_;
  cl::Kernel move_, see_;
  cl::Buffer tracks_, ends_, colors_, means_, place_buffer_, sum_buffer_;
};

}  // namespace

void OpenClBackend::get_ready_views(const std::function<void()>& check) {
  on_device("compiling", [&] { session_.rehearse(file, "", "", check); });
}

std::vector<float> OpenClBackend::see_views(const LightField& light, const EstimateProgress& progress) {
  return on_device("filtering", [&] {
    DeviceViews device(session_, light, items_);
    const double part = 1.0 / static_cast<double>(light.views.size());
    for (const kernel::rpf_view& view : light.views)
      device.see(view, [&](double of_view) { progress(part * of_view); });
    return device.take_sums();
  });
}

}  // namespace rpf
