// What the name of an output stands for: links, folders, devices, files that must not be replaced. Decided here for
// every writer.
#pragma once

#include <sys/stat.h>

#include <optional>
#include <string>

namespace rpf::io {

struct OutputPlace {
  std::string path;                ///< behind symbolic links; a rename onto it leaves the links as they are
  std::optional<struct stat> old;  ///< of the regular file that is there now

  /// The same text for all names of one file, whether it exists or not. Hard links are two files: a rename replaces one.
  std::string identity() const;
  bool is_same(const OutputPlace& other) const { return identity() == other.identity(); }
};

/// Follows `target`. Throws Error(usage) for an empty name, Error(output) for links in a circle and for what a result
/// must not or cannot replace: folders, devices, pipes, write-protected files, files that are mounted, files of others
/// in a sticky folder.
OutputPlace output_place(const std::string& target);

/// The same for an input: nothing about it is refused.
OutputPlace input_place(const std::string& path);

/// The folder of a path, "." where it names none.
std::string folder_of(const std::string& path);

/// Gives a new file the owner, group, rights and access list of the one that it replaces, as far as the system lets us.
/// Where the group cannot be kept, its rights are those of all others.
void take_over(int descriptor, const std::string& old_path, const struct stat& old);

}  // namespace rpf::io
