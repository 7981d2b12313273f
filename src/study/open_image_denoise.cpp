#include "study/open_image_denoise.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <numeric>

#include "rpf/error.h"

namespace rpf::study {
namespace {

// What its C interface says, in versions 1 and 2; with the header the study would not build without the library.
using Device = void*;
using Filter = void*;
constexpr int processor = 1, float3 = 3;

struct Library {
  Device (*new_device)(int type) = nullptr;
  void (*commit_device)(Device) = nullptr;
  int (*device_error)(Device, const char** message) = nullptr;
  void (*release_device)(Device) = nullptr;
  Filter (*new_filter)(Device, const char* type) = nullptr;
  void (*set_image)(Filter, const char* name, void* values, int format, std::size_t width, std::size_t height,
                    std::size_t offset, std::size_t pixel_stride, std::size_t row_stride) = nullptr;
  void (*set_switch)(Filter, const char* name, bool value) = nullptr;
  void (*commit_filter)(Filter) = nullptr;
  void (*execute_filter)(Filter) = nullptr;
  void (*release_filter)(Filter) = nullptr;
  bool complete = false;
};

template <class Function>
bool load(void* library, Function& function, const char* name) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

/// It stays loaded.
Library load_library() {
  Library l;
  void* library = nullptr;
  for (const char* name : {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1"})
    if (library == nullptr) library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return l;
  l.complete =
      load(library, l.new_device, "oidnNewDevice") && load(library, l.commit_device, "oidnCommitDevice") &&
      load(library, l.device_error, "oidnGetDeviceError") && load(library, l.release_device, "oidnReleaseDevice") &&
      load(library, l.new_filter, "oidnNewFilter") && load(library, l.set_image, "oidnSetSharedFilterImage") &&
      (load(library, l.set_switch, "oidnSetFilterBool") || load(library, l.set_switch, "oidnSetFilter1b")) &&
      load(library, l.commit_filter, "oidnCommitFilter") && load(library, l.execute_filter, "oidnExecuteFilter") &&
      load(library, l.release_filter, "oidnReleaseFilter");
  return l;
}

const Library& library() {
  static const Library loaded = load_library();
  return loaded;
}

/// Three channels of an image, side by side; nothing where it does not have them.
std::vector<float> channels_of(const Image& image, const std::array<const char*, 3>& names) {
  std::array<std::size_t, 3> columns{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto column = image.find(names.at(c));
    if (!column) return {};
    columns.at(c) = *column;
  }
  std::vector<float> values;
  for (std::size_t p = 0; p < image.data_window.pixel_count(); ++p)
    for (const std::size_t column : columns) values.push_back(image.pixel(p)[column]);
  return values;
}

/// Images of one size, by what the library calls them.
void execute(const std::vector<std::pair<const char*, std::vector<float>*>>& images, const Window& window) {
  const Library& l = library();
  auto* const device = l.new_device(processor);
  l.commit_device(device);
  auto* const filter = l.new_filter(device, "RT");
  for (const auto& [name, values] : images)
    if (!values->empty())
      l.set_image(filter, name, values->data(), float3, static_cast<std::size_t>(window.width),
                  static_cast<std::size_t>(window.height), 0, 0, 0);
  l.set_switch(filter, "hdr", true);
  l.commit_filter(filter);
  l.execute_filter(filter);
  const char* message = "";
  const std::string failure = l.device_error(device, &message) == 0 ? "" : message;
  l.release_filter(filter);
  l.release_device(device);
  if (!failure.empty()) throw Error(ErrorKind::device, fmt::format("Open Image Denoise: {}", failure));
}

}  // namespace

bool has_open_image_denoise() { return library().complete; }

Result open_image_denoise(SampleBuffer samples) {
  if (!has_open_image_denoise())
    throw Error(ErrorKind::device,
                "Open Image Denoise cannot be loaded; install it, or name its folder in LD_LIBRARY_PATH");
  Settings means;
  means.box_widths = {};
  means.filter_features = true;
  Result mean = filter(std::move(samples), means);
  std::vector<float> color = channels_of(mean.image, {"R", "G", "B"}), output(color.size());
  std::vector<float> albedo = channels_of(mean.features, {"albedo.R", "albedo.G", "albedo.B"});
  std::vector<float> normal = channels_of(mean.features, {"N.X", "N.Y", "N.Z"});
  if (albedo.empty()) normal.clear();  // it takes normals with albedo only
  execute({{"color", &color}, {"albedo", &albedo}, {"normal", &normal}, {"output", &output}}, mean.image.data_window);
  Result result;
  result.image = mean.image;
  result.image.channels = {"R", "G", "B"};
  PassReport report;
  report.energy = std::accumulate(output.begin(), output.end(), 0.0) / std::accumulate(color.begin(), color.end(), 0.0);
  result.report.passes.push_back(report);
  result.image.pixels = std::move(output);
  return result;
}

}  // namespace rpf::study
