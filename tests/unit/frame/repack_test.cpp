// Records of another width in the place of those that were read: shorter, longer, by several threads.
#include "frame/repack.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>

namespace rpf {
namespace {

constexpr std::size_t columns = 6;

/// Records whose values say where they are from.
SampleBuffer counted(std::size_t samples, std::size_t room) {
  SampleBuffer buffer;
  buffer.layout.slots = {"R", "G", "B", "film.X", "film.Y", "time"};
  buffer.data_window = buffer.display_window = {0, 0, 1, 1};
  buffer.first_sample = {0, static_cast<std::uint32_t>(samples)};
  buffer.values.reserve(samples * room);
  buffer.values.resize(samples * columns);
  std::iota(buffer.values.begin(), buffer.values.end(), 0.0F);
  return buffer;
}

/// Of a record: its columns from the last on, over and over.
std::vector<float> repacked(SampleBuffer samples, std::size_t width, int threads) {
  const ColumnBlock block({0, 1, 2, 3, 4, 5}, columns);
  return repack(samples, width, block, threads, [&](const ColumnBlock& records, float* to) {
    for (std::size_t i = 0; i < records.count(); ++i)
      for (std::size_t k = 0; k < width; ++k) *to++ = records[columns - 1 - k % columns][i];
  });
}

/// Sizes around those of blocks and pieces; with no room for longer records, and with it.
TEST(Repack, MakesEveryRecordOfItsOwn) {
  for (const std::size_t samples : {std::size_t{0}, std::size_t{1}, block_records - 1, block_records + 1, piece_records,
                                    5 * piece_records + 3 * block_records + 7})
    for (const std::size_t width : {1U, 4U, 6U, 7U, 11U})
      for (const std::size_t room : {columns, std::size_t{11}})
        for (const int threads : {1, 2, 5}) {
          const std::vector<float> made = repacked(counted(samples, room), width, threads);
          ASSERT_EQ(made.size(), samples * width);
          for (std::size_t i = 0; i < made.size(); ++i)
            ASSERT_EQ(made[i], static_cast<float>(i / width * columns + columns - 1 - i % width % columns))
                << samples << " samples, width " << width << ", room " << room << ", threads " << threads << ", " << i;
        }
}

/// A thread may write only where all was read, whoever was to read it: with a thread that stops in the middle of its
/// turn, the others wait.
TEST(Repack, WaitsForWhatIsStillToBeRead) {
  RepackOrder order(3 * piece_records, 4, 8, true);  // longer: from the last on
  EXPECT_EQ(order.records(0), std::make_pair(2 * piece_records, 3 * piece_records));
  EXPECT_TRUE(order.may_write(0));  // behind the end of what was there
  EXPECT_EQ(order.records(2), std::make_pair(std::size_t{0}, piece_records));
  RepackOrder shorter(3 * piece_records, 8, 4, true);
  EXPECT_EQ(shorter.records(0), std::make_pair(std::size_t{0}, piece_records));
  EXPECT_FALSE(shorter.is_free(0));  // what is read for them lies there itself
  EXPECT_FALSE(shorter.is_free(1));
  std::atomic<bool> written{false};
  std::thread second([&] {
    EXPECT_TRUE(shorter.may_write(1));  // over the last half of the first piece
    written = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(written);
  EXPECT_TRUE(shorter.may_write(0));
  second.join();
  EXPECT_TRUE(written);
  EXPECT_TRUE(shorter.is_free(1));
}

}  // namespace
}  // namespace rpf
