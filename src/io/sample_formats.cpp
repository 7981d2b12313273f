#include "io/sample_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "rpf/error.h"

namespace rpf::io {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

SampleFormat sample_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".exr") return SampleFormat::deep_exr;
  if (extension == ".rpf") return SampleFormat::raw;
  throw Error(ErrorKind::output, fmt::format("\"{}\": samples are written to .exr (deep OpenEXR) or .rpf (raw floats), "
                                             "not to \"{}\"; choose one of them",
                                             path, extension));
}

}  // namespace rpf::io
