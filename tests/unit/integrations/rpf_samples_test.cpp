// The header for renderers: whatever the order, the file is what docs/file-format.md describes, or there is none.
#include "rpf_samples.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <climits>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "io/atomic_file.h"
#include "temporary_folder.h"

namespace {

constexpr int channel_count = 5;
const char* const channels[channel_count] = {"R", "G", "B", "film.X", "film.Y"};

// What is to be written: a list of samples for each pixel of a window of `width` columns.
using Record = std::array<float, channel_count>;
struct Frame {
  int x, y, width, height;
  std::vector<std::vector<Record>> pixels;
};

Frame make_frame(int x, int y, int width, int height, unsigned most_samples) {
  Frame frame{x, y, width, height, {}};
  std::mt19937 random(1);
  for (int pixel = 0; pixel < width * height; ++pixel) {
    frame.pixels.emplace_back(random() % (most_samples + 1));
    for (Record& record : frame.pixels.back())
      for (float& value : record) value = static_cast<float>(random());
  }
  return frame;
}

void append_word(std::string& bytes, const void* word) {
  std::uint32_t bits = 0;
  memcpy(&bits, word, sizeof bits);
  for (int byte = 0; byte < 4; ++byte) bytes += static_cast<char>(bits >> (8 * byte) & 0xff);
}

// docs/file-format.md, word by word.
std::string expected_bytes(const Frame& frame, const std::string& metadata = "") {
  std::string bytes = R"({"format": "rpf-raw-samples", "version": 1, "dataWindow": [)" + std::to_string(frame.x) +
                      ", " + std::to_string(frame.y) + ", " + std::to_string(frame.width) + ", " +
                      std::to_string(frame.height) + R"(], "channels": ["R", "G", "B", "film.X", "film.Y"], )" +
                      R"("metadata": {)" + metadata + "}}\n";
  for (const auto& pixel : frame.pixels) {
    const auto count = static_cast<std::uint32_t>(pixel.size());
    append_word(bytes, &count);
  }
  for (std::size_t c = 0; c < channel_count; ++c)
    for (const auto& pixel : frame.pixels)
      for (const Record& record : pixel) append_word(bytes, &record[c]);
  return bytes;
}

rpf_samples* open_frame(const std::string& path, const Frame& frame) {
  return rpf_samples_open(path.c_str(), frame.x, frame.y, frame.width, frame.height, channels, channel_count);
}

void add_pixel(rpf_samples* file, const Frame& frame, std::size_t pixel) {
  const auto& records = frame.pixels[pixel];
  const auto column = static_cast<int>(pixel) % frame.width, row = static_cast<int>(pixel) / frame.width;
  if (records.empty()) return;
  EXPECT_EQ(RPF_SAMPLES_OK, rpf_samples_add(file, frame.x + column, frame.y + row, static_cast<int>(records.size()),
                                            records[0].data()));
}

// Ends the file without an error. What stands in the folder afterwards is that file alone.
void expect_finished(rpf_samples* file, const TemporaryFolder& folder, const std::string& expected) {
  EXPECT_EQ(rpf_samples_finish(file), RPF_SAMPLES_OK) << rpf_samples_error(file);
  EXPECT_STREQ(rpf_samples_error(file), "");
  rpf_samples_free(file);
  EXPECT_TRUE(file_bytes(folder.file("a.rpf")) == expected);
  EXPECT_EQ(folder.entry_count(), 1U);
}

void expect_failed(rpf_samples* file, int status, const std::vector<std::string>& words) {
  EXPECT_EQ(rpf_samples_finish(file), status);
  for (const std::string& word : words)
    EXPECT_NE(std::string(rpf_samples_error(file)).find(word), std::string::npos) << rpf_samples_error(file);
  rpf_samples_free(file);
}

TEST(SampleHeader, WritesVaryingCountsAndEmptyPixels) {
  for (const unsigned most_samples : {0U, 1U, 5U, 300U}) {
    const TemporaryFolder folder;
    const Frame frame = make_frame(-3, 7, 23, 19, most_samples);
    rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
    for (std::size_t pixel = 0; pixel < frame.pixels.size(); ++pixel) add_pixel(file, frame, pixel);
    expect_finished(file, folder, expected_bytes(frame));
  }
}

TEST(SampleHeader, TakesPixelsInAnyOrder) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(0, 0, 97, 71, 9);  // more than one band of pixels, more than one block in each
  std::vector<std::size_t> order(frame.pixels.size());
  for (std::size_t pixel = 0; pixel < order.size(); ++pixel) order[pixel] = pixel;
  std::shuffle(order.begin(), order.end(), std::mt19937(2));
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  for (const std::size_t pixel : order) add_pixel(file, frame, pixel);
  expect_finished(file, folder, expected_bytes(frame));
}

// A progressive renderer: the whole frame again and again.
TEST(SampleHeader, KeepsTheOrderOfAPixelsSamples) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(0, 0, 61, 43, 7);
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  for (std::size_t s = 0; s < 7; ++s)
    for (int pixel = 0; pixel < 61 * 43; ++pixel)
      if (const auto& records = frame.pixels[static_cast<std::size_t>(pixel)]; s < records.size())
        rpf_samples_add(file, pixel % 61, pixel / 61, 1, records[s].data());
  expect_finished(file, folder, expected_bytes(frame));
}

TEST(SampleHeader, TakesRowsOfPlanesFromTheLastToTheFirst) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(-5, -9, 31, 12, 4);
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  for (int row = 11; row >= 0; --row) {
    std::vector<int> counts;
    std::array<std::vector<float>, channel_count> planes;
    for (int column = 0; column < 31; ++column) {
      const auto& records = frame.pixels[static_cast<std::size_t>(row * 31 + column)];
      counts.push_back(static_cast<int>(records.size()));
      for (const Record& record : records)
        for (std::size_t c = 0; c < channel_count; ++c) planes[c].push_back(record[c]);
    }
    const float* const pointers[] = {planes[0].data(), planes[1].data(), planes[2].data(), planes[3].data(),
                                     planes[4].data()};
    EXPECT_EQ(rpf_samples_add_row(file, row - 9, counts.data(), pointers), RPF_SAMPLES_OK);
  }
  expect_finished(file, folder, expected_bytes(frame));
}

TEST(SampleHeader, TakesOneSampleAPixelWithoutCounts) {
  const TemporaryFolder folder;
  Frame frame{0, 0, 3, 1, {{{1, 2, 3, 4, 5}}, {{1, 2, 3, 4, 5}}, {{1, 2, 3, 4, 5}}}};
  const float values[] = {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 5};
  const float* const planes[] = {values, values + 3, values + 6, values + 9, values + 12};
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  EXPECT_EQ(rpf_samples_add_row(file, 0, nullptr, planes), RPF_SAMPLES_OK);
  expect_finished(file, folder, expected_bytes(frame));
}

// All threads write into one band of pixels, a sample at a time, each of them every fourth pixel.
TEST(SampleHeader, TakesSamplesFromManyThreads) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(0, 0, 64, 16, 400);
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  std::atomic<int> waiting{4};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      --waiting;
      while (waiting > 0) std::this_thread::yield();
      for (int pixel = t; pixel < 64 * 16; pixel += 4)
        for (const Record& record : frame.pixels[static_cast<std::size_t>(pixel)])
          rpf_samples_add(file, pixel % 64, pixel / 64, 1, record.data());
    });
  for (std::thread& thread : threads) thread.join();
  expect_finished(file, folder, expected_bytes(frame));
}

// 16 MB are sorted at once: 838,860 samples of five channels. One pixel has more.
TEST(SampleHeader, SortsAPixelThatIsLargerThanItsMemory) {
  const TemporaryFolder folder;
  Frame frame{0, 0, 3, 1, {{{1, 2, 3, 4, 5}}, std::vector<Record>(900000), {{6, 7, 8, 9, 10}}}};
  for (std::size_t s = 0; s < 900000; ++s) frame.pixels[1][s][0] = static_cast<float>(s);
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  for (const std::size_t pixel : {2U, 1U, 0U}) add_pixel(file, frame, pixel);
  expect_finished(file, folder, expected_bytes(frame));
}

TEST(SampleHeader, KeepsTheBitsOfEveryValue) {
  const TemporaryFolder folder;
  Frame frame{0, 0, 1, 1, {{{}}}};
  const std::uint32_t bits[] = {0x7fc12345, 0x7f812345, 0x80000000, 0xff800000, 1};
  memcpy(frame.pixels[0][0].data(), bits, sizeof bits);
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  add_pixel(file, frame, 0);
  expect_finished(file, folder, expected_bytes(frame));
}

TEST(SampleHeader, WritesMetadataAsJson) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(0, 0, 2, 2, 1);
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  const float origin[] = {2, -0.5F, 1e30F};
  rpf_samples_text(file, "rpf:renderer", "a \"b\" \\ \n \xC3\xA4");
  rpf_samples_integer(file, "rpf:seed", -2147483647 - 1);
  rpf_samples_floats(file, "rpf:worldOrigin", origin, 3);
  for (std::size_t pixel = 0; pixel < 4; ++pixel) add_pixel(file, frame, pixel);
  expect_finished(file, folder,
                  expected_bytes(frame, R"("rpf:renderer": "a \"b\" \\ \u000a )"
                                        "\xC3\xA4"
                                        R"(", "rpf:seed": -2147483648, )"
                                        R"("rpf:worldOrigin": [2.0, -0.5, 1.00000002e+30])"));
}

TEST(SampleHeader, ReplacesTheOldFileWhenItIsFinishedAndNotBefore) {
  const TemporaryFolder folder;
  write_bytes(folder.file("a.rpf"), "old");
  const Frame frame = make_frame(0, 0, 30, 20, 50);
  rpf_samples* given_up = open_frame(folder.file("a.rpf"), frame);
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  for (std::size_t pixel = 0; pixel < frame.pixels.size(); ++pixel) {
    add_pixel(given_up, frame, pixel);
    add_pixel(file, frame, pixel);
  }
  rpf_samples_free(given_up);
  EXPECT_EQ(file_bytes(folder.file("a.rpf")), "old");
  expect_finished(file, folder, expected_bytes(frame));
}

// Whoever writes into a folder removes what killed processes left there: what a renderer is writing must not look like
// that.
pid_t ended_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

/// A hidden file of this process, as another one would have named it.
std::string named_by(pid_t process, const std::filesystem::path& hidden) {
  std::string name = hidden.filename().string();
  const std::string mine = fmt::format("-{}-", ::getpid());
  return hidden.parent_path() / name.replace(name.find(mine), mine.size(), fmt::format("-{}-", process));
}

TEST(SampleHeader, WritesOnWhileRpfCleansUpBesideIt) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(0, 0, 2, 2, 1);
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  const std::filesystem::path hidden = std::filesystem::directory_iterator(folder.path())->path();
  { const rpf::io::AtomicFile image(folder.file("image.exr")); }
  for (std::size_t pixel = 0; pixel < 4; ++pixel) add_pixel(file, frame, pixel);
  expect_finished(file, folder, expected_bytes(frame));
  write_bytes(named_by(ended_process(), hidden), "left by a killed renderer");
  { const rpf::io::AtomicFile image(folder.file("image.exr")); }
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(SampleHeader, FollowsASymbolicLink) {
  const TemporaryFolder folder, elsewhere;
  write_bytes(elsewhere.file("b.rpf"), "old");
  std::filesystem::create_symlink(elsewhere.file("b.rpf"), folder.file("a.rpf"));
  const Frame frame = make_frame(0, 0, 2, 2, 1);
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  for (std::size_t pixel = 0; pixel < 4; ++pixel) add_pixel(file, frame, pixel);
  expect_finished(file, folder, expected_bytes(frame));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("a.rpf")));
  EXPECT_EQ(elsewhere.entry_count(), 1U);
}

TEST(SampleHeader, TheFirstErrorStaysAndNothingIsWritten) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(-3, 7, 4, 4, 1);
  const Record record{};
  for (const auto& [x, y] : {std::pair{-4, 7}, {1, 7}, {-3, 6}, {-3, 11}, {INT_MIN, INT_MAX}}) {
    rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
    EXPECT_EQ(rpf_samples_add(file, x, y, 1, record.data()), RPF_SAMPLES_USAGE);
    EXPECT_EQ(rpf_samples_add(file, -3, 7, 1, record.data()), RPF_SAMPLES_OK);
    EXPECT_EQ(rpf_samples_add(file, 0, 7, -1, record.data()), RPF_SAMPLES_USAGE);
    expect_failed(file, RPF_SAMPLES_USAGE,
                  {"a.rpf", "pixel " + std::to_string(x) + ", " + std::to_string(y) + " ", "outside the data window"});
  }
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(SampleHeader, RefusesSamplesAfterItsEnd) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(0, 0, 1, 1, 0);
  const Record record{};
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  EXPECT_EQ(rpf_samples_finish(file), RPF_SAMPLES_OK);
  EXPECT_EQ(rpf_samples_finish(file), RPF_SAMPLES_OK);
  EXPECT_EQ(rpf_samples_add(file, 0, 0, 1, record.data()), RPF_SAMPLES_USAGE);
  expect_failed(file, RPF_SAMPLES_USAGE, {"after the file was finished"});
  EXPECT_TRUE(file_bytes(folder.file("a.rpf")) == expected_bytes(frame));
}

TEST(SampleHeader, RefusesWhatCannotBeWritten) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(0, 0, 1, 1, 1);
  const auto expect_refused = [&](const std::string& path, const std::vector<std::string>& words) {
    rpf_samples* file = open_frame(path, frame);
    EXPECT_EQ(rpf_samples_text(file, "rpf:renderer", "any"), RPF_SAMPLES_OUTPUT);
    EXPECT_EQ(rpf_samples_add(file, 0, 0, 1, Record{}.data()), RPF_SAMPLES_OUTPUT);
    expect_failed(file, RPF_SAMPLES_OUTPUT, words);
  };
  expect_refused(folder.file("missing/a.rpf"), {"missing/a.rpf", "No such file", "make the folder first"});
  expect_refused(folder.path(), {"is a folder or a device"});
  expect_refused("/dev/full", {"/dev/full", "is a folder or a device"});
  expect_refused("/proc/a.rpf", {"/proc/a.rpf", "cannot be written"});
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(SampleHeader, RefusesWindowsAndChannelsThatNobodyReads) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.rpf");
  const auto expect_refused = [&](int width, int height, std::vector<const char*> names, const std::string& word) {
    expect_failed(rpf_samples_open(path.c_str(), 0, 0, width, height, names.data(), static_cast<int>(names.size())),
                  RPF_SAMPLES_USAGE, {path, word});
  };
  expect_refused(0, 5, {"R"}, "0 x 5 pixels");
  expect_refused(5, 1048577, {"R"}, "5 x 1048577 pixels");
  expect_failed(rpf_samples_open(path.c_str(), 1, -(1 << 29) - 1, 5, 5, channels, channel_count), RPF_SAMPLES_USAGE,
                {path, "a window at 1, -536870913"});
  expect_refused(5, 5, {}, "0 channels");
  expect_refused(5, 5, std::vector<const char*>(1025, "R"), "1025 channels");
  expect_refused(5, 5, {"R", "G", "R"}, "the channel R is there twice");
  expect_refused(5, 5, {"R", ""}, "channel 1 has no name");
  expect_refused(5, 5, {"R", nullptr}, "channel 1 has no name");
  expect_refused(5, 5, {"line\nfeed"}, "channel 0 has no name");
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(SampleHeader, RefusesMetadataThatJsonCannotHold) {
  const TemporaryFolder folder;
  const Frame frame = make_frame(0, 0, 1, 1, 1);
  for (const float value : {INFINITY, -INFINITY, NAN}) {
    rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
    EXPECT_EQ(rpf_samples_floats(file, "bad", &value, 1), RPF_SAMPLES_USAGE);
    expect_failed(file, RPF_SAMPLES_USAGE, {"a value of bad is not finite"});
  }
  rpf_samples* file = open_frame(folder.file("a.rpf"), frame);
  EXPECT_EQ(rpf_samples_text(file, "long", std::string(1 << 20, 'x').c_str()), RPF_SAMPLES_OK);
  expect_failed(file, RPF_SAMPLES_USAGE, {"more than 1 MB"});
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(SampleHeader, EveryFunctionTakesAFileThatCouldNotBeMade) {
  const Record record{};
  const float* const planes[channel_count] = {};
  EXPECT_EQ(rpf_samples_add(nullptr, 0, 0, 1, record.data()), RPF_SAMPLES_MEMORY);
  EXPECT_EQ(rpf_samples_add_row(nullptr, 0, nullptr, planes), RPF_SAMPLES_MEMORY);
  EXPECT_EQ(rpf_samples_integer(nullptr, "a", 1), RPF_SAMPLES_MEMORY);
  EXPECT_EQ(rpf_samples_finish(nullptr), RPF_SAMPLES_MEMORY);
  EXPECT_STREQ(rpf_samples_error(nullptr), "no memory for a sample file");
  rpf_samples_free(nullptr);
}

}  // namespace
