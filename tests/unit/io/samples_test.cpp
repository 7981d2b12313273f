// Sample files that are right: what goes in comes out.
#include <gtest/gtest.h>

#include "deep_files.h"
#include "rpf/io.h"
#include "rpf/rows.h"
#include "same_bits.h"
#include "temporary_folder.h"

namespace {

using namespace deep_files;
using rpf::SampleBuffer;
using rpf::Window;
using rpf::test::same_bits;

void expect_round_trip(const SampleBuffer& samples) {
  const TemporaryFolder folder;
  const std::string path = folder.file("samples.exr");
  rpf::write_samples(path, samples);
  const SampleBuffer back = rpf::read_samples(path);
  EXPECT_EQ(back.data_window, samples.data_window);
  EXPECT_EQ(back.display_window, samples.display_window);
  EXPECT_EQ(back.layout.slots, samples.layout.slots);
  EXPECT_EQ(back.first_sample, samples.first_sample);
  EXPECT_TRUE(same_bits(back.values, samples.values));
  EXPECT_EQ(folder.entry_count(), 1U);
}

// The file's channels are sorted by name; sample s of channel c has value(c, s).
void expect_recipe_values(const Recipe& recipe, const SampleBuffer& samples) {
  for (std::size_t c = 0; c < recipe.channels.size(); ++c) {
    const auto column = samples.layout.find(recipe.channels[c]);
    if (!column) continue;
    for (std::size_t s = 0; s < samples.sample_count(); ++s)
      ASSERT_EQ(samples.record(s)[*column], value(c, s)) << recipe.channels[c] << " of sample " << s;
  }
}

TEST(Samples, RoundTripIsLosslessForAnyWindow) {
  for (const Window window : {Window{0, 0, 5, 4}, Window{-7, -3, 6, 2}, Window{100000, 5, 3, 3}, Window{0, 0, 1, 1},
                              Window{3, 2, 1, 9}, Window{-1, 0, 9, 1}})
    expect_round_trip(make_buffer(window, [](int) { return 3U; }));
}

TEST(Samples, RoundTripIsLosslessForAnyCounts) {
  const Window window{0, 0, 7, 5};
  expect_round_trip(make_buffer(window, [](int) { return 0U; }));
  expect_round_trip(make_buffer(window, [](int pixel) { return static_cast<unsigned>(pixel * 7 % 5); }));
  expect_round_trip(make_buffer(window, [](int pixel) { return pixel / 7 == 2 ? 0U : 1U; }));
  expect_round_trip(make_buffer(window, [](int pixel) { return pixel == 34 ? 1000U : 0U; }));
}

TEST(Samples, TheDisplayWindowIsItsOwn) {
  SampleBuffer samples = make_buffer({2, 1, 4, 3}, [](int) { return 1U; });
  samples.display_window = {-10, 0, 64, 48};
  expect_round_trip(samples);
}

TEST(Samples, MetadataTravels) {
  const TemporaryFolder folder;
  SampleBuffer samples = make_buffer({0, 0, 2, 2}, [](int) { return 1U; });
  samples.metadata = {{"rpf:seed", 7},
                      {"rpf:renderer", std::string("Mitsuba 3.9.1, \xC3\xA4")},
                      {"shutter", 0.25F},
                      {"rpf:worldOrigin", std::vector<float>{1, 2, 3}},
                      {"two", std::vector<float>{1, 2}},
                      {"five", std::vector<float>(5, 0.5F)},
                      {"m33", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}},
                      {"worldToCamera", std::vector<float>(16, 2)},
                      {"chromaticities", std::vector<float>{.64F, .33F, .3F, .6F, .15F, .06F, .3127F, .329F}}};
  rpf::write_samples(folder.file("a.exr"), samples);
  const SampleBuffer back = rpf::read_samples(folder.file("a.exr"));
  for (const auto& [name, attribute] : samples.metadata) EXPECT_EQ(back.metadata.at(name), attribute) << name;
  // The description of the file itself is no metadata: a picture made from it must not claim to be a sample file.
  for (const char* name : {"rpf:format", "rpf:version", "channels", "dataWindow", "compression", "type", "chunkCount"})
    EXPECT_EQ(back.metadata.count(name), 0U) << name;
  rpf::write_samples(folder.file("b.exr"), back);
  EXPECT_EQ(file_bytes(folder.file("a.exr")), file_bytes(folder.file("b.exr")));
}

TEST(Samples, HalfSlotsAreStoredAsHalf) {
  const TemporaryFolder folder;
  SampleBuffer samples = make_buffer({-2, 5, 6, 3}, [](int pixel) { return static_cast<unsigned>(pixel % 4); });
  for (std::size_t i = 0; i < samples.values.size(); ++i) samples.values[i] = static_cast<float>(i % 2048) * 0.25F;
  rpf::write_samples(folder.file("half.exr"), samples, {"feature.N.X", "random.time"});
  for (const rpf::SampleFileChannel& channel : rpf::inspect_samples(folder.file("half.exr")).channels) {
    const bool is_half = channel.name == "feature.N.X" || channel.name == "random.time";
    EXPECT_EQ(channel.type, is_half ? rpf::PixelType::half_float : rpf::PixelType::full_float) << channel.name;
  }
  EXPECT_TRUE(same_bits(rpf::read_samples(folder.file("half.exr")).values, samples.values));
  expect_error(error_of([&] { rpf::write_samples(folder.file("x.exr"), samples, {"feature.N.x"}); }),
               rpf::ErrorKind::usage, {"feature.N.x", "\"feature.N.X\""});
}

TEST(Samples, EveryCompressionAndLineOrderOfDeepFiles) {
  const TemporaryFolder folder;
  for (const auto& [compression, name] :
       {std::pair{Imf::NO_COMPRESSION, "none"}, {Imf::RLE_COMPRESSION, "rle"}, {Imf::ZIPS_COMPRESSION, "zips"}})
    for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
      Recipe recipe;
      recipe.data_window = {-7, -3, 5, 6};
      recipe.compression = compression;
      recipe.line_order = order;
      recipe.counts = [](int pixel) { return static_cast<unsigned>(pixel % 3); };
      write_deep(folder.file("a.exr"), recipe);
      EXPECT_EQ(rpf::inspect_samples(folder.file("a.exr")).compression, name);
      expect_recipe_values(recipe, rpf::read_samples(folder.file("a.exr")));
    }
}

TEST(Samples, UnusedChannelsAreSkippedWhateverTheirType) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.channels = {"B", "G", "R", "Z", "film.X", "film.Y", "id", "random.lens.U"};
  recipe.types = {Imf::HALF, Imf::HALF, Imf::HALF, Imf::FLOAT, Imf::FLOAT, Imf::FLOAT, Imf::UINT, Imf::HALF};
  write_deep(folder.file("a.exr"), recipe);
  const SampleBuffer samples = rpf::read_samples(folder.file("a.exr"));
  EXPECT_EQ(samples.layout.slots, (std::vector<std::string>{"R", "G", "B", "film.X", "film.Y", "random.lens.U"}));
  expect_recipe_values(recipe, samples);
}

TEST(Samples, InspectCountsWithoutReadingValues) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.data_window = {0, 0, 4, 3};
  recipe.counts = [](int pixel) { return pixel == 5 ? 9U : static_cast<unsigned>(pixel % 2); };
  write_deep(folder.file("a.exr"), recipe);
  const rpf::SampleFileInfo info = rpf::inspect_samples(folder.file("a.exr"));
  EXPECT_EQ(info.sample_count, 9U + 5U);
  EXPECT_EQ(info.min_samples, 0U);
  EXPECT_EQ(info.max_samples, 9U);
  EXPECT_EQ(info.empty_pixels, 6U);
  EXPECT_EQ(info.data_window, recipe.data_window);
  ASSERT_EQ(info.channels.size(), recipe.channels.size());
  EXPECT_EQ(info.channels[3].slot, "film.X");
}

TEST(Samples, FilmChannelsAloneMarkASampleFile) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.marker = "";
  write_deep(folder.file("a.exr"), recipe);
  EXPECT_EQ(rpf::read_samples(folder.file("a.exr")).sample_count(), 24U);
}

TEST(Samples, AliasesAndMapWorkOnFiles) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.channels = {"COLOR_B", "COLOR_G", "COLOR_R", "IMAGE_X", "IMAGE_Y", "LENS_U", "mine"};
  recipe.marker = "";
  write_deep(folder.file("a.exr"), recipe);
  rpf::SampleReadOptions options;
  options.slot_map = {{"feature.depth", "mine"}, {"random.lens.U", ""}};
  const SampleBuffer samples = rpf::read_samples(folder.file("a.exr"), options);
  EXPECT_EQ(samples.layout.slots, (std::vector<std::string>{"R", "G", "B", "film.X", "film.Y", "feature.depth"}));
  EXPECT_EQ(samples.record(3)[0], value(2, 3));
  EXPECT_EQ(samples.record(3)[5], value(6, 3));
}

// Rows of many samples and of odd sizes, half and float side by side: against OpenEXR's own writer.
TEST(Samples, WideRowsOfEveryCompression) {
  const TemporaryFolder folder;
  for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION})
    for (const unsigned most : {1U, 7U}) {
      Recipe recipe;
      recipe.data_window = {-5, 3, 333, 3};
      recipe.compression = compression;
      recipe.types = {Imf::HALF, Imf::FLOAT, Imf::HALF};
      recipe.counts = [&](int pixel) { return static_cast<unsigned>(pixel) % (most + 1); };
      write_deep(folder.file("a.exr"), recipe);
      const SampleBuffer samples = rpf::read_samples(folder.file("a.exr"));
      for (std::size_t s = 0; s < samples.sample_count(); ++s)
        for (std::size_t c = 0; c < recipe.channels.size(); ++c)
          ASSERT_EQ(samples.record(s)[*samples.layout.find(recipe.channels[c])], value(c, s))
              << compression << ": sample " << s << ", channel " << recipe.channels[c];
    }
}

// As many rows as several threads get, and more threads than that.
TEST(Samples, ThreadsUnpackTheSameRows) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.data_window = {4, -9, 13, 77};
  recipe.compression = Imf::ZIPS_COMPRESSION;
  recipe.counts = [](int pixel) { return static_cast<unsigned>(pixel * 11 % 6); };
  write_deep(folder.file("a.exr"), recipe);
  for (const int threads : {1, 2, 3, 64}) {
    rpf::SampleReadOptions options;
    options.threads = threads;
    const SampleBuffer samples = rpf::read_samples(folder.file("a.exr"), options);
    for (std::uint32_t pixel = 0; pixel < 13 * 77; ++pixel)
      ASSERT_EQ(samples.first_sample[pixel + 1] - samples.first_sample[pixel], recipe.counts(static_cast<int>(pixel)));
    expect_recipe_values(recipe, samples);
  }
}

TEST(Samples, OnlyWantedSlotsAreReadButAllAreInspected) {
  const TemporaryFolder folder;
  write_deep(folder.file("a.exr"), {});
  const SampleBuffer all = rpf::read_samples(folder.file("a.exr"));
  rpf::write_samples(folder.file("a.rpf"), all);
  rpf::SampleReadOptions options;
  options.slots = {"R", "G", "B", "film.X", "film.Y", "not.there"};
  for (const char* name : {"a.exr", "a.rpf"}) {
    const SampleBuffer some = rpf::read_samples(folder.file(name), options);
    ASSERT_EQ(some.layout.slots, (std::vector<std::string>{"R", "G", "B", "film.X", "film.Y"})) << name;
    ASSERT_GT(all.layout.size(), some.layout.size());
    for (std::size_t i = 0; i < all.sample_count(); ++i)
      for (std::size_t c = 0; c < 5; ++c) ASSERT_EQ(some.record(i)[c], all.record(i)[c]) << name;
    std::size_t listed = 0;
    for (const auto& channel : rpf::inspect_samples(folder.file(name), options).channels)
      listed += channel.slot.empty() ? 0 : 1;
    EXPECT_EQ(listed, all.layout.size()) << name;
  }
}

TEST(Samples, TheMemoryBudgetIsCheckedBeforehand) {
  const TemporaryFolder folder;
  Recipe recipe;
  recipe.data_window = {0, 0, 300, 300};
  recipe.counts = [](int) { return 4U; };
  write_deep(folder.file("a.exr"), recipe);
  rpf::SampleReadOptions options;
  options.threads = 1;                          // each needs room for a row
  options.max_memory = std::uint64_t{8} << 20;  // 300 * 300 * 4 samples of 24 bytes are 8.2 MB, and more is needed
  expect_error(error_of([&] { rpf::read_samples(folder.file("a.exr"), options); }), rpf::ErrorKind::memory,
               {"a.exr", "needs 9 MB", "limit is 8 MB", "--max-memory"});
  EXPECT_EQ(rpf::inspect_samples(folder.file("a.exr"), options).sample_count, 360000U);
  options.max_memory = std::uint64_t{16} << 20;
  EXPECT_EQ(rpf::read_samples(folder.file("a.exr"), options).sample_count(), 360000U);
}

TEST(Samples, RowsThatAreCopiedMakeTheFileOfTheWhole) {
  const TemporaryFolder folder;
  // Pieces of several rows, of one, and a row that is more than a piece.
  const SampleBuffer samples = make_buffer(
      {-3, 5, 40, 64}, [](int pixel) { return pixel == 999 ? 200000U : static_cast<unsigned>(pixel * 7 % 97); });
  for (const std::string kind : {".exr", ".rpf"}) {
    rpf::write_samples(folder.file("whole" + kind), samples);
    const auto rows = rpf::open_sample_rows(folder.file("whole" + kind));
    for (const std::string copy : {".exr", ".rpf"}) {
      rpf::write_samples(folder.file("expected" + copy), rpf::read_samples(folder.file("whole" + kind)));
      rpf::write_sample_rows(folder.file("copy" + copy), *rows);
      EXPECT_TRUE(file_bytes(folder.file("copy" + copy)) == file_bytes(folder.file("expected" + copy))) << kind << copy;
    }
  }
}

TEST(Samples, CopyingRowsTellsHowFarItIsAndCanBeCancelled) {
  const TemporaryFolder folder;
  rpf::write_samples(folder.file("a.exr"), make_buffer({0, 0, 700, 700}, [](int) { return 1U; }));
  const auto rows = rpf::open_sample_rows(folder.file("a.exr"));
  double latest = 0;
  rpf::Control control;
  control.progress = [&](const rpf::Progress& progress) {
    EXPECT_GT(progress.fraction, latest);
    latest = progress.fraction;
    return progress.fraction < 0.5;
  };
  expect_error(error_of([&] { rpf::write_sample_rows(folder.file("b.exr"), *rows, {}, control); }),
               rpf::ErrorKind::cancelled, {"nothing was written"});
  EXPECT_EQ(folder.entry_count(), 1U);
  control.progress = [&](const rpf::Progress& progress) {
    latest = progress.fraction;
    return true;
  };
  rpf::write_sample_rows(folder.file("b.exr"), *rows, {}, control);
  EXPECT_EQ(latest, 1);
}

TEST(Samples, WritingRefusesABufferThatIsNone) {
  const TemporaryFolder folder;
  SampleBuffer samples = make_buffer({0, 0, 2, 2}, [](int) { return 1U; });
  samples.values.pop_back();
  EXPECT_THROW(rpf::write_samples(folder.file("a.exr"), samples), rpf::Error);
  EXPECT_EQ(folder.entry_count(), 0U);
}

}  // namespace
