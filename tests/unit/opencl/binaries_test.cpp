// What is kept of compiled programs, and how much of it.
#include "opencl/binaries.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "opencl/cache_file.h"
#include "opencl/cache_size.h"
#include "temporary_folder.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;
using std::chrono::hours;

const Binaries::Binary something = {0, 10, 255, 'a', 10, 0};

class BinariesTest : public testing::Test {
 protected:
  Binaries binaries() const { return Binaries(folder()); }
  fs::path folder() const { return fs::path(folder_.path()) / "programs"; }
  fs::path only_file() const { return fs::directory_iterator(folder())->path(); }

  TemporaryFolder folder_;
};

TEST_F(BinariesTest, AreFoundByTheirSourceInAnotherRun) {
  EXPECT_FALSE(binaries().has("a"));
  binaries().keep("a", something);
  binaries().keep("b", {1});
  EXPECT_TRUE(binaries().has("a"));
  EXPECT_EQ(binaries().find("a"), something);
  EXPECT_EQ(binaries().find("b"), Binaries::Binary{1});
  EXPECT_TRUE(binaries().find("c").empty());
  binaries().keep("a", {});
  EXPECT_TRUE(binaries().has("a"));
  EXPECT_TRUE(binaries().find("a").empty());
}

TEST_F(BinariesTest, OfEveryBitThatChangesNothingIsLeft) {
  binaries().keep("a", something);
  const fs::path file = only_file();
  const std::string whole = content_of(file);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    replace_file(file, damaged);
    EXPECT_FALSE(binaries().has("a")) << bit;
    EXPECT_FALSE(fs::exists(file)) << bit;
  }
  for (std::size_t size = 0; size < whole.size(); ++size) {
    replace_file(file, whole.substr(0, size));
    EXPECT_TRUE(binaries().find("a").empty()) << size;
  }
}

TEST_F(BinariesTest, WithoutAFolderNothingIsKept) {
  const Binaries nowhere{fs::path()};
  nowhere.keep("a", something);
  EXPECT_FALSE(nowhere.has("a"));
  std::ofstream(folder_.path() + "/file") << "in its place";
  const Binaries blocked{fs::path(folder_.path()) / "file"};
  blocked.keep("a", something);
  EXPECT_FALSE(blocked.has("a"));
}

class CacheSizeTest : public testing::Test {
 protected:
  /// A file or, where `parts` says so, a folder of 1000 bytes, used so many hours ago.
  fs::path add(const std::string& name, int age, int parts = 0) const {
    const fs::path path = fs::path(folder_.path()) / name;
    if (parts == 0) replace_file(path, std::string(1000, 'x'));
    for (int i = 0; i < parts; ++i) replace_file(path / std::to_string(i) / "part", std::string(1000U / parts, 'x'));
    fs::last_write_time(path, fs::file_time_type::clock::now() - hours(age));
    return path;
  }

  TemporaryFolder folder_;
};

TEST_F(CacheSizeTest, WhatWasLongestNotUsedGoesFirst) {
  const std::vector<fs::path> all = {add("b", 3), add("d", 9, 2), add("a", 2, 4), add("c", 5)};
  prune(all, 4000);
  for (const fs::path& path : all) EXPECT_TRUE(fs::exists(path)) << path;
  mark_used(all[1]);
  prune(all, 2000);
  EXPECT_FALSE(fs::exists(all[3]));
  EXPECT_FALSE(fs::exists(all[0]));
  EXPECT_TRUE(fs::exists(all[1]));
  EXPECT_TRUE(fs::exists(all[2]));
}

TEST_F(CacheSizeTest, WhatMayBeInUseStays) {
  const std::vector<fs::path> all = {add("now", 0), add("now too", 0, 3), add("old", 2), fs::path("nowhere")};
  prune(all, 0);
  EXPECT_TRUE(fs::exists(all[0]));
  EXPECT_TRUE(fs::exists(all[1]));
  EXPECT_FALSE(fs::exists(all[2]));
}

}  // namespace
}  // namespace rpf
