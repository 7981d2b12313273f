#include "io/image_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "parts/parts.h"
#include "rpf/error.h"

namespace rpf::io {
namespace {

/// The library stays loaded: 250 libraries do not unload cleanly.
const ImageLibrary& load(ErrorKind kind, const std::string& path) {
  void* library = nullptr;
  for (const std::string& place : places_of_part(RPF_IMAGES_NAME))
    if (library == nullptr) library = dlopen(place.c_str(), RTLD_LAZY);
  const void* symbol = library == nullptr ? nullptr : dlsym(library, "rpf_image_library");
  if (symbol != nullptr) return *static_cast<const ImageLibrary*>(symbol);
  throw Error(kind,
              fmt::format("\"{}\" cannot be {}: reading images, and writing others than .exr, needs " RPF_IMAGES_NAME
                          " beside the program ({}); put it there{}",
                          path, kind == ErrorKind::output ? "written" : "read", dlerror(),
                          kind == ErrorKind::output ? " or write an .exr file" : ""));
}

}  // namespace

const ImageLibrary& image_library(ErrorKind kind, const std::string& path) {
  static const ImageLibrary& library = load(kind, path);
  return library;
}

}  // namespace rpf::io
