// Frames that are read by rows: what is found in them, and what is filtered, has the bits of the whole.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "io/row_pieces.h"
#include "rpf/devices.h"
#include "rpf/methods.h"
#include "rpf/rows.h"
#include "run/driver.h"
#include "run/row_scan.h"
#include "streaming.h"
#include "test_frames.h"

namespace rpf {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint64_t a_row = 1;  ///< bytes: less than any row

/// Rows of a frame in memory, counting those that are read.
class BufferRows : public SampleRows {
 public:
  explicit BufferRows(SampleBuffer samples) : samples_(std::move(samples)), rows_(samples_) {}

  const SampleBuffer& frame() const override { return rows_.frame(); }
  std::uint64_t row_samples(int row) const override { return rows_.row_samples(row); }
  SampleBuffer read(int from, int end) override {
    rows_read += end - from;
    return rows_.read(from, end);
  }

  int rows_read = 0;

 private:
  SampleBuffer samples_;
  io::BufferRows rows_;
};

struct Frame {
  const char* name;
  std::function<void(SampleBuffer&)> change;
};

void set(SampleBuffer& samples, const std::vector<std::string>& slots, std::size_t begin, std::size_t end,
         float value) {
  for (const std::string& slot : slots)
    for (std::size_t i = begin; i < end; ++i) test::value_of(samples, i, slot) = value;
}

const std::vector<std::string> color = {"R", "G", "B"}, place = {"feature.P.X", "feature.P.Y", "feature.P.Z"};

const Frame frames[] = {
    {"plain", [](SampleBuffer&) {}},
    {"lost pixels over several rows", [](SampleBuffer& s) { set(s, {"R"}, 0, s.sample_count() / 2, nan); }},
    {"nothing but lost pixels", [](SampleBuffer& s) { set(s, {"G"}, 0, s.sample_count(), infinity); }},
    {"one brilliant row", [](SampleBuffer& s) { set(s, color, s.sample_count() - 40, s.sample_count(), 1e30F); }},
    {"far from one",
     [](SampleBuffer& s) {
       test::scale_radiance(s, 1e-37F);
       set(s, color, 7, 9, 1e4F);
     }},
    {"missing positions and features",
     [](SampleBuffer& s) {
       set(s, {"film.X", "film.Y", "feature.N.X"}, 11, 60, nan);
       set(s, place, 0, 30, infinity);
     }},
    {"no hits in the first rows",
     [](SampleBuffer& s) {
       set(s, {"feature.N.X", "feature.N.Y", "feature.N.Z", "feature.hit"}, 0, 100, 0);
     }},
    {"positions all the same", [](SampleBuffer& s) { set(s, place, 0, s.sample_count(), 3); }},
    {"one position differs in the end",
     [](SampleBuffer& s) {
       set(s, place, 0, s.sample_count(), 3);
       test::value_of(s, s.sample_count() - 1, "feature.P.Y") = 4;
     }},
    {"weights",
     [](SampleBuffer& s) {
       test::add_channel(s, "weight", 1);
       set(s, {"weight"}, 5, 25, 0.25F);
       set(s, {"weight"}, s.sample_count() - 9, s.sample_count() - 7, 1000);
     }},
    {"time differs from row to row only",
     [](SampleBuffer& s) {
       for (std::size_t pixel = 0; pixel + 1 < s.first_sample.size(); ++pixel)
         set(s, {"random.time"}, s.first_sample[pixel], s.first_sample[pixel + 1],
             static_cast<float>(pixel / static_cast<std::size_t>(s.data_window.width)) / 32);
     }},
    {"pixels of many samples",
     [](SampleBuffer& s) {  // those of 24 pixels each
       for (const std::size_t first : {32U, 130U})
         std::fill_n(s.first_sample.begin() + static_cast<std::ptrdiff_t>(first) + 1, 23, s.first_sample[first + 24]);
     }},
    {"against the conventions",
     [](SampleBuffer& s) {
       set(s, {"random.lens.U"}, 10, 200, -0.5F);
       set(s, {"film.X"}, 100, 150, 0.5F);
     }},
};

SampleBuffer frame_of(const Frame& frame, int height = 18) {
  SampleBuffer samples = test::every_input({14, height, 0, 1});
  samples.data_window.x = -5, samples.data_window.y = 7;
  for (std::size_t i = 0; i < samples.sample_count(); ++i) {
    test::value_of(samples, i, "film.X") -= 5;
    test::value_of(samples, i, "film.Y") += 7;
  }
  frame.change(samples);
  return samples;
}

Settings settings_of(const std::string& method) {
  Settings settings = method_settings(method);
  settings.model = "fast";
  if (settings.method != Method::learned) settings.box_widths = {5, 3};
  settings.filter_features = true;
  return settings;
}

class Rows : public testing::TestWithParam<const char*> {};

void expect_same(const Image& a, const Image& b) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.metadata, b.metadata);
  EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)), 0);
}

TEST_P(Rows, FactsAreThoseOfTheWhole) {
  const Settings settings = settings_of(GetParam());
  for (const Frame& frame : frames) {
    BufferRows rows(frame_of(frame)), whole(frame_of(frame));
    EXPECT_EQ(text_of(scan_rows(rows, settings, {}, {a_row}).facts), text_of(scan_rows(whole, settings, {}).facts))
        << frame.name;
  }
}

TEST_P(Rows, OfACropAreThoseOfTheWhole) {
  Settings settings = settings_of(GetParam());
  settings.crop = Window{-3, 12, 9, 4};
  for (const Frame& frame : frames) {
    SCOPED_TRACE(frame.name);
    BufferRows rows(frame_of(frame));
    const std::string facts = text_of(scan_rows(rows, settings, {}, {a_row}).facts);
    const Result part = filter_rows(rows, settings, facts), whole = filter(frame_of(frame), settings);
    expect_same(part.image, whole.image);
    expect_same(part.features, whole.features);
    EXPECT_EQ(part.report.passes.back().energy, whole.report.passes.back().energy);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Rows, testing::Values("rpf", "gaussian", "cross-bilateral", "learned"));

/// Of every frame, whole and cropped.
void expect_the_picture_of_the_whole(Settings settings) {
  for (const Frame& frame : frames) {
    SCOPED_TRACE(frame.name);
    for (const bool cropped : {false, true}) {
      if (cropped)
        settings.crop = Window{-3, 12, 9, 4};
      else
        settings.crop.reset();
      const SampleBuffer samples = frame_of(frame);
      EXPECT_EQ(test::difference_when_streamed(samples, settings, filter(samples, settings)), "");
    }
  }
}

class Streams : public testing::TestWithParam<const char*> {};

TEST_P(Streams, MakeThePictureOfTheWhole) {
  Settings settings = settings_of("learned");
  settings.backend = GetParam();
  if (settings.backend == "opencl" && devices().empty()) GTEST_SKIP() << "no OpenCL device";
  expect_the_picture_of_the_whole(settings);
}

TEST_P(Streams, ReadNoRowAnewThatIsSoonAskedForAgain) {
  Settings settings = settings_of("learned");
  settings.filter_features = false;
  settings.backend = GetParam();
  if (settings.backend == "opencl" && devices().empty()) GTEST_SKIP() << "no OpenCL device";
  constexpr int height = 500, kept = 140;
  BufferRows rows(frame_of(frames[0], height));
  ScannedRows scanned = scan_rows(rows, settings, {}, {a_row});
  const std::uint32_t most = std::get<ObservedFindings>(scanned.facts).cleaned.most_samples;
  settings.max_memory = predict_rows_memory(rows, most, settings).bytes + kept * rows.row_bytes(0) / 3 * 4;
  rows.rows_read = 0;
  run_streamed(rows, std::move(scanned), settings, {}, a_row);
  // Samples are seen twice. A device does so with the rows between that the network reaches; the reference with all,
  // of which it keeps as many as there is room for.
  EXPECT_LE(rows.rows_read, settings.backend == "opencl" ? height : 2 * height - kept / 5 * 4);
}

TEST_P(Streams, TakeRowsThatWereKept) {
  Settings settings = settings_of("learned");
  settings.backend = GetParam();
  settings.max_memory = 1 << 30;
  if (settings.backend == "opencl" && devices().empty()) GTEST_SKIP() << "no OpenCL device";
  for (const Frame& frame : frames) {
    SCOPED_TRACE(frame.name);
    const SampleBuffer samples = frame_of(frame);
    BufferRows rows(samples);
    const std::uint64_t some = 3 * rows.row_bytes(0);
    ScannedRows scanned = scan_rows(rows, settings, {}, {some, 0, 18, 3 * some});
    std::uint64_t kept = 0;
    for (const SampleBuffer& part : scanned.kept) kept += static_cast<std::uint64_t>(part.data_window.height);
    EXPECT_GE(kept, 6U);
    EXPECT_LT(kept, 12U);
    rows.rows_read = 0;
    const Result part = run_streamed(rows, std::move(scanned), settings, {}, some), whole = filter(samples, settings);
    EXPECT_EQ(rows.rows_read, 18 - static_cast<int>(kept));
    expect_same(part.image, whole.image);
    expect_same(part.features, whole.features);
  }
}

TEST_P(Streams, OfACropThatFactsAreGivenFor) {
  Settings settings = settings_of("learned");
  settings.backend = GetParam();
  if (settings.backend == "opencl" && devices().empty()) GTEST_SKIP() << "no OpenCL device";
  settings.crop = Window{-3, 112, 9, 40};
  const SampleBuffer samples = frame_of(frames[1], 300);
  BufferRows rows(samples);
  const std::uint64_t some = 7 * rows.row_bytes(0);
  ScannedRows scanned, all = scan_rows(rows, settings, {}, {some});
  scanned.facts = std::move(all.facts);
  const CleanReport& cleaned = std::get<ObservedFindings>(scanned.facts).cleaned;
  count_rows(rows, {some, 32, 208, some}, cleaned, settings, scanned);
  const Result part = run_streamed(rows, std::move(scanned), settings, {}, some), whole = filter(samples, settings);
  expect_same(part.image, whole.image);
  expect_same(part.features, whole.features);
}

INSTANTIATE_TEST_SUITE_P(Backends, Streams, testing::Values("cpu", "opencl"));

class StreamedPasses : public testing::TestWithParam<const char*> {};

TEST_P(StreamedPasses, MakeThePictureOfTheWhole) {
  Settings settings = settings_of(GetParam());
  for (const char* backend : {"cpu", "opencl"}) {
    settings.backend = backend;
    if (settings.backend == "opencl" && devices().empty()) GTEST_SKIP() << "no OpenCL device";
    expect_the_picture_of_the_whole(settings);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, StreamedPasses, testing::Values("rpf", "gaussian", "cross-bilateral"));

TEST(RowsOfAFile, AreReadOnceForTheFactsAndOnceForAllPasses) {
  BufferRows rows(frame_of(frames[0], 100));
  Settings settings = settings_of("rpf");
  settings.max_memory = 1;
  run_streamed(rows, scan_rows(rows, settings, {}, {a_row}), settings, {}, a_row);
  EXPECT_EQ(rows.rows_read, 2 * 100);
}

TEST(RowsOfAFile, AreNeededAtOnceToTellWhichChannelsTellNothing) {
  Settings settings = settings_of("rpf");
  settings.drop_uninformative = true;
  EXPECT_FALSE(can_stream(settings));
  EXPECT_EQ(test::difference_when_streamed(frame_of(frames[0]), settings, {}), "");
}

TEST(RowsOfAFile, AreReadWhereTheCropNeedsThem) {
  Settings settings = settings_of("rpf");
  settings.crop = Window{-3, 12, 9, 4};
  BufferRows rows(frame_of(frames[0]));
  const std::string facts = find_facts(rows, settings);
  rows.rows_read = 0;
  filter_rows(rows, settings, facts);
  EXPECT_EQ(rows.rows_read, 4 + 2 * (2 + 1));  // boxes 5 and 3
}

TEST(RowsOfAFile, AreFewWhereInputsThatDependOnOthersVaryAtOnce) {
  BufferRows rows(frame_of(frames[0]));
  scan_rows(rows, settings_of("learned"), {}, {a_row});
  EXPECT_EQ(rows.rows_read, 18 + 1);
}

}  // namespace
}  // namespace rpf
