// Output files that are whole or untouched: written beside the target under a hidden name, synced, then renamed.
#pragma once

#include <string>

#include "io/output_place.h"

namespace rpf::io {

class AtomicFile {
 public:
  /// Makes the hidden file (hidden_files.h) in the target's folder, behind symbolic links, so the links stay. Throws as
  /// output_place() does, and Error(output) where the folder is missing or cannot be written to. Removes hidden files
  /// in that folder that nobody will finish.
  explicit AtomicFile(const std::string& target);
  /// Removes the temporary file unless it was committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporary_path() const { return temporary_; }
  const OutputPlace& place() const { return place_; }
  int descriptor() const { return descriptor_; }

  /// Syncs the temporary file, gives it the rights of the file that it replaces, renames it to the target and syncs the
  /// folder. Throws Error(output).
  void commit();

 private:
  void make();
  void close();
  [[noreturn]] void fail(int error_number) const;

  std::string target_;  ///< as given, for errors
  OutputPlace place_;
  std::string temporary_;
  int descriptor_ = -1;
};

}  // namespace rpf::io
