// Output files that are whole or untouched: written beside the target under a hidden name, synced, then renamed.
#pragma once

#include <string>

namespace rpf::io {

class AtomicFile {
 public:
  /// Makes the temporary file ".rpf-<pid>-<n><extension>" in the target's folder. A symbolic link is followed, so the
  /// link stays. Throws Error(output) where the folder is missing or cannot be written to, or where the target exists
  /// and is no regular file: renaming onto /dev/null would replace the device. Removes temporary files in that folder
  /// that killed processes left.
  explicit AtomicFile(const std::string& target);
  /// Removes the temporary file unless it was committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporary_path() const { return temporary_; }
  int descriptor() const { return descriptor_; }

  /// Syncs the temporary file, renames it to the target and syncs the folder. Throws Error(output).
  void commit();

 private:
  void close();

  std::string target_;  ///< as given, for errors
  std::string place_;   ///< the target behind symbolic links
  std::string temporary_;
  int descriptor_ = -1;
};

}  // namespace rpf::io
