// What compression did to bytes, done here byte by byte, is undone.
#include "io/unpack.h"

#include <gtest/gtest.h>

#include <random>

#include "io/deflate.h"

namespace rpf::io {
namespace {

std::vector<std::uint8_t> random_bytes(std::size_t count) {
  std::mt19937 generator(static_cast<unsigned>(count));
  std::vector<std::uint8_t> bytes(count);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(generator() % 5 == 0 ? generator() : 7);
  return bytes;
}

/// As OpenEXR's ZIP compressor: bytes at even places first, then all as differences.
std::vector<std::uint8_t> packed(const std::vector<std::uint8_t>& bytes) {
  std::string differences;
  for (std::size_t i = 0; i < bytes.size(); i += 2) differences.push_back(static_cast<char>(bytes[i]));
  for (std::size_t i = 1; i < bytes.size(); i += 2) differences.push_back(static_cast<char>(bytes[i]));
  for (std::size_t i = differences.size() - 1; i > 0; --i)
    differences[i] = static_cast<char>(differences[i] - differences[i - 1] + 128);
  const std::string deflated = io::deflated(differences);
  return {deflated.begin(), deflated.end()};
}

TEST(Unpack, GivesBackWhatWasPackedWhateverItsLength) {
  int tried = 0;
  for (std::size_t count = 1; count < 300; ++count) {
    const std::vector<std::uint8_t> bytes = random_bytes(count), file = packed(bytes);
    if (file.size() >= count) continue;  // such data is stored as it is
    ++tried;
    std::vector<std::uint8_t> back(count);
    ASSERT_TRUE(Unpacker("zips").unpack(file, back)) << count;
    ASSERT_EQ(back, bytes) << count;
  }
  EXPECT_GT(tried, 200);
}

}  // namespace
}  // namespace rpf::io
