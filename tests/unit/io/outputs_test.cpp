// What the name of an output stands for: everything it can be, decided before the work and once more when it is
// written.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "deep_files.h"
#include "io/atomic_file.h"
#include "rpf/outputs.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace deep_files;
using rpf::check_outputs;
using rpf::ErrorKind;
using rpf::OutputKind;
using rpf::PlannedOutput;

void write_through(const std::string& target, const std::string& text) {
  rpf::io::AtomicFile file(target);
  ASSERT_EQ(::write(file.descriptor(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  file.commit();
}

mode_t rights_of(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

std::string error_for(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs = {}) {
  return error_of([&] { check_outputs(outputs, inputs); });
}

TEST(OutputPlace, ALinkIsFollowedWhereNothingIsYet) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("real"));
  fs::create_symlink("real/new.exr", folder.file("a"));
  fs::create_symlink("a", folder.file("b"));
  check_outputs({{folder.file("b"), OutputKind::page}}, {});
  write_through(folder.file("b"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.file("a")) && fs::is_symlink(folder.file("b")));
  EXPECT_EQ(file_bytes(folder.file("real/new.exr")), "new");
}

TEST(OutputPlace, ALinkToAMissingFolderOrInACircleIsRefusedAndStays) {
  const TemporaryFolder folder;
  fs::create_symlink("missing/new.exr", folder.file("a.exr"));
  fs::create_symlink("c.exr", folder.file("b.exr"));
  fs::create_symlink("b.exr", folder.file("c.exr"));
  expect_error(error_for({{folder.file("a.exr")}}), ErrorKind::output, {"a.exr", "missing/new.exr", "make the folder"});
  expect_error(error_for({{folder.file("b.exr")}}), ErrorKind::output, {"b.exr", "Too many levels of symbolic links"});
  for (const char* name : {"a.exr", "b.exr", "c.exr"}) EXPECT_TRUE(fs::is_symlink(folder.file(name))) << name;
}

TEST(OutputPlace, AWriteProtectedFileIsRefusedAlsoForRoot) {
  const TemporaryFolder folder;
  write_bytes(folder.file("a.exr"), "old");
  fs::permissions(folder.file("a.exr"), fs::perms{0444});
  expect_error(error_for({{folder.file("a.exr")}}), ErrorKind::output,
               {"a.exr", "write-protected", "0444", "writable"});
  EXPECT_EQ(file_bytes(folder.file("a.exr")), "old");
}

TEST(OutputPlace, WhatIsReplacedKeepsItsRights) {
  const TemporaryFolder folder;
  const mode_t before = ::umask(022);
  for (const mode_t rights : {0600, 0640, 0664, 0755}) {
    const std::string path = folder.file("a.exr");
    write_bytes(path, "old");
    fs::permissions(path, fs::perms{rights});
    if (::geteuid() == 0) {
      ASSERT_EQ(::chown(path.c_str(), 1234, 5678), 0);
    }
    write_through(path, "new");
    struct stat status {};
    ASSERT_EQ(::stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, rights);
    if (::geteuid() == 0) {
      EXPECT_EQ(status.st_uid, 1234U);
      EXPECT_EQ(status.st_gid, 5678U);
    }
    EXPECT_EQ(file_bytes(path), "new");
    fs::remove(path);
  }
  write_through(folder.file("new.exr"), "new");
  EXPECT_EQ(rights_of(folder.file("new.exr")), 0644U);
  ::umask(before);
}

TEST(OutputPlace, OfAHardLinkTheOtherNameKeepsTheOldFile) {
  const TemporaryFolder folder;
  write_bytes(folder.file("a.exr"), "old");
  fs::create_hard_link(folder.file("a.exr"), folder.file("b.exr"));
  write_through(folder.file("a.exr"), "new");
  EXPECT_EQ(file_bytes(folder.file("a.exr")), "new");
  EXPECT_EQ(file_bytes(folder.file("b.exr")), "old");
}

TEST(OutputPlace, PipesAndWhatLeadsToThemAreRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder.file("link"));
  for (const char* name : {"pipe", "link"})
    expect_error(error_for({{folder.file(name), OutputKind::page}}), ErrorKind::output, {name, "a pipe or socket"});
  expect_error(error_for({{"/dev/null", OutputKind::page}}), ErrorKind::output, {"a device"});
}

TEST(Outputs, TwoNamesOfOneFileAreRefused) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("d"));
  fs::create_symlink("d", folder.file("l"));
  fs::create_symlink("d/new.exr", folder.file("x.exr"));
  const auto refused = [&](const std::string& a, const std::string& b) {
    expect_error(error_for({{folder.file(a)}, {folder.file(b)}}), ErrorKind::usage, {a, b, "one file"});
  };
  refused("a.exr", "a.exr");
  refused("a.exr", "./a.exr");
  refused("d/new.exr", "l/new.exr");
  refused("d/new.exr", "x.exr");
  check_outputs({{folder.file("a.exr")}, {folder.file("d/a.exr")}}, {});
}

TEST(Outputs, AnInputIsReplacedOnlyByItsNewForm) {
  const TemporaryFolder folder;
  write_bytes(folder.file("in.exr"), "samples");
  fs::create_symlink("in.exr", folder.file("link.exr"));
  const std::string input = folder.file("in.exr");
  check_outputs({{input, OutputKind::image, {"R", "G", "B"}, {}, true}}, {input});
  for (const char* name : {"in.exr", "link.exr"}) {
    expect_error(error_for({{folder.file(name)}}, {input}), ErrorKind::usage, {"in.exr", "would be lost"});
    expect_error(error_for({{input}}, {folder.file(name)}), ErrorKind::usage, {"in.exr", "would be lost"});
  }
}

TEST(Outputs, FormatsAreAskedBeforeTheWork) {
  const TemporaryFolder folder;
  check_outputs({{folder.file("a.exr")}, {folder.file("a.PNG")}, {folder.file("b.rpf"), OutputKind::samples}}, {});
  expect_error(error_for({{folder.file("a.xyz")}}), ErrorKind::output, {"a.xyz", ".exr", ".png"});
  expect_error(error_for({{folder.file("a.png"), OutputKind::image, {"N.X", "N.Y"}}}), ErrorKind::output,
               {"a.png", "no R", ".exr"});
  expect_error(error_for({{folder.file("a.webp"), OutputKind::image, {"R", "G", "B"}, {0, 0, 20000, 8}}}),
               ErrorKind::output, {"a.webp", "16383", "20000 x 8", ".exr"});
  expect_error(error_for({{folder.file("missing/a.exr")}}), ErrorKind::output,
               {"missing/a.exr", "make the folder first"});
  expect_error(error_for({{""}}), ErrorKind::usage, {"empty"});
  EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(Outputs, AFolderThatIsMadeIsProvedWhereItWillBe) {
  const TemporaryFolder folder;
  const auto in = [&](const std::string& name) {
    return PlannedOutput{folder.file(name), OutputKind::image, {"R", "G", "B"}, {}, false, true};
  };
  check_outputs({in("new/a.exr"), in("new/b.exr")}, {});
  EXPECT_EQ(folder.entry_count(), 0U);
  expect_error(error_for({in("new/a.exr"), in("new/a.exr")}), ErrorKind::usage, {"one file"});
  expect_error(error_for({in("new/deep/a.exr")}), ErrorKind::output, {"new/a.exr", "make the folder first"});
  write_bytes(folder.file("file"), "");
  expect_error(error_for({in("file/a.exr")}), ErrorKind::output, {"file/a.exr", "Not a directory"});
}

}  // namespace
