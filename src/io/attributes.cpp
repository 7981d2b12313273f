#include "io/attributes.h"

#include <array>
#include <set>

namespace rpf::io {
namespace {

// The names differ in the file (left) and in an OIIO::ImageSpec (right).
struct Renamed {
  const char* exr;
  const char* oiio;
};

constexpr std::array<Renamed, 4> renamed = {{{"capDate", "DateTime"},
                                             {"comments", "ImageDescription"},
                                             {"owner", "Copyright"},
                                             {"pixelAspectRatio", "PixelAspectRatio"}}};

}  // namespace

bool is_structural(const std::string& attribute) {
  // The marker and its version are structural too: a picture made from samples is no sample file.
  static const std::set<std::string> names = {
      "channels",          "chunkCount", "compression", "dataWindow",     "displayWindow",
      "lineOrder",         "name",       "tiles",       "type",           "version",
      "preview",           "view",       "multiView",   format_attribute, version_attribute,
      "maxSamplesPerPixel"};
  return names.count(attribute) != 0;
}

std::string oiio_name(const std::string& exr_name) {
  for (const Renamed& pair : renamed)
    if (exr_name == pair.exr) return pair.oiio;
  return exr_name;
}

std::string exr_name(const std::string& oiio_name) {
  for (const Renamed& pair : renamed)
    if (oiio_name == pair.oiio) return pair.exr;
  return oiio_name;
}

}  // namespace rpf::io
