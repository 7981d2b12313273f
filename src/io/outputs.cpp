#include "rpf/outputs.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/atomic_file.h"
#include "io/image_formats.h"
#include "io/image_library.h"
#include "io/sample_formats.h"
#include "rpf/error.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;

void check_image_format(const PlannedOutput& output) {
  const io::ImageFormat& format = io::format_of(output.path);
  io::columns_of(output.path, format, output.channels);
  io::check_size(output.path, format, output.window);
  if (format.library) io::image_library(ErrorKind::output, output.path);
}

void check_format(const PlannedOutput& output) {
  if (output.kind == OutputKind::image) check_image_format(output);
  if (output.kind == OutputKind::samples) io::sample_format_of(output.path);
  if (output.kind == OutputKind::page) check_text_name(output.path);
}

/// Where a file can be made before the work: in the folder, or where that will be made.
std::string probed_path(const PlannedOutput& output) {
  const std::string folder = io::folder_of(output.path);
  std::error_code unknown;
  if (!output.makes_folder || fs::exists(folder, unknown)) return output.path;
  return (fs::path(io::folder_of(folder)) / fs::path(output.path).filename()).string();
}

/// Made and removed: the surest answer to whether it can be.
io::OutputPlace probe(const PlannedOutput& output) {
  io::OutputPlace place = io::AtomicFile(probed_path(output)).place();
  if (probed_path(output) != output.path) place = {output.path, std::nullopt};
  return place;
}

void check_input(const PlannedOutput& output, const io::OutputPlace& place, const std::string& input) {
  if (output.may_be_input || !place.is_same(io::input_place(input))) return;
  throw Error(ErrorKind::usage, fmt::format("\"{}\" is the input \"{}\", which would be lost; name another file to "
                                            "write",
                                            output.path, input));
}

}  // namespace

void check_outputs(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs) {
  std::vector<io::OutputPlace> places;
  for (const PlannedOutput& output : outputs) {
    places.push_back(probe(output));
    for (const std::string& input : inputs) check_input(output, places.back(), input);
    check_format(output);
    for (std::size_t other = 0; other + 1 < places.size(); ++other)
      if (places[other].is_same(places.back()))
        throw Error(ErrorKind::usage, fmt::format("\"{}\" and \"{}\" are one file, and two results are to be written; "
                                                  "name two files",
                                                  outputs[other].path, output.path));
  }
}

std::string file_identity(const std::string& path) { return io::input_place(path).identity(); }

void check_text_name(const std::string& path) {
  if (io::find_format(path) == nullptr && io::extension_of(path) != ".rpf") return;
  throw Error(ErrorKind::usage,
              fmt::format("\"{}\" has the name of an image or of samples, but text would be written to "
                          "it; name a page .html, facts .json, a log .jsonl",
                          path));
}

void check_target(const std::string& path) {
  if (io::output_place(path).old) return;
  const io::AtomicFile made_and_removed(path);
}

int stored_bits(const std::string& path) { return io::format_of(path).encoding == io::Encoding::srgb_bytes ? 8 : 32; }

bool is_openexr(const std::string& path) { return io::extension_of(path) == ".exr"; }

bool stores_alpha(const std::string& path) { return io::format_of(path).alpha; }

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directory((fs::path(path) / "").parent_path(), error);
  if (error)
    throw Error(ErrorKind::output,
                fmt::format("\"{}\" cannot be made ({}); name another folder", path, error.message()));
}

}  // namespace rpf
