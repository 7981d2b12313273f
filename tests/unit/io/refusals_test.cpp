// Files that are refused, each with a text that names what is wrong.
#include <ImfArray.h>
#include <ImfDeepTiledOutputFile.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfTileDescription.h>
#include <gtest/gtest.h>

#include <chrono>

#include "deep_files.h"
#include "temporary_folder.h"

namespace {

using namespace deep_files;
using rpf::ErrorKind;

// Both ways in must refuse with the same text.
void expect_refused(const std::string& path, const std::vector<std::string>& words, ErrorKind kind = ErrorKind::input) {
  const std::string error = error_of([&] { rpf::read_samples(path); });
  expect_error(error, kind, words);
  expect_error(error, kind, {path});
  EXPECT_EQ(error_of([&] { rpf::inspect_samples(path); }), error);
}

void expect_recipe_refused(const Recipe& recipe, const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  write_deep(folder.file("a.exr"), recipe);
  expect_refused(folder.file("a.exr"), words);
}

// Overwrites the value of a header attribute; `skip` bytes after the 4 bytes of its size.
void patch_attribute(const std::string& path, const std::string& name, std::size_t skip, const std::string& value) {
  std::string bytes = file_bytes(path);
  const std::size_t start = bytes.find(name + '\0', 8);
  ASSERT_NE(start, std::string::npos);
  const std::size_t type_end = bytes.find('\0', start + name.size() + 1);
  bytes.replace(type_end + 1 + 4 + skip, value.size(), value);
  write_bytes(path, bytes);
}

std::string int_bytes(std::int32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}

// In kilobytes, from /proc.
long peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      long value = 0;
      status >> value;
      return value;
    }
  return 0;
}

TEST(Refusals, FilesThatAreNoFiles) {
  const TemporaryFolder folder;
  expect_refused(folder.file("missing.exr"), {"cannot be opened", "No such file"});
  expect_refused(folder.path(), {"is a folder"});
  expect_refused("/dev/null", {"is a device"});
  write_bytes(folder.file("empty.exr"), "");
  expect_refused(folder.file("empty.exr"), {"not an OpenEXR file", "deep scan-line"});
  write_bytes(folder.file("text.exr"), "this is no picture at all");
  expect_refused(folder.file("text.exr"), {"not an OpenEXR file"});
}

TEST(Refusals, FlatImages) {
  const TemporaryFolder folder;
  Imf::Header header(4, 4);
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  { Imf::OutputFile file(folder.file("flat.exr").c_str(), header); }
  expect_refused(folder.file("flat.exr"), {"a flat OpenEXR image", "deep scan-line", "docs/file-format.md"});
}

TEST(Refusals, TiledDeepFiles) {
  const TemporaryFolder folder;
  Imf::Header header = header_of({});
  header.setType(Imf::DEEPTILE);
  header.setTileDescription(Imf::TileDescription(16, 16, Imf::ONE_LEVEL));
  { Imf::DeepTiledOutputFile file(folder.file("tiled.exr").c_str(), header); }
  expect_refused(folder.file("tiled.exr"), {"a tiled deep OpenEXR file", "deep scan-line"});
}

TEST(Refusals, MultiPartFiles) {
  const TemporaryFolder folder;
  std::vector<Imf::Header> headers(2, header_of({}));
  headers[0].setName("one");
  headers[1].setName("two");
  { Imf::MultiPartOutputFile file(folder.file("parts.exr").c_str(), headers.data(), 2); }
  expect_refused(folder.file("parts.exr"), {"a multi-part OpenEXR file", "one part"});
}

TEST(Refusals, MissingChannels) {
  for (const char* missing : {"R", "G", "B", "film.X", "film.Y"}) {
    Recipe recipe;
    recipe.channels.erase(std::find(recipe.channels.begin(), recipe.channels.end(), missing));
    const std::string name = missing;
    expect_recipe_refused(recipe, {"no channel for " + name, "--map " + name + "=CHANNEL", "random.lens.U"});
  }
}

TEST(Refusals, DepthCompositedData) {
  Recipe recipe;
  recipe.channels = {"A", "B", "G", "R", "Z", "ZBack"};
  recipe.marker = "";
  expect_recipe_refused(recipe, {"depth-composited", "A, B, G, R, Z, ZBack", "rpf:format"});
}

TEST(Refusals, AnotherMarkerOrVersion) {
  Recipe recipe;
  recipe.marker = "photon-map";
  expect_recipe_refused(recipe, {"rpf:format=photon-map", "mc-samples"});
  const TemporaryFolder folder;
  rpf::write_samples(folder.file("a.exr"), make_buffer({0, 0, 2, 2}, [](int) { return 1U; }));
  patch_attribute(folder.file("a.exr"), "rpf:version", 0, int_bytes(2));
  expect_refused(folder.file("a.exr"), {"rpf:version 2", "version 1"});
}

TEST(Refusals, IntegerChannelsThatAreUsed) {
  Recipe recipe;
  recipe.types = {Imf::FLOAT, Imf::FLOAT, Imf::FLOAT, Imf::UINT};
  expect_recipe_refused(recipe, {"channel film.X as integers", "half or float"});
}

TEST(Refusals, SubsampledChannels) {
  const TemporaryFolder folder;
  write_deep(folder.file("a.exr"), {});
  // Channel "B": name and its zero, then type, linearity with padding, x sampling.
  patch_attribute(folder.file("a.exr"), "channels", 2 + 4 + 4, int_bytes(2));
  expect_refused(folder.file("a.exr"), {"channel B subsampled by 2 x 1"});
}

TEST(Refusals, TwoChannelsForOneSlot) {
  Recipe recipe;
  recipe.channels = {"B", "G", "N.X", "R", "film.X", "film.Y", "nn.X"};
  expect_recipe_refused(recipe, {"\"N.X\"", "\"nn.X\"", "feature.N.X", "--map"});
}

TEST(Refusals, TooManyChannels) {
  Recipe recipe;
  recipe.data_window = {0, 0, 1, 1};
  for (int i = 0; i < 1024; ++i) recipe.channels.push_back("unused" + std::to_string(i));
  expect_recipe_refused(recipe, {"more than 1024 channels"});
}

TEST(Refusals, CompressionOfFlatFiles) {
  const TemporaryFolder folder;
  write_deep(folder.file("a.exr"), {});
  patch_attribute(folder.file("a.exr"), "compression", 0, std::string(1, '\4'));
  expect_refused(folder.file("a.exr"), {"compression piz", "zips"});
}

TEST(Refusals, AHugeHeaderInASmallFileCostsNothing) {
  const TemporaryFolder folder;
  write_deep(folder.file("a.exr"), {});
  patch_attribute(folder.file("a.exr"), "dataWindow", 8, int_bytes(16383) + int_bytes(16383));
  patch_attribute(folder.file("a.exr"), "chunkCount", 0, int_bytes(16384));
  write_bytes(folder.file("a.exr"), file_bytes(folder.file("a.exr")) + std::string(132000, '\0'));
  const long memory_before = peak_memory();
  const auto start = std::chrono::steady_clock::now();
  expect_refused(folder.file("a.exr"), {"truncated or damaged", "16384 rows"});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_LT(peak_memory() - memory_before, 100 * 1024);
  // One row more than the largest side.
  patch_attribute(folder.file("a.exr"), "dataWindow", 8, int_bytes(1 << 20) + int_bytes(0));
  expect_refused(folder.file("a.exr"), {"dataWindow of 1048577 x 1", "1048576"});
  patch_attribute(folder.file("a.exr"), "dataWindow", 8, int_bytes(-1) + int_bytes(0));
  expect_refused(folder.file("a.exr"), {"dataWindow of 0 x 1"});
}

TEST(Refusals, ARowThatClaimsMoreThanCompressionCanHold) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.data_window = {0, 0, 4, 1};
  write_deep(folder.file("a.exr"), recipe);
  std::string bytes = file_bytes(folder.file("a.exr"));
  // The only chunk: y, then the sizes of the count table, the packed and the unpacked samples (8 samples of 24 bytes).
  const std::size_t unpacked = bytes.rfind(int_bytes(8 * 24) + int_bytes(0));
  ASSERT_NE(unpacked, std::string::npos);
  bytes.replace(unpacked, 4, int_bytes(24 * 80000000));
  write_bytes(folder.file("a.exr"), bytes);
  expect_refused(folder.file("a.exr"), {"row y=0 claims more data"});
  bytes.replace(unpacked, 4, int_bytes(24 * 9));
  write_bytes(folder.file("a.exr"), bytes);
  expect_refused(folder.file("a.exr"), {"row y=0 counts 8 samples but stores 9"});
  // A table of counts for half a million pixels in a few bytes.
  patch_attribute(folder.file("a.exr"), "dataWindow", 8, int_bytes(1 << 19) + int_bytes(0));
  expect_refused(folder.file("a.exr"), {"row y=0 claims more data"});
}

TEST(Refusals, AChunkOfAnotherRow) {
  const TemporaryFolder folder;
  write_deep(folder.file("a.exr"), {});
  patch_attribute(folder.file("a.exr"), "dataWindow", 4, int_bytes(7) + int_bytes(3) + int_bytes(9));
  expect_refused(folder.file("a.exr"), {"the chunk of row y=7 says y=0"});
}

TEST(Refusals, HeadersWithAMissingOrMisshapenAttribute) {
  const TemporaryFolder folder;
  write_deep(folder.file("good.exr"), {});
  const std::string good = file_bytes(folder.file("good.exr"));
  for (const std::string name : {"channels", "compression", "dataWindow", "displayWindow", "lineOrder",
                                 "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth", "type", "version"}) {
    std::string bytes = good;
    bytes[bytes.find(name + '\0', 8)] = '_';
    write_bytes(folder.file("a.exr"), bytes);
    expect_refused(folder.file("a.exr"), {"no attribute " + name});
  }
  patch_attribute(folder.file("good.exr"), "pixelAspectRatio", static_cast<std::size_t>(-4), int_bytes(5));
  expect_refused(folder.file("good.exr"), {"pixelAspectRatio of type float has 5 bytes instead of 4"});
}

// Found by fuzz_samples: OpenEXR read such a list beyond its end, and took what followed for a size of 1.7 GB.
TEST(Refusals, AListOfChannelsUnderAnotherNameThatRunsOverItsEnd) {
  const TemporaryFolder folder;
  write_deep(folder.file("a.exr"), {});
  std::string bytes = file_bytes(folder.file("a.exr"));
  const std::string list("X\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0", 18);  // one channel, no end of the list
  bytes.insert(bytes.find("channels"), std::string("another\0chlist\0", 15) + int_bytes(18) + list);
  write_bytes(folder.file("a.exr"), bytes);
  expect_refused(folder.file("a.exr"), {"channel list does not fill its attribute"});
}

TEST(Refusals, AFileWhoseWriterStopped) {
  const TemporaryFolder folder;
  {
    Imf::DeepScanLineOutputFile file(folder.file("a.exr").c_str(), header_of({}), 0);  // no row written
  }
  write_bytes(folder.file("a.exr"), file_bytes(folder.file("a.exr")) + std::string(1000, 'x'));
  expect_refused(folder.file("a.exr"), {"incomplete", "row y=0 was never written"});
}

}  // namespace
