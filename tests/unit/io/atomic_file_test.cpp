// Outputs are whole or untouched, and no error of a write is lost.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>

#include "deep_files.h"
#include "io/atomic_file.h"
#include "io/checked_writer.h"
#include "io/hidden_files.h"
#include "temporary_folder.h"

namespace {

using namespace deep_files;
using rpf::ErrorKind;
using rpf::io::AtomicFile;
using rpf::io::CheckedWriter;

// A file system of 64 KiB in a folder of its own.
class SmallDisk {
 public:
  SmallDisk() : mounted_(::mount("rpf-test", folder_.path().c_str(), "tmpfs", 0, "size=64k") == 0) {}
  ~SmallDisk() {
    if (mounted_) ::umount(folder_.path().c_str());
  }
  bool mounted() const { return mounted_; }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
  bool mounted_;
};

// More than 64 KiB in any format: noise does not compress.
rpf::Image noise_image(int side) {
  rpf::Image image;
  image.data_window = image.display_window = {0, 0, side, side};
  image.channels = {"R", "G", "B"};
  std::uint32_t state = 1;
  for (std::size_t i = 0; i < image.data_window.pixel_count() * 3; ++i) {
    state = state * 1664525U + 1013904223U;
    image.pixels.push_back(static_cast<float>(state >> 8) / 16777216.0F);
  }
  return image;
}

void put(const AtomicFile& file, const std::string& text) {
  ASSERT_EQ(::write(file.descriptor(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

TEST(AtomicFile, CommitReplacesTheTargetAndLeavesNothingElse) {
  const TemporaryFolder folder;
  write_bytes(folder.file("out.exr"), "old");
  AtomicFile file(folder.file("out.exr"));
  EXPECT_EQ(std::filesystem::path(file.temporary_path()).parent_path(), folder.path());
  EXPECT_EQ(std::filesystem::path(file.temporary_path()).extension(), ".exr");
  EXPECT_EQ(std::filesystem::path(file.temporary_path()).filename().string()[0], '.');
  put(file, "new");
  EXPECT_EQ(file_bytes(folder.file("out.exr")), "old");
  file.commit();
  EXPECT_EQ(file_bytes(folder.file("out.exr")), "new");
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(AtomicFile, WithoutCommitTheTargetIsUntouched) {
  const TemporaryFolder folder;
  write_bytes(folder.file("out.exr"), "old");
  {
    const AtomicFile file(folder.file("out.exr")), other(folder.file("out.exr"));
    EXPECT_NE(file.temporary_path(), other.temporary_path());
    put(file, "new");
  }
  EXPECT_EQ(file_bytes(folder.file("out.exr")), "old");
  EXPECT_EQ(folder.entry_count(), 1U);
}

// ".rpf-<host>-<process>-<n>.exr" of this host and a process.
std::string hidden_of(pid_t process, int number) {
  const std::string name = rpf::io::hidden_name("");
  const auto host = name.rfind('-', name.rfind('-') - 1);
  return name.substr(0, host) + "-" + std::to_string(process) + "-" + std::to_string(number) + ".exr";
}

pid_t dead_process() {
  const pid_t process = ::fork();
  if (process == 0) ::_exit(0);
  ::waitpid(process, nullptr, 0);
  return process;
}

TEST(AtomicFile, RemovesWhatDeadProcessesOfThisHostLeft) {
  const TemporaryFolder folder;
  const std::string dead = hidden_of(dead_process(), 0), alive = hidden_of(::getppid(), 0);
  for (const std::string& name : {dead, alive, std::string(".rpf-notes.exr"), std::string("rpf-a-123-0.exr")})
    write_bytes(folder.file(name), "old");
  std::filesystem::create_directory(folder.file(hidden_of(dead_process(), 1)));
  AtomicFile file(folder.file("out.exr"));
  put(file, "new");
  const AtomicFile other(folder.file("another.exr"));  // of this process or of another one: both write
  EXPECT_FALSE(std::filesystem::exists(folder.file(dead)));
  EXPECT_TRUE(std::filesystem::exists(folder.file(alive)));
  EXPECT_EQ(folder.entry_count(), 4U + 2U);
  file.commit();
  EXPECT_EQ(file_bytes(folder.file("out.exr")), "new");
}

// Locks of network disks may be local to a machine: that nobody here holds one says nothing about the others.
TEST(AtomicFile, RemovesWhatOtherHostsLeftAfterADayOnly) {
  const TemporaryFolder folder;
  const std::string young = folder.file(".rpf-render-17_0badcafe-1-0.exr"),
                    old = folder.file(".rpf-render-18_0-1-0.exr");
  for (const std::string& path : {young, old}) write_bytes(path, "frame");
  const auto now = std::filesystem::file_time_type::clock::now();
  std::filesystem::last_write_time(young, now - std::chrono::hours(23));
  std::filesystem::last_write_time(old, now - std::chrono::hours(25));
  const AtomicFile file(folder.file("out.exr"));
  EXPECT_TRUE(std::filesystem::exists(young));
  EXPECT_FALSE(std::filesystem::exists(old));
}

TEST(AtomicFile, TargetsThatCannotBe) {
  const TemporaryFolder folder;
  const auto error_for = [](const std::string& target) { return error_of([&] { const AtomicFile file(target); }); };
  expect_error(error_for(folder.file("missing/out.exr")), ErrorKind::output,
               {"missing/out.exr", "No such file", "make the folder first"});
  expect_error(error_for(folder.path()), ErrorKind::output, {"is a folder"});
  write_bytes(folder.file("file"), "");
  expect_error(error_for(folder.file("file/out.exr")), ErrorKind::output, {"Not a directory"});
  expect_error(error_for("/dev/null"), ErrorKind::output, {"\"/dev/null\"", "a device"});
  expect_error(error_for("/dev/full"), ErrorKind::output, {"\"/dev/full\"", "a device"});
  expect_error(error_for("/proc/out.exr"), ErrorKind::output, {"/proc/out.exr"});
  expect_error(error_for(""), ErrorKind::usage, {"empty"});
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(AtomicFile, ASymbolicLinkStays) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("real"));
  write_bytes(folder.file("real/out.exr"), "old");
  std::filesystem::create_symlink("real/out.exr", folder.file("link.exr"));
  AtomicFile file(folder.file("link.exr"));
  put(file, "new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.exr")));
  EXPECT_EQ(file_bytes(folder.file("real/out.exr")), "new");
}

TEST(AtomicFile, ATargetThatBecameAFolderIsAnErrorAtCommit) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder.file("out.exr"));
    std::filesystem::create_directory(folder.file("out.exr"));
    expect_error(error_of([&] { file.commit(); }), ErrorKind::output, {"out.exr"});
  }
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(CheckedWriter, WritesAndSeeks) {
  const TemporaryFolder folder;
  const int descriptor = ::open(folder.file("a").c_str(), O_RDWR | O_CREAT, 0600);
  CheckedWriter writer(descriptor, "a");
  const std::string large(700000, 'x');
  EXPECT_TRUE(writer.write("0123456789", 10));
  EXPECT_TRUE(writer.write(large.data(), large.size()));
  EXPECT_EQ(writer.position(), 700010U);
  EXPECT_TRUE(writer.seek(3));
  EXPECT_TRUE(writer.write("abc", 3));
  EXPECT_EQ(writer.position(), 6U);
  EXPECT_EQ(writer.size(), 700010U);
  writer.finish();
  ::close(descriptor);
  EXPECT_EQ(file_bytes(folder.file("a")), "012abc6789" + large);
}

TEST(CheckedWriter, AFullDiskIsReportedAtFinish) {
  const int descriptor = ::open("/dev/full", O_WRONLY);
  ASSERT_GE(descriptor, 0);
  CheckedWriter writer(descriptor, "out.exr");
  EXPECT_TRUE(writer.write("abc", 3));  // still in the buffer
  expect_error(error_of([&] { writer.finish(); }), ErrorKind::output, {"out.exr", "No space left", "free space"});
  EXPECT_TRUE(writer.failed());
  EXPECT_FALSE(writer.write("abc", 3));
  EXPECT_THROW(writer.finish(), rpf::Error);
  ::close(descriptor);
}

TEST(FullDisk, EveryWriterFailsAndTheOldTargetSurvives) {
  const SmallDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "mounting a file system is not permitted";
  const TemporaryFolder& folder = disk.folder();
  for (const char* name : {"a.exr", "a.tif", "a.hdr", "a.png", "a.jpg", "a.bmp", "a.tga", "a.gif", "a.webp", "a.ppm"}) {
    write_bytes(folder.file(name), "old");
    expect_error(error_of([&] { rpf::write_image(folder.file(name), noise_image(512)); }), ErrorKind::output,
                 {name, "No space left"});
    EXPECT_EQ(file_bytes(folder.file(name)), "old");
    std::filesystem::remove(folder.file(name));
    EXPECT_EQ(folder.entry_count(), 0U) << name;
  }
  write_bytes(folder.file("a.exr"), "old");
  expect_error(error_of([&] {
                 rpf::write_samples(folder.file("a.exr"), make_buffer({0, 0, 99, 99}, [](int) { return 9U; }));
               }),
               ErrorKind::output, {"a.exr", "No space left"});
  EXPECT_EQ(file_bytes(folder.file("a.exr")), "old");
  EXPECT_EQ(folder.entry_count(), 1U);
}

// The case that OpenEXR's own writer reports as success: the disk is full already and the file is small.
TEST(FullDisk, SmallFilesFailToo) {
  const SmallDisk disk;
  if (!disk.mounted()) GTEST_SKIP() << "mounting a file system is not permitted";
  write_bytes(disk.folder().file("ballast"), std::string(64 * 1024, 'x'));
  for (const char* name : {"a.exr", "a.png", "a.jpg"})
    expect_error(error_of([&] { rpf::write_image(disk.folder().file(name), noise_image(4)); }), ErrorKind::output,
                 {name, "No space left"});
  expect_error(error_of([&] {
                 rpf::write_samples(disk.folder().file("a.exr"), make_buffer({0, 0, 3, 3}, [](int) { return 1U; }));
               }),
               ErrorKind::output, {"a.exr", "No space left"});
  EXPECT_EQ(disk.folder().entry_count(), 1U);
}

TEST(AtomicFile, OutputMayBeTheInput) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a b \xC3\xA4.exr");  // blanks and UTF-8 are names like any other
  rpf::write_samples(path, make_buffer({0, 0, 3, 3}, [](int) { return 2U; }));
  rpf::write_samples(path, rpf::read_samples(path));
  EXPECT_EQ(rpf::read_samples(path).sample_count(), 18U);
  EXPECT_EQ(folder.entry_count(), 1U);
}

}  // namespace
