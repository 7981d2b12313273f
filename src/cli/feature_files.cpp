#include "cli/feature_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/result_folder.h"
#include "rpf/error.h"
#include "rpf/io.h"

namespace rpf::cli {
namespace {

namespace fs = std::filesystem;

/// An existing folder, or a name that ends like one.
bool is_folder(const std::string& path) {
  std::error_code unknown;
  return fs::is_directory(path, unknown) || path.back() == '/';
}

/// The channels of one group, side by side in the image of all features.
struct GroupFile {
  std::string path;
  std::size_t first = 0;
  std::vector<std::string> channels;  ///< the components; Y where the group has none
};

std::vector<GroupFile> group_files(const std::string& folder, const std::vector<std::string>& channels) {
  std::vector<GroupFile> files;
  std::string group;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto dot = channels[c].find('.');
    if (files.empty() || channels[c].substr(0, dot) != group) {
      group = channels[c].substr(0, dot);
      if (group.find('/') != std::string::npos)
        throw Error(ErrorKind::input, fmt::format("--aov {}: the group of features \"{}\" is no name of a file; write "
                                                  "the features to one file, such as --aov features.exr",
                                                  folder, group));
      files.push_back({(fs::path(folder) / (group + ".exr")).string(), c, {}});
    }
    files.back().channels.push_back(dot == std::string::npos ? "Y" : channels[c].substr(dot + 1));
  }
  return files;
}

Image part_of(const Image& features, const GroupFile& file) {
  Image image;
  image.data_window = features.data_window;
  image.display_window = features.display_window;
  image.metadata = features.metadata;
  image.channels = file.channels;
  image.pixels.reserve(features.data_window.pixel_count() * file.channels.size());
  for (std::size_t p = 0; p < features.data_window.pixel_count(); ++p) {
    const float* first = features.pixel(p) + file.first;
    image.pixels.insert(image.pixels.end(), first, first + file.channels.size());
  }
  return image;
}

}  // namespace

std::vector<PlannedOutput> planned_features(const std::string& aov, const std::vector<std::string>& channels,
                                            const Window& window) {
  if (!is_folder(aov)) return {{aov, OutputKind::image, channels, window}};
  std::vector<PlannedOutput> outputs;
  for (const GroupFile& file : group_files(aov, channels))
    outputs.push_back({file.path, OutputKind::image, file.channels, window, false, true});
  return outputs;
}

void write_features(const std::string& aov, const Image& features) {
  if (!is_folder(aov)) return write_image(aov, features);
  ResultFolder folder(aov);
  for (const GroupFile& file : group_files(aov, features.channels)) write_image(file.path, part_of(features, file));
  folder.keep();
}

}  // namespace rpf::cli
