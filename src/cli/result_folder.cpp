#include "cli/result_folder.h"

#include <system_error>

#include "rpf/outputs.h"

namespace rpf::cli {

ResultFolder::ResultFolder(const std::filesystem::path& path) : path_(path) {
  std::error_code unknown;
  is_ours_ = !std::filesystem::exists(path, unknown);
  make_folder(path.string());
}

ResultFolder::~ResultFolder() {
  std::error_code ignored;
  if (is_ours_) std::filesystem::remove_all(path_, ignored);
}

}  // namespace rpf::cli
