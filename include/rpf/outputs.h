// What is going to be written, decided before the work: all files of a command together.
#pragma once

#include <string>
#include <vector>

#include "rpf/image.h"

namespace rpf {

/// What a file will hold.
enum class OutputKind { image, samples, page };

/// A file that is going to be written.
struct PlannedOutput {
  std::string path;
  OutputKind kind = OutputKind::image;
  std::vector<std::string> channels = {"R", "G", "B"};  ///< of an image
  Window window = {};                                   ///< of an image; no size: not known yet
  bool may_be_input = false;                            ///< it is a new form of an input, so it may take its place
  bool makes_folder = false;                            ///< its folder is made when it is missing
};

/// Refuses what would fail or destroy something after the work. Throws Error(output) where a target cannot be written
/// (docs/file-format.md, "Files that are written"), where its extension is of no format or its format cannot hold the
/// channels or the size, or where the library of its format is missing; Error(usage) where two outputs are one file, a
/// page has the name of an image, or an output is an input that it must not replace. Leaves nothing.
void check_outputs(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs);

/// Throws Error(usage) where a crop is not inside the data window, so that it has nothing to write.
void check_crop(const Window& crop, const Window& data_window);

/// The same text for all paths that lead to one file, whether it exists or not.
std::string file_identity(const std::string& path);
inline bool is_same_file(const std::string& a, const std::string& b) { return file_identity(a) == file_identity(b); }

/// Throws Error(usage) where a file of text has the name of an image or of samples.
void check_text_name(const std::string& path);

/// For what is written to bit by bit. Throws Error(output) where the path is no regular file that may be written to,
/// and cannot become one.
void check_target(const std::string& path);

/// Bits of a value in an image with this name: 8, or 32 of a float. Throws Error(output) for an unknown extension.
int stored_bits(const std::string& path);

/// Whether an image with this name is OpenEXR, the only format that keeps windows and attributes.
bool is_openexr(const std::string& path);

/// Whether an image with this name can have an alpha. Throws Error(output) for an unknown extension.
bool stores_alpha(const std::string& path);

/// Makes a folder inside one that is there; nothing where it is there itself. Throws Error(output).
void make_folder(const std::string& path);

}  // namespace rpf
