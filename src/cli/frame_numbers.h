// Which frames of a sequence, and what their files are called.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rpf::cli {

/// "1-100x2,105,47": the numbers in the order they are named, each once. Throws Error(usage) that says what is
/// expected.
std::vector<int> frame_numbers(const std::string& text);

/// The i-th of n parts of the frames, of "i/n": parts follow each other, and their sizes differ by one at most. Throws
/// Error(usage).
std::vector<int> chunk_of(const std::vector<int>& frames, const std::string& text);

/// "in.####.exr" or "in.%04d.exr": a name with the place of a frame's number.
class FramePattern {
 public:
  /// Throws Error(usage) for a name with two places.
  explicit FramePattern(const std::string& text);

  /// False for a name without a place, and for that of a file which is there.
  bool has_place() const { return digits_ > 0; }
  /// The name of a frame's file; numbers longer than the place have all their digits.
  std::string path_of(int frame) const;
  /// Whether a file is one of a frame: any frame.
  bool names(const std::string& path) const;
  /// The frames whose files are there, rising. Throws Error(input) where the folder cannot be read.
  std::vector<int> existing() const;
  /// The same, none of a folder that does not let itself be listed.
  std::vector<int> listed() const;

 private:
  /// The frame of a file of this name in the pattern's folder.
  std::optional<int> number_in(const std::string& name) const;

  std::string text_, before_, after_;
  std::size_t digits_ = 0;
};

}  // namespace rpf::cli
