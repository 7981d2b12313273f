// The limit that a run really has: control groups as Docker, Slurm and systemd make them.
#include "run/control_groups.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <utility>

#include "rpf/filter.h"
#include "temporary_folder.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max(), megabyte = 1 << 20;
constexpr int unlimited_threads = std::numeric_limits<int>::max();

class ControlGroups : public testing::Test {
 protected:
  void write(const fs::path& file, const std::string& content) const {
    const fs::path path = root() / file;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << content << "\n";
  }
  void mount_unified(const std::string& top) const {
    write("proc/self/mountinfo", "24 1 0:22 / /proc rw - proc proc rw\n30 24 0:26 " + top +
                                     " /sys/fs/cgroup rw,nosuid shared:9 master:3 - cgroup2 cgroup rw,nsdelegate");
  }
  void mount_memory(const std::string& top) const {
    write("proc/self/mountinfo", "31 25 0:27 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu\n33 25 0:29 " + top +
                                     " /sys/fs/cgroup/memory rw shared:12 - cgroup cgroup rw,memory\n"
                                     "34 25 0:30 / /sys/fs/cgroup/unified rw - cgroup2 cgroup rw");
  }
  std::uint64_t limit() const { return control_group_memory(root()); }
  int threads() const { return control_group_threads(root()); }

 private:
  fs::path root() const { return folder_.path(); }
  TemporaryFolder folder_;
};

TEST_F(ControlGroups, NoneIsNoLimit) {
  EXPECT_EQ(limit(), unlimited);
  mount_unified("/");
  write("proc/self/cgroup", "0::/");
  EXPECT_EQ(limit(), unlimited);
}

TEST_F(ControlGroups, Version2BelowTheRootAndItsParents) {
  mount_unified("/");
  write("proc/self/cgroup", "0::/slurm/job_7/step_0");
  write("sys/fs/cgroup/slurm/job_7/step_0/memory.max", "max");
  EXPECT_EQ(limit(), unlimited);
  write("sys/fs/cgroup/slurm/job_7/memory.max", std::to_string(300 * megabyte));
  write("sys/fs/cgroup/slurm/memory.max", std::to_string(900 * megabyte));
  write("sys/fs/cgroup/slurm/job_8/memory.max", "1");  // another job's
  EXPECT_EQ(limit(), 300 * megabyte);
  write("sys/fs/cgroup/slurm/memory.max", std::to_string(200 * megabyte));
  EXPECT_EQ(limit(), 200 * megabyte);
}

TEST_F(ControlGroups, Version1AndItsParents) {
  mount_memory("/");
  write("proc/self/cgroup", "9:cpu:/other\n4:memory:/slurm/job_7\n0::/");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
  write("sys/fs/cgroup/memory/slurm/job_7/memory.limit_in_bytes", std::to_string(500 * megabyte));
  write("sys/fs/cgroup/memory/other/memory.limit_in_bytes", "1");
  EXPECT_EQ(limit(), 500 * megabyte);
  write("sys/fs/cgroup/memory/slurm/memory.limit_in_bytes", std::to_string(400 * megabyte));
  EXPECT_EQ(limit(), 400 * megabyte);
}

TEST_F(ControlGroups, ControllersThatAreMountedTogether) {
  write("proc/self/mountinfo", "33 25 0:29 / /sys/fs/cgroup/cpu,memory rw - cgroup cgroup rw,cpu,memory");
  write("proc/self/cgroup", "4:cpu,memory:/job");
  write("sys/fs/cgroup/cpu,memory/job/memory.limit_in_bytes", "1000");
  EXPECT_EQ(limit(), 1000U);
}

TEST_F(ControlGroups, AContainerThatSeesItsOwnGroupOnly) {
  // The host's name of the group, but its folder is mounted: Docker with version 1.
  mount_memory("/docker/abc");
  write("proc/self/cgroup", "4:memory:/docker/abc");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "2000");
  EXPECT_EQ(limit(), 2000U);
  write("proc/self/cgroup", "4:memory:/docker/abc/inner");
  write("sys/fs/cgroup/memory/inner/memory.limit_in_bytes", "1500");
  EXPECT_EQ(limit(), 1500U);
  // A name outside of what is mounted, and one of a namespace.
  for (const char* name : {"4:memory:/kubepods/xyz", "4:memory:/../../job", "4:memory:/"}) {
    write("proc/self/cgroup", name);
    EXPECT_EQ(limit(), 2000U) << name;
  }
}

TEST_F(ControlGroups, ProcessorsOfVersion2AndItsParents) {
  EXPECT_EQ(threads(), unlimited_threads);
  mount_unified("/");
  write("proc/self/cgroup", "0::/slurm/job_7/step_0");
  write("sys/fs/cgroup/slurm/job_7/step_0/cpu.max", "max 100000");
  EXPECT_EQ(threads(), unlimited_threads);
  write("sys/fs/cgroup/slurm/job_7/cpu.max", "1200000 100000");
  write("sys/fs/cgroup/slurm/job_8/cpu.max", "1000 100000");  // another job's
  EXPECT_EQ(threads(), 12);
  write("sys/fs/cgroup/slurm/cpu.max", "150000 50000");  // in shorter periods
  EXPECT_EQ(threads(), 3);
}

TEST_F(ControlGroups, ProcessorsOfVersion1AndItsParents) {
  mount_memory("/");
  write("proc/self/cgroup", "9:cpu:/docker/abc\n4:memory:/docker/abc\n0::/");
  const fs::path cpu = "sys/fs/cgroup/cpu/docker/abc";
  write(cpu / "cpu.cfs_quota_us", "-1");
  write(cpu / "cpu.cfs_period_us", "100000");
  EXPECT_EQ(threads(), unlimited_threads);
  write("sys/fs/cgroup/cpu/docker/cpu.cfs_quota_us", "400000");
  write("sys/fs/cgroup/cpu/docker/cpu.cfs_period_us", "100000");
  EXPECT_EQ(threads(), 4);
  write(cpu / "cpu.cfs_quota_us", "50000");
  EXPECT_EQ(threads(), 1);
}

TEST_F(ControlGroups, APartOfAProcessorIsAThread) {
  mount_unified("/");
  write("proc/self/cgroup", "0::/job");
  for (const auto& [quota, expected] : {std::pair("1000 100000", 1), {"100000 100000", 1}, {"150000 100000", 2}}) {
    write("sys/fs/cgroup/job/cpu.max", quota);
    EXPECT_EQ(threads(), expected) << quota;
  }
}

TEST_F(ControlGroups, StrangeFilesAreNoLimit) {
  write("proc/self/mountinfo", "\n1 2 3\n30 24 0:26 / /sys/fs/cgroup rw - cgroup2 cgroup rw\n- - - -");
  write("proc/self/cgroup", "0::/job\n:\nnonsense");
  write("sys/fs/cgroup/job/memory.max", "many");
  EXPECT_EQ(limit(), unlimited);
  for (const char* quota : {"", "100000", "0 100000", "100000 0", "-5 100000", "a b"}) {
    write("sys/fs/cgroup/job/cpu.max", quota);
    EXPECT_EQ(threads(), unlimited_threads) << quota;
  }
}

TEST(AvailableMemory, IsSomething) { EXPECT_GT(available_memory(), megabyte); }

}  // namespace
}  // namespace rpf
