// What is remembered of drivers, and for how long.
#include "opencl/verdicts.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "opencl/machine_state.h"
#include "temporary_folder.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;
using std::chrono::hours;

class VerdictsTest : public testing::Test {
 protected:
  Verdicts verdicts() const { return Verdicts(folder()); }
  fs::path folder() const { return fs::path(folder_.path()) / "drivers"; }
  /// Makes all that is remembered older.
  void age(hours by) const {
    for (const auto& entry : fs::directory_iterator(folder()))
      fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - by);
  }

  TemporaryFolder folder_;
};

TEST_F(VerdictsTest, AreFoundByTheirQuestionInAnotherRun) {
  EXPECT_FALSE(verdicts().find("a"));
  verdicts().keep("a", {true, ""});
  verdicts().keep("b", {false, "it\naborted"});
  ASSERT_TRUE(verdicts().find("a"));
  EXPECT_TRUE(verdicts().find("a")->works);
  ASSERT_TRUE(verdicts().find("b"));
  EXPECT_FALSE(verdicts().find("b")->works);
  EXPECT_EQ(verdicts().find("b")->reason, "it\naborted");
  EXPECT_FALSE(verdicts().find("c"));
  verdicts().forget("a");
  EXPECT_FALSE(verdicts().find("a"));
}

TEST_F(VerdictsTest, FailuresCanBeForgotten) {
  verdicts().keep("good", {true, ""});
  verdicts().keep("bad", {false, "it aborted"});
  verdicts().forget_failures();
  EXPECT_TRUE(verdicts().find("good"));
  EXPECT_FALSE(verdicts().find("bad"));
}

TEST_F(VerdictsTest, HoldForAWeekOrAnHour) {
  verdicts().keep("good", {true, ""});
  verdicts().keep("bad", {false, "it aborted"});
  age(hours(2));
  EXPECT_TRUE(verdicts().find("good"));
  EXPECT_FALSE(verdicts().find("bad"));
  age(hours(8 * 24));
  EXPECT_FALSE(verdicts().find("good"));
  age(hours(-2));  // a clock was set back
  EXPECT_FALSE(verdicts().find("good"));
}

TEST_F(VerdictsTest, OldOnesAreRemoved) {
  verdicts().keep("old", {true, ""});
  age(hours(8 * 24));
  verdicts().keep("new", {true, ""});
  EXPECT_EQ(std::distance(fs::directory_iterator(folder()), fs::directory_iterator()), 1);
}

TEST_F(VerdictsTest, DamagedOnesSayNothing) {
  verdicts().keep("a", {true, ""});
  for (const char* content : {"", "wor", "works", "something else\n"}) {
    for (const auto& entry : fs::directory_iterator(folder())) std::ofstream(entry.path()) << content;
    EXPECT_FALSE(verdicts().find("a")) << content;
  }
}

TEST_F(VerdictsTest, WithoutAFolderNothingIsRemembered) {
  const Verdicts nowhere{fs::path()}, no_folder{"/dev/null/drivers"};
  for (const Verdicts& none : {nowhere, no_folder}) {
    EXPECT_NO_THROW(none.keep("a", {true, ""}));
    EXPECT_FALSE(none.find("a"));
  }
}

TEST(MachineState, ChangesWithWhatDriversRead) {
  const std::string before = machine_state();
  EXPECT_EQ(machine_state(), before);
  ::setenv("POCL_TEST", "1", 1);
  EXPECT_NE(machine_state(), before);
  ::unsetenv("POCL_TEST");
  EXPECT_EQ(machine_state(), before);
}

}  // namespace
}  // namespace rpf
