#include "io/image_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "rpf/error.h"

namespace rpf::io {
namespace {

/// The library stays loaded: 250 libraries do not unload cleanly.
const ImageLibrary& load() {
  void* library = dlopen("$ORIGIN/" RPF_IMAGES_NAME, RTLD_LAZY);
  if (library == nullptr) library = dlopen(RPF_IMAGES_FILE, RTLD_LAZY);
  const void* symbol = library == nullptr ? nullptr : dlsym(library, "rpf_image_library");
  if (symbol != nullptr) return *static_cast<const ImageLibrary*>(symbol);
  throw Error(ErrorKind::internal, fmt::format("reading images, and writing others than .exr, needs " RPF_IMAGES_NAME
                                               " beside the program ({}); put it there",
                                               dlerror()));
}

}  // namespace

const ImageLibrary& image_library() {
  static const ImageLibrary& library = load();
  return library;
}

}  // namespace rpf::io
