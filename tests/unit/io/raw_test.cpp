// Raw sample files: what goes in comes out, and what is none is refused.
#include <gtest/gtest.h>

#include <limits>

#include "deep_files.h"
#include "rpf/io.h"
#include "rpf/outputs.h"
#include "same_bits.h"
#include "temporary_folder.h"

namespace {

using namespace deep_files;
using rpf::ErrorKind;
using rpf::SampleBuffer;
using rpf::Window;
using rpf::test::same_bits;

// Values by their bits: quiet and signaling NaN with a payload, both zeros, both infinities, the least and largest.
void put_special_values(SampleBuffer& samples) {
  const std::uint32_t special[] = {0x7fc12345, 0x7f812345, 0xffc00001, 0x80000000, 0,
                                   0x7f800000, 0xff800000, 1,          0x7f7fffff};
  for (std::size_t i = 0; i < samples.values.size(); ++i)
    if (i % 3 == 0) std::memcpy(&samples.values[i], &special[i / 3 % std::size(special)], 4);
}

void expect_equal(const SampleBuffer& a, const SampleBuffer& b) {
  EXPECT_EQ(a.data_window, b.data_window);
  EXPECT_EQ(a.display_window, b.display_window);
  EXPECT_EQ(a.layout.slots, b.layout.slots);
  EXPECT_EQ(a.first_sample, b.first_sample);
  EXPECT_TRUE(same_bits(a.values, b.values));
  EXPECT_EQ(a.metadata, b.metadata);
}

// To raw and to OpenEXR, and from each to the other.
void expect_round_trips(SampleBuffer samples) {
  const TemporaryFolder folder;
  put_special_values(samples);
  rpf::write_samples(folder.file("a.rpf"), samples);
  const SampleBuffer back = rpf::read_samples(folder.file("a.rpf"));
  expect_equal(back, samples);
  rpf::write_samples(folder.file("a.exr"), back);
  const SampleBuffer from_exr = rpf::read_samples(folder.file("a.exr"));
  EXPECT_TRUE(same_bits(from_exr.values, samples.values));
  rpf::write_samples(folder.file("b.rpf"), from_exr);
  expect_equal(rpf::read_samples(folder.file("b.rpf")), from_exr);
  EXPECT_EQ(folder.entry_count(), 3U);
}

constexpr const char* header_of_one_pixel =
    R"({"format": "rpf-raw-samples", "version": 1, "dataWindow": [0, 0, 1, 1],)"
    R"( "channels": ["R", "G", "B", "film.X", "film.Y"], "metadata": {"rpf:seed": 7}})";

std::string words(std::initializer_list<std::uint32_t> values) {
  std::string bytes;
  for (const std::uint32_t value : values)
    for (int byte = 0; byte < 4; ++byte) bytes += static_cast<char>(value >> (8 * byte) & 0xff);
  return bytes;
}

// One pixel with one sample: R = 1, all else 0.
std::string one_pixel(const std::string& header = header_of_one_pixel) {
  return header + "\n" + words({1, 0x3f800000, 0, 0, 0, 0});
}

std::string with(const std::string& old, const std::string& replacement) {
  std::string header = header_of_one_pixel;
  const std::size_t at = header.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return header.replace(at, old.size(), replacement);
}

void expect_refused(const std::string& bytes, const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.rpf");
  write_bytes(path, bytes);
  const std::string error = error_of([&] { rpf::read_samples(path); });
  expect_error(error, ErrorKind::input, words);
  expect_error(error, ErrorKind::input, {path});
  EXPECT_EQ(error.find_first_of("\n\r\t\x1b"), std::string::npos) << error;
  EXPECT_EQ(error_of([&] { rpf::inspect_samples(path); }), error);
}

TEST(Raw, RoundTripsAreLosslessForAnyWindow) {
  for (const Window window :
       {Window{0, 0, 5, 4}, Window{-7, -3, 6, 2}, Window{1, 1, 1, 1}, Window{1073741783, -1073741822, 40, 1}}) {
    SampleBuffer samples = make_buffer(window, [](int) { return 3U; });
    samples.display_window = {-10, 0, 64, 48};
    expect_round_trips(samples);
  }
}

// More samples than become records at once (16384), and no multiple of it.
TEST(Raw, RoundTripsAreLosslessForManySamples) {
  expect_round_trips(make_buffer({3, -2, 7, 5}, [](int pixel) { return 1000U + static_cast<unsigned>(pixel) % 3; }));
}

TEST(Raw, RoundTripsAreLosslessForAnyCounts) {
  const Window window{0, 0, 7, 5};
  expect_round_trips(make_buffer(window, [](int) { return 0U; }));
  expect_round_trips(make_buffer(window, [](int pixel) { return static_cast<unsigned>(pixel * 7 % 5); }));
  expect_round_trips(make_buffer(window, [](int pixel) { return pixel == 34 ? 3000U : 0U; }));
}

TEST(Raw, MetadataTravels) {
  const TemporaryFolder folder;
  SampleBuffer samples = make_buffer({0, 0, 2, 2}, [](int) { return 1U; });
  samples.metadata = {{"rpf:seed", -2147483647 - 1},
                      {"shutter", 0.1F},
                      {"whole", 2.0F},
                      {"least", std::numeric_limits<float>::denorm_min()},
                      {"zero", -0.0F},
                      {"text", std::string("line\nquote\" \xC3\xA4")},
                      {"one", std::vector<float>{1}},
                      {"worldToCamera", std::vector<float>(16, 0.3F)}};
  rpf::write_samples(folder.file("a.rpf"), samples);
  const SampleBuffer back = rpf::read_samples(folder.file("a.rpf"));
  EXPECT_EQ(back.metadata, samples.metadata);
  EXPECT_TRUE(std::signbit(std::get<float>(back.metadata.at("zero"))));
  samples.metadata["bad"] = std::numeric_limits<float>::infinity();
  expect_error(error_of([&] { rpf::write_samples(folder.file("b.rpf"), samples); }), ErrorKind::output,
               {"b.rpf", "attribute bad is not finite"});
  samples.metadata["bad"] = std::string("\xE4");
  expect_error(error_of([&] { rpf::write_samples(folder.file("b.rpf"), samples); }), ErrorKind::output, {"UTF-8"});
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(Raw, ThePlanesBeginAtAMultipleOf64) {
  const TemporaryFolder folder;
  SampleBuffer samples = make_buffer({0, 0, 2, 2}, [](int) { return 1U; });
  for (int length = 0; length < 70; ++length) {
    samples.metadata["text"] = std::string(static_cast<std::size_t>(length), 'x');
    rpf::write_samples(folder.file("a.rpf"), samples);
    ASSERT_EQ((file_bytes(folder.file("a.rpf")).find('\n') + 1) % 64, 0U) << length;
  }
}

TEST(Raw, IsRecognizedByItsContentAndDescribed) {
  const TemporaryFolder folder;
  const std::string path = folder.file("samples.exr");  // the name does not matter
  write_bytes(path, one_pixel());
  const rpf::SampleFileInfo info = rpf::inspect_samples(path);
  EXPECT_EQ(info.sample_count, 1U);
  EXPECT_EQ(info.min_samples, 1U);
  EXPECT_EQ(info.max_samples, 1U);
  EXPECT_EQ(info.display_window, info.data_window);
  EXPECT_EQ(info.channels.size(), 5U);
  EXPECT_EQ(rpf::read_samples(path).record(0)[0], 1.0F);
  EXPECT_EQ(rpf::read_samples(path).metadata.at("rpf:seed"), rpf::Attribute(7));
}

TEST(Raw, AliasesAndMapWorkAndUnusedChannelsAreSkipped) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.rpf");
  const std::string channels = R"(["junk", "COLOR_G", "COLOR_B", "COLOR_R", "IMAGE_X", "IMAGE_Y", "mine"])";
  write_bytes(path, with(R"(["R", "G", "B", "film.X", "film.Y"])", channels) + "\n" + words({1, 9, 2, 3, 1, 4, 5, 6}));
  rpf::SampleReadOptions options;
  options.slot_map = {{"feature.depth", "mine"}};
  const SampleBuffer samples = rpf::read_samples(path, options);
  EXPECT_EQ(samples.layout.slots, (std::vector<std::string>{"R", "G", "B", "film.X", "film.Y", "feature.depth"}));
  std::vector<float> expected(6);
  std::memcpy(expected.data(), words({1, 2, 3, 4, 5, 6}).data(), 24);
  EXPECT_TRUE(same_bits(samples.values, expected));
}

TEST(Raw, TheMemoryBudgetIsCheckedBeforehand) {
  const TemporaryFolder folder;
  rpf::write_samples(folder.file("a.rpf"), make_buffer({0, 0, 300, 300}, [](int) { return 4U; }));
  rpf::SampleReadOptions options;
  options.max_memory = std::uint64_t{12} << 20;  // 300 * 300 * 4 samples of 36 bytes are 12.4 MB
  expect_error(error_of([&] { rpf::read_samples(folder.file("a.rpf"), options); }), ErrorKind::memory,
               {"a.rpf", "needs 13 MB", "limit is 12 MB"});
  options.max_memory = std::uint64_t{13} << 20;
  EXPECT_EQ(rpf::read_samples(folder.file("a.rpf"), options).sample_count(), 360000U);
}

TEST(RawRefusals, HeadersThatAreNone) {
  expect_refused("{", {"no end of line in its first 1 bytes"});
  expect_refused("{" + std::string(3 << 20, ' '), {"no end of line in its first 1048576 bytes"});
  expect_refused("{\"format\n", {"first line that is no JSON", "docs/file-format.md"});
  expect_refused("{} {}\n", {"first line that is no JSON"});
  expect_refused(R"({"version": 1e999})"
                 "\n",
                 {"first line that is no JSON"});
  expect_refused("{\"a\": " + std::string(1 << 19, '[') + "\n", {"first line that is no JSON"});
  expect_refused("{\"a\": " + std::string(1 << 18, '[') + std::string(1 << 18, ']') + "}\n", {"no key \"format\""});
}

TEST(RawRefusals, MissingAndUnknownKeys) {
  for (const std::string key : {"format", "version"})
    expect_refused(one_pixel(with("\"" + key, "\"x" + key)), {"no key \"" + key + "\""});
  expect_refused(one_pixel(with("\"dataWindow\": [0, 0, 1, 1],", "")), {"no key \"dataWindow\""});
  expect_refused(one_pixel(with(R"("channels": ["R", "G", "B", "film.X", "film.Y"],)", "")), {"no key \"channels\""});
  expect_refused(one_pixel(with("\"metadata", "\"metdata")), {"unknown key \"metdata\"", "near: \"metadata\""});
}

TEST(RawRefusals, KeysOfAnotherTypeOrValue) {
  expect_refused(one_pixel(with("\"rpf-raw-samples\"", "\"photon-map\"")), {"\"format\"", "\"rpf-raw-samples\""});
  for (const char* version : {"2", "\"1\"", "null", "1.5"})
    expect_refused(one_pixel(with("\"version\": 1", std::string("\"version\": ") + version)),
                   {"\"version\"", "1, the version"});
  for (const char* window :
       {"[0, 0, 1]", "[0, 0, 1, 1, 1]", "[0, 0, 1.0, 1]", "[0, 0, 1, \"1\"]", "7", "{\"a\": 1}", "null",
        "[0, 0, 1, 4294967297]", "[0, -2147483649, 1, 1]", "[0, 0, 1, 18446744073709551615]", "[2147483647, 0, 2, 1]",
        "[1073741822, 0, 2, 1]", "[0, -1073741823, 1, 1]"})
    expect_refused(one_pixel(with("[0, 0, 1, 1]", window)), {"\"dataWindow\""});
  for (const char* window : {"[0, 0, 0, 1]", "[0, 0, 1, -1]", "[0, 0, 1048577, 1]"})
    expect_refused(one_pixel(with("[0, 0, 1, 1]", window)), {"has a dataWindow of", "1048576"});
  for (const char* channels :
       {"7", "{}", R"(["R", 7])", R"(["R", ""])", R"(["R", "R"])", R"(["R\u0000"])", R"(["R\n"])"})
    expect_refused(one_pixel(with(R"(["R", "G", "B", "film.X", "film.Y"])", channels)), {"\"channels\""});
  for (const char* value : {"null", "true", "{}", "[\"a\"]", "[[1]]", "4294967296", "1e39", "[1e300]"})
    expect_refused(one_pixel(with(": 7", std::string(": ") + value)), {"\"metadata.rpf:seed\""});
  expect_refused(one_pixel(with("{\"rpf:seed\": 7}", "[]")), {"\"metadata\""});
}

TEST(RawRefusals, SlotsAsInOpenExr) {
  expect_refused(one_pixel(with("\"film.X\"", "\"other\"")), {"no channel for film.X", "--map film.X=CHANNEL"});
  expect_refused(one_pixel(with(R"(["R")", R"(["N.X", "nn.X", "R")")), {"two channels for the slot feature.N.X"});
  std::string many = "[\"R\"";
  for (int i = 0; i < 1024; ++i) many += ", \"u" + std::to_string(i) + "\"";
  expect_refused(one_pixel(with("[\"R\"", many)), {"\"channels\"", "at most 1024"});
}

TEST(RawRefusals, EveryTruncationAndEveryByteMore) {
  const std::string bytes = one_pixel();
  for (std::size_t size = 1; size < bytes.size(); ++size) expect_refused(bytes.substr(0, size), {});
  expect_refused(bytes + "x", {"truncated or damaged"});
  expect_refused(bytes + std::string(20, 'x'), {"its counts ask for 1 samples", "it holds 2"});
  expect_refused(bytes.substr(0, bytes.size() - 20), {"its counts ask for 1 samples", "it holds 0"});
}

TEST(RawRefusals, AHugeHeaderInASmallFileCostsNothing) {
  expect_refused(one_pixel(with("[0, 0, 1, 1]", "[0, 0, 1048576, 1048576]")),
                 {"expected 4398046511104 for the counts"});
  std::string bytes = one_pixel();
  bytes.replace(bytes.find('\n') + 1, 4, words({0xffffffff}));
  expect_refused(bytes, {"its counts ask for 4294967295 samples"});
}

TEST(RawRefusals, NoFlippedByteCrashes) {
  const TemporaryFolder folder;
  const std::string good = one_pixel();
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const int mask : {0x01, 0x02, 0x10, 0x80, 0xff}) {
      std::string damaged = good;
      damaged[at] = static_cast<char>(damaged[at] ^ mask);
      write_bytes(folder.file("a.rpf"), damaged);
      try {
        rpf::read_samples(folder.file("a.rpf")).validate();
      } catch (const rpf::Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
      }
    }
}

TEST(SampleTargets, OnlyTwoExtensionsHoldSamples) {
  const TemporaryFolder folder;
  const SampleBuffer samples = make_buffer({0, 0, 2, 2}, [](int) { return 1U; });
  const auto check = [](const std::string& path) { rpf::check_outputs({{path, rpf::OutputKind::samples}}, {}); };
  for (const std::string name : {"a.png", "a", "a.json"}) {
    expect_error(error_of([&] { rpf::write_samples(folder.file(name), samples); }), ErrorKind::output,
                 {name, ".exr", ".rpf"});
    expect_error(error_of([&] { check(folder.file(name)); }), ErrorKind::output, {name, ".exr", ".rpf"});
  }
  EXPECT_THROW(check(folder.file("no/a.exr")), rpf::Error);
  for (const std::string name : {"a.EXR", "a.Rpf"}) check(folder.file(name));
  EXPECT_EQ(folder.entry_count(), 0U);
}

}  // namespace
