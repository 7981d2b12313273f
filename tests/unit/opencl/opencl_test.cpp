// The parts of the OpenCL room that a whole run does not show: bands, build errors, seals, canaries, the self-test.
#include "opencl/opencl.h"  // first: it configures the OpenCL header

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "conformance/comparison.h"
#include "opencl/band.h"
#include "opencl/cache_index.h"
#include "opencl/cache_seal.h"
#include "opencl/kernel_source.h"
#include "opencl/self_test.h"
#include "opencl/session.h"
#include "rpf/devices.h"
#include "rpf/filter.h"
#include "temporary_folder.h"

namespace rpf {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// A frame of 3 x 10 pixels with 2 samples each and 5 variables.
Frame frame_of_ten_rows() {
  Frame frame;
  frame.width = 3;
  frame.height = 10;
  frame.variables = 5;
  for (std::uint32_t pixel = 0; pixel <= 30; ++pixel) frame.first_sample.push_back(2 * pixel);
  return frame;
}

/// No features, 3 values carried.
SampleFloats color_only() { return SampleFloats(Plan{}); }

TEST(Band, IsTheWholeFrameWhereThatFits) {
  const Frame frame = frame_of_ten_rows();
  const std::uint64_t all = band_bytes(frame, color_only(), {0, 10});
  const Rows rows = rows_that_fit(frame, color_only(), {4, 6}, {all, all});
  EXPECT_EQ(rows.begin, 0);
  EXPECT_EQ(rows.end, 10);
}

TEST(Band, IsAsManyRowsAsFitFromTheNeededOnesOn) {
  const Frame frame = frame_of_ten_rows();
  const std::uint64_t five = band_bytes(frame, color_only(), {0, 5});
  const Rows rows = rows_that_fit(frame, color_only(), {2, 4}, {five, five});
  EXPECT_EQ(rows.begin, 2);
  EXPECT_EQ(rows.end, 7);
  EXPECT_FALSE(fits(frame, color_only(), {2, 8}, {five, five}));
}

TEST(Band, RespectsTheLargestBuffer) {
  const Frame frame = frame_of_ten_rows();
  const std::uint64_t plenty = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t records_of_two_rows = 2 * 3 * 2 * RPF_LANES * sizeof(float);  // laid out: 5 variables in a vector
  EXPECT_TRUE(fits(frame, color_only(), {0, 2}, {plenty, records_of_two_rows}));
  EXPECT_FALSE(fits(frame, color_only(), {0, 3}, {plenty, records_of_two_rows}));
}

/// A frame of 64 samples a pixel whose every row of pixels reads all of it.
SampleBuffer three_long_rows() {
  constexpr int width = 13000, samples = 64;
  SampleBuffer buffer;
  buffer.layout.slots = {"R", "G", "B", "film.X", "film.Y", "random.lens.U"};
  buffer.data_window = {0, 0, width, 3};
  for (int pixel = 0; pixel < 3 * width; ++pixel) {
    buffer.first_sample.push_back(static_cast<std::uint32_t>(pixel) * samples);
    for (int i = 0; i < samples; ++i) {
      const float r = static_cast<float>(i * 7919 % samples) / samples, x = static_cast<float>(pixel % width);
      buffer.values.insert(buffer.values.end(), {r, r * x, 1, x + 0.5F, static_cast<float>(pixel / width) + r, r});
    }
  }
  buffer.first_sample.push_back(3 * width * samples);
  return buffer;
}

TEST(Band, MayTakeMoreThanUsualWhereARowOfPixelsReadsMore) {
  Settings settings;
  settings.box_widths = {3};
  settings.crop = Window{6000, 1, 4, 1};
  const Image reference = filter(three_long_rows(), settings).image;
  settings.backend = "opencl";
  EXPECT_EQ(filter(three_long_rows(), settings).image.pixels, reference.pixels);
}

TEST(KernelSource, PutsIncludesInPlaceAndSaysWhereLinesComeFrom) {
  const std::string source = kernel_source("filter.cl");
  EXPECT_THAT(source, HasSubstr("#line 1 \"numeric.h\""));
  EXPECT_THAT(source, HasSubstr("__kernel void filter_tile"));
  EXPECT_EQ(source.find("\n#include \""), std::string::npos);
}

TEST(Session, ReportsTheBuildLogWhenAKernelDoesNotCompile) {
  try {
    Session::of(0).program("filter.cl", "-DRPF_VARIABLES=nonsense");
    FAIL() << "compiled";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::device);
    EXPECT_THAT(e.what(), HasSubstr("compiling filter.cl"));
    EXPECT_THAT(e.what(), HasSubstr("use of undeclared identifier 'nonsense'"));
  }
}

TEST(SelfTest, PassesOnEveryDeviceHere) {
  ASSERT_FALSE(devices().empty());
  for (const DeviceInfo& device : devices()) EXPECT_THAT(check_device(device.index), IsEmpty()) << device.name;
}

TEST(Canaries, NoticeAWriteBehindABuffer) {
  if (!has_canaries) GTEST_SKIP() << "debug builds only";
  const cl::Context context(all_devices().front());
  cl::CommandQueue queue(context, all_devices().front());
  Canaries canaries;
  const cl::Buffer buffer = canaries.allocate(context, queue, CL_MEM_READ_WRITE, 100);
  EXPECT_NO_THROW(canaries.check(queue));
  queue.enqueueFillBuffer(buffer, std::uint8_t{0}, 96, 5);  // one byte too many
  EXPECT_THROW(canaries.check(queue), Error);
}

/// A folder as PoCL lays it out, with one compiled program.
class CacheSeal : public testing::Test {
 protected:
  CacheSeal() : program_(std::filesystem::path(folder_.path()) / "AB" / "CDEF") {
    std::filesystem::create_directories(program_ / "kernel");
    write("BC a program");
  }
  void write(const std::string& content) const { std::ofstream(program_ / "program.bc") << content; }
  bool is_kept() const {
    remove_damaged(all_programs(folder_.path()));
    return std::filesystem::exists(program_ / "program.bc");
  }

  TemporaryFolder folder_;
  std::filesystem::path program_;
};

TEST_F(CacheSeal, KeepsWhatIsSealedAndUnchanged) {
  seal(all_programs(folder_.path()));
  EXPECT_TRUE(is_kept());
}

TEST_F(CacheSeal, RemovesWhatChangedSinceItWasSealed) {
  seal(all_programs(folder_.path()));
  write("BC b program");
  EXPECT_FALSE(is_kept());
}

TEST_F(CacheSeal, KeepsUnsealedProgramsUnlessTheyAreVisiblyDamaged) {
  EXPECT_TRUE(is_kept());  // another process may be compiling it
  write("");
  EXPECT_FALSE(is_kept());
}

TEST_F(CacheSeal, SealsAgainWhenAKernelWasAdded) {
  seal(all_programs(folder_.path()));
  std::ofstream(program_ / "kernel" / "kernel.so") << "no shared object";
  seal(all_programs(folder_.path()));
  EXPECT_TRUE(is_kept());
}

TEST_F(CacheSeal, IndexKnowsTheProgramsOfASource) {
  const std::filesystem::path other = program_.parent_path() / "other";
  std::filesystem::create_directories(other);
  EXPECT_THAT(indexed_programs(folder_.path(), "source"), IsEmpty());
  index_programs(folder_.path(), "source", {program_});
  EXPECT_THAT(indexed_programs(folder_.path(), "source"), ElementsAre(program_));
  EXPECT_THAT(indexed_programs(folder_.path(), "another source"), IsEmpty());
  index_programs(folder_.path(), "source", {other});
  EXPECT_THAT(indexed_programs(folder_.path(), "source"), UnorderedElementsAre(program_, other));
}

TEST_F(CacheSeal, IndexIsNotTrustedWhereAProgramIsMissing) {
  index_programs(folder_.path(), "source", {program_});
  std::filesystem::remove_all(program_);
  EXPECT_THAT(indexed_programs(folder_.path(), "source"), IsEmpty());  // then all programs are checked
}

TEST(UlpDistance, CountsFloatsBetween) {
  const float one = 1, next = std::nextafter(1.0F, 2.0F), nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(ulp_distance(one, one), 0U);
  EXPECT_EQ(ulp_distance(one, next), 1U);
  EXPECT_EQ(ulp_distance(0.0F, -0.0F), 1U);
  EXPECT_EQ(ulp_distance(-std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::denorm_min()), 3U);
  EXPECT_EQ(ulp_distance(nan, nan), 0U);
  EXPECT_GT(ulp_distance(nan, one), 1U << 31);
}

}  // namespace
}  // namespace rpf
