// Which kind of sample file it is: by content when reading, by extension when writing.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "io/atomic_file.h"
#include "io/deep_reader.h"
#include "io/deep_writer.h"
#include "io/exr_structure.h"
#include "io/raw_files.h"
#include "io/raw_header.h"
#include "rpf/error.h"

namespace rpf {
namespace {

enum class Kind { deep_exr, raw };

Kind kind_of_target(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (extension == ".exr") return Kind::deep_exr;
  if (extension == ".rpf") return Kind::raw;
  throw Error(ErrorKind::output, fmt::format("\"{}\": samples are written to .exr (deep OpenEXR) or .rpf (raw floats), "
                                             "not to \"{}\"; choose one of them",
                                             path, extension));
}

}  // namespace

bool is_sample_file(const std::string& path) {
  io::FileBytes file(path);
  return io::is_raw(path) || io::is_deep_exr(file);
}

SampleFileInfo inspect_samples(const std::string& path, const SampleReadOptions& options) {
  return io::is_raw(path) ? io::inspect_raw(path, options) : io::inspect_deep(path, options);
}

SampleBuffer read_samples(const std::string& path, const SampleReadOptions& options) {
  return io::is_raw(path) ? io::read_raw(path, options) : io::read_deep(path, options);
}

void write_samples(const std::string& path, const SampleBuffer& samples, const std::vector<std::string>& half_slots) {
  if (kind_of_target(path) == Kind::raw)
    io::write_raw(path, samples);
  else
    io::write_deep(path, samples, half_slots);
}

void check_sample_target(const std::string& path) {
  const io::AtomicFile probe(path);  // made and removed: the surest answer to whether it can be
  kind_of_target(path);
}

}  // namespace rpf
