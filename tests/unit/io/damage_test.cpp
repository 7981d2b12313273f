// Damaged files: every truncation is an error, and no flipped byte does worse than an error.
#include <gtest/gtest.h>

#include "deep_files.h"
#include "temporary_folder.h"

namespace {

using namespace deep_files;

std::string good_file(const TemporaryFolder& folder, Imf::Compression compression) {
  Recipe recipe;
  recipe.data_window = {-3, 2, 5, 4};
  recipe.compression = compression;
  recipe.counts = [](int pixel) { return static_cast<unsigned>(pixel % 4); };
  write_deep(folder.file("good.exr"), recipe);
  return file_bytes(folder.file("good.exr"));
}

// Where the chunks begin: behind the header's last zero and the offsets of 4 rows.
std::size_t first_chunk(const std::string& bytes) {
  std::uint64_t offset = std::string::npos;
  for (std::size_t at = 8; at + 8 <= bytes.size(); ++at) {
    std::memcpy(&offset, bytes.data() + at, 8);
    if (offset == at + 4 * 8) return offset;
  }
  return std::string::npos;
}

// True if the file was read; what was read must hold together.
bool is_read(const std::string& path) {
  try {
    rpf::read_samples(path).validate();
    rpf::inspect_samples(path);
    return true;
  } catch (const rpf::Error& error) {
    EXPECT_EQ(error.kind(), rpf::ErrorKind::input) << error.what();
    const std::string text = error.what();
    EXPECT_NE(text.find(path), std::string::npos) << text;
    EXPECT_EQ(text.find_first_of("\n\r\t\x1b"), std::string::npos) << text;
    return false;
  }
}

TEST(Damage, EveryTruncationIsAnInputError) {
  const TemporaryFolder folder;
  for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION}) {
    const std::string bytes = good_file(folder, compression);
    ASSERT_TRUE(is_read(folder.file("good.exr")));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      write_bytes(folder.file("short.exr"), bytes.substr(0, size));
      ASSERT_FALSE(is_read(folder.file("short.exr"))) << size << " of " << bytes.size() << " bytes were read";
    }
  }
}

TEST(Damage, ATruncatedRowIsNamed) {
  const TemporaryFolder folder;
  const std::string bytes = good_file(folder, Imf::ZIPS_COMPRESSION);
  write_bytes(folder.file("short.exr"), bytes.substr(0, bytes.size() - 3));
  expect_error(error_of([&] { rpf::inspect_samples(folder.file("short.exr")); }), rpf::ErrorKind::input,
               {"is truncated: row y=5 reaches beyond its end"});
}

TEST(Damage, NoFlippedByteCrashes) {
  const TemporaryFolder folder;
  for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION}) {
    const std::string bytes = good_file(folder, compression);
    for (std::size_t at = 0; at < bytes.size(); ++at)
      for (const int mask : {0x01, 0x02, 0x10, 0x80, 0xff}) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ mask);
        write_bytes(folder.file("flipped.exr"), damaged);
        is_read(folder.file("flipped.exr"));
      }
  }
}

// What may change without notice: the text of attributes that nothing checks, the display window and the names of
// channels, where another name is as good. All else in the header and the tables must be noticed.
TEST(Damage, AFlippedHeaderByteNeverMixesChannels) {
  const TemporaryFolder folder;
  const std::string bytes = good_file(folder, Imf::ZIPS_COMPRESSION);
  const rpf::SampleBuffer good = rpf::read_samples(folder.file("good.exr"));
  const std::size_t chunks = first_chunk(bytes);
  ASSERT_NE(chunks, std::string::npos);
  int unnoticed = 0;
  for (std::size_t at = 0; at < chunks; ++at)
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      write_bytes(folder.file("flipped.exr"), damaged);
      if (!is_read(folder.file("flipped.exr"))) continue;
      ++unnoticed;
      const rpf::SampleBuffer back = rpf::read_samples(folder.file("flipped.exr"));
      ASSERT_EQ(back.first_sample, good.first_sample) << "byte " << at << " bit " << bit;
      for (const std::string& slot : back.layout.slots) {
        const auto column = good.layout.find(slot);
        for (std::size_t s = 0; column && s < good.sample_count(); ++s)
          ASSERT_EQ(back.record(s)[*back.layout.find(slot)], good.record(s)[*column])
              << slot << ", byte " << at << " bit " << bit;
      }
    }
  EXPECT_LT(unnoticed, static_cast<int>(chunks) * 8 / 3);
}

}  // namespace
