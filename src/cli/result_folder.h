// A folder of results appears with all of them or not at all, where nothing was there before.
#pragma once

#include <filesystem>

namespace rpf::cli {

/// Makes a folder inside one that is there, and removes it with all in it unless keep() was called. One that was there
/// before stays as it is, with what was written into it.
class ResultFolder {
 public:
  /// Throws Error(output) where the folder cannot be made.
  explicit ResultFolder(const std::filesystem::path& path);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  void keep() { is_ours_ = false; }

 private:
  std::filesystem::path path_;
  bool is_ours_;  ///< to remove
};

}  // namespace rpf::cli
