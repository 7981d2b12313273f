// The compressions of deep OpenEXR files, undone. OpenEXR's own way takes three times as long: it inflates with zlib
// and goes byte by byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rpf::io {

class Unpacker {
 public:
  /// `compression`: "none", "rle" or "zips".
  explicit Unpacker(const std::string& compression);

  /// Fills `out`, whose size is that of the unpacked data. Data that compression would not have made smaller is stored
  /// as it is. Returns false where `packed` is not compressed data of that size.
  bool unpack(const std::vector<std::uint8_t>& packed, std::vector<std::uint8_t>& out);

 private:
  struct FreeInflater {
    void operator()(void* inflater) const;
  };

  bool inflate(const std::vector<std::uint8_t>& packed);

  std::string compression_;
  std::unique_ptr<void, FreeInflater> inflater_;
  std::vector<std::uint8_t> differences_;  ///< what the compressor got: see unpack.cpp
};

}  // namespace rpf::io
