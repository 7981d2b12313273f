// Compiled programs as drivers hand them out, kept between runs: compilers take seconds, a driver's own cache is its
// own business, and most have none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rpf {

/// Binaries by source (all that decides what is compiled: text, options, device, driver, processor), a file each, with
/// a checksum.
class Binaries {
 public:
  using Binary = std::vector<unsigned char>;

  /// An empty folder, or one that cannot be written, keeps nothing.
  explicit Binaries(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Whether anything is kept, whole; what is damaged is removed.
  bool has(const std::string& source) const;
  /// Empty where there is none.
  Binary find(const std::string& source) const;
  /// Nothing for a driver that hands out none, or does not take it back: so that it is not asked again.
  void keep(const std::string& source, const Binary& binary) const;

 private:
  std::filesystem::path file_of(const std::string& source) const;
  /// Seal and binary; empty where there is none.
  std::string read(const std::string& source) const;

  std::filesystem::path folder_;
};

}  // namespace rpf
