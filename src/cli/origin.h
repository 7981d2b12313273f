// What an image was made from and how, as attributes of its file, so that a sequence that is run again does only what
// is missing.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "rpf/image.h"
#include "rpf/settings.h"

namespace rpf::cli {

/// Hashes as 16 hexadecimal digits: of the input's bytes; of everything chosen that changes the picture, and of what
/// chose it, the version of this program.
struct Origin {
  std::string input, settings;
};

/// The attributes that they stand in.
constexpr const char *input_attribute = "rpf:inputHash", *settings_attribute = "rpf:settingsHash";

/// Of a text.
std::string hash_of_text(const std::string& text);

/// Throws Error(input) where it cannot be read.
std::string hash_of_file(const std::string& path);

/// `map`: --map, which decides what is read.
std::string hash_of_settings(const Settings& settings, const std::vector<std::string>& map);

/// What a process that reads only some rows can tell of a file: its size, and a hash of that and of what stands at both
/// of its ends. Throws Error(input) where it cannot be read.
std::string hash_of_ends(const std::string& path);

/// Writes them into their attributes.
void mark(Image& image, const Origin& origin);

/// Whether a whole image is there that was made from this input with these settings, and that `is_wanted`. Formats that
/// hold no attributes cannot tell, so theirs is always made again.
bool is_made(const std::string& path, const Origin& origin, const std::function<bool(const Image&)>& is_wanted);

}  // namespace rpf::cli
