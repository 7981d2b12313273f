// Stands in for Open Image Denoise, so that a test knows what comes out: half of the color, where it was asked for a
// picture of high dynamic range with albedo and normals of the same size; an error otherwise.
#include <cstddef>
#include <cstring>
#include <map>
#include <string>

namespace {

struct Filter {
  std::map<std::string, float*> images;
  std::size_t numbers = 0;
  bool hdr = false;
};

bool failed = false;

}  // namespace

extern "C" {

void* oidnNewDevice(int) { return &failed; }
void oidnCommitDevice(void*) {}
void oidnReleaseDevice(void*) {}
void* oidnNewFilter(void*, const char* type) { return std::strcmp(type, "RT") == 0 ? new Filter : nullptr; }
void oidnCommitFilter(void*) {}
void oidnReleaseFilter(void* filter) { delete static_cast<Filter*>(filter); }
void oidnSetFilterBool(void* filter, const char* name, bool value) {
  if (std::strcmp(name, "hdr") == 0) static_cast<Filter*>(filter)->hdr = value;
}

int oidnGetDeviceError(void*, const char** message) {
  *message = "incomplete";
  return failed ? 1 : 0;
}

void oidnSetSharedFilterImage(void* filter, const char* name, void* values, int format, std::size_t width,
                              std::size_t height, std::size_t, std::size_t, std::size_t) {
  auto& f = *static_cast<Filter*>(filter);
  f.images[name] = static_cast<float*>(values);
  if (format != 3 || (f.numbers != 0 && f.numbers != 3 * width * height)) failed = true;
  f.numbers = 3 * width * height;
}

void oidnExecuteFilter(void* filter) {
  auto& f = *static_cast<Filter*>(filter);
  for (const char* name : {"color", "albedo", "normal", "output"})
    if (f.images.count(name) == 0) failed = true;
  if (failed || !f.hdr) return;
  for (std::size_t i = 0; i < f.numbers; ++i) f.images["output"][i] = f.images["color"][i] / 2;
}

}  // extern "C"
