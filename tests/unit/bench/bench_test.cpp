// Measuring: statistics of rounds, results that survive a stop, plans, other binaries.
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <filesystem>

#include "bench/child.h"
#include "bench/frame_run.h"
#include "bench/results_file.h"
#include "bench/statistics.h"
#include "bench/sweep_plan.h"
#include "deep_files.h"
#include "rpf/error.h"
#include "temporary_folder.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf::bench {
namespace {

template <class Body>
void expect_error(ErrorKind kind, const std::string& word, const Body& body) {
  deep_files::expect_error(deep_files::error_of(body), kind, {word});
}

TEST(BenchStatistics, MedianOfOddAndEvenCounts) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(median({7}), 7);
}

TEST(BenchStatistics, SummaryHasTheExtremes) {
  const Summary summary = summarize({5, 9, 1, 2, 8});
  EXPECT_EQ(summary.median, 5);
  EXPECT_EQ(summary.lowest, 1);
  EXPECT_EQ(summary.highest, 9);
}

// By hand from Pascal's triangle: 1 - 2 sum_{k<low} C(n,k) / 2^n, for example 1 - 2 (1 + 9) / 512 for n = 9.
TEST(BenchStatistics, RanksAreThoseOfTheSignTest) {
  struct Row {
    std::size_t n, low;
    double confidence;
  };
  for (const Row& row : {Row{6, 1, 0.96875}, Row{8, 1, 0.9921875}, Row{9, 2, 0.9609375}, Row{11, 2, 0.98828125},
                         Row{12, 3, 0.96142578125}, Row{15, 4, 0.96484375}, Row{20, 6, 0.9586105347}}) {
    const MedianRanks ranks = median_ranks(row.n);
    EXPECT_EQ(ranks.low, row.low) << row.n;
    EXPECT_EQ(ranks.high, row.n + 1 - row.low) << row.n;
    EXPECT_NEAR(ranks.confidence, row.confidence, test::tolerance::binomial) << row.n;
  }
  EXPECT_EQ(median_ranks(5).low, 0U) << "five values are inside with 93.75 %, which is not enough";
  EXPECT_EQ(median_ranks(0).low, 0U);
}

TEST(BenchStatistics, VerdictOnlyBeyondTheSpread) {
  const std::vector<double> a = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const auto scaled = [&](std::vector<double> factors) {
    std::vector<double> b = a;
    for (std::size_t i = 0; i < b.size(); ++i) b[i] *= factors[i];
    return b;
  };
  // Nine rounds, ranks 2 and 8: one round may go the other way, two may not.
  EXPECT_EQ(compare_rounds(a, scaled({.9, .8, .9, .9, 1.5, .9, .7, .9, .9})).verdict, Verdict::less);
  EXPECT_EQ(compare_rounds(a, scaled({.9, .8, 1.1, .9, 1.5, .9, .7, .9, .9})).verdict, Verdict::no_difference);
  EXPECT_EQ(compare_rounds(a, scaled({1.1, 1.2, 1.1, .9, 1.5, 1.1, 1.1, 1.1, 1.1})).verdict, Verdict::more);
  EXPECT_EQ(compare_rounds(a, a).verdict, Verdict::no_difference);
  const Ratio ratio = compare_rounds(a, scaled({.5, .6, .7, .8, .9, 1.1, 1.2, 1.3, 1.4}));
  EXPECT_FLOAT_EQ(static_cast<float>(ratio.median), .9F);
  EXPECT_FLOAT_EQ(static_cast<float>(ratio.low), .6F);
  EXPECT_FLOAT_EQ(static_cast<float>(ratio.high), 1.3F);
}

TEST(BenchStatistics, FiveRoundsGiveNoVerdict) {
  EXPECT_EQ(compare_rounds({1, 1, 1, 1, 1}, {9, 9, 9, 9, 9}).verdict, Verdict::too_few_rounds);
  EXPECT_EQ(compare_rounds({1, 1, 1, 1, 1, 1}, {9, 9, 9, 9, 9, 9}).verdict, Verdict::more);
}

TEST(BenchResults, AreThereAgainAfterReopening) {
  const TemporaryFolder folder;
  const std::string path = folder.file("results.jsonl");
  {
    ResultsFile results(path, "cpu");
    EXPECT_FALSE(std::filesystem::exists(path)) << "without a result";
    EXPECT_FALSE(results.has("a"));
    results.add("a", {{"cpu", 1.5}});
    EXPECT_TRUE(results.has("a"));
  }
  const ResultsFile again(path, "cpu");
  EXPECT_TRUE(again.has("a"));
  EXPECT_FALSE(again.has("b"));
  ASSERT_EQ(again.lines().size(), 1U);
  EXPECT_EQ(again.lines()[0]["cpu"], 1.5);
}

TEST(BenchResults, AnInterruptedLineIsDropped) {
  const TemporaryFolder folder;
  const std::string path = folder.file("results.jsonl");
  ResultsFile(path, "cpu").add("a", {{"cpu", 1}});
  const std::string whole = file_bytes(path);
  for (const std::string& torn :
       {std::string("{"), std::string("{\"key\":\"b\",\"cp"), std::string("{\"key\":\"b\"}")}) {
    write_bytes(path, whole + torn);
    ResultsFile results(path, "cpu");
    EXPECT_TRUE(results.has("a"));
    EXPECT_FALSE(results.has("b")) << torn;
    EXPECT_EQ(file_bytes(path), whole) << "what follows must not be glued to " << torn;
  }
  write_bytes(path, "{\"cpu\":");
  EXPECT_TRUE(ResultsFile(path, "cpu").lines().empty());
}

TEST(BenchResults, OtherFilesAreRefusedAndLeftAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("notes.txt");
  for (const char* text : {"my notes\nand more", "my notes", R"({"a": 1})", "{", "\n", R"({"key":"a"})",
                           "{\"key\":\"a\"}\nmore", "{\"cpu\":1}\nmore"}) {
    write_bytes(path, text);
    expect_error(ErrorKind::input, "line 1", [&] { ResultsFile(path, "cpu"); });
    EXPECT_EQ(file_bytes(path), text);
  }
  expect_error(ErrorKind::output, "cannot be written", [&] { ResultsFile(folder.file("none/results.jsonl"), "cpu"); });
}

TEST(BenchResults, WhatIsNoFileIsRefused) {
  const TemporaryFolder folder;
  expect_error(ErrorKind::output, "a folder", [&] { ResultsFile(folder.file(""), "cpu"); });
  const std::string path = folder.file("pipe");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  expect_error(ErrorKind::output, "a pipe or socket", [&] { ResultsFile(path, "cpu"); });
}

SweepPlan plan_of(const TemporaryFolder& folder, const std::string& json) {
  write_bytes(folder.file("plan.json"), json);
  return read_sweep_plan(folder.file("plan.json"), "/scenes");
}

TEST(BenchPlan, FilesAreRelativeToThePlanAndScenesNameTheirs) {
  const TemporaryFolder folder;
  const SweepPlan plan = plan_of(folder, R"({"rounds": 3, "settings": {"one": "--boxes 5", "two": ""}, "frames": [
      {"name": "f", "samples": "a.exr", "reference": "/b.exr", "settings": ["two"]},
      {"name": "s", "scene": "dof", "size": "24x16", "spp": 2, "reference_spp": 8}]})");
  EXPECT_EQ(plan.rounds, 3);
  ASSERT_EQ(plan.frames.size(), 2U);
  EXPECT_EQ(plan.frames[0].samples, folder.file("a.exr"));
  EXPECT_EQ(plan.frames[0].reference, "/b.exr");
  EXPECT_EQ(plan.frames[1].samples, "/scenes/dof-24x16-2spp.samples.exr");
  EXPECT_EQ(plan.frames[1].reference, "/scenes/dof-24x16-8spp.reference.exr");
  ASSERT_EQ(plan.settings.size(), 2U);
  EXPECT_EQ(plan.settings[0].name, "one") << "in the plan's order";
  EXPECT_FALSE(applies(plan.settings[0], plan.frames[0]));
  EXPECT_TRUE(applies(plan.settings[1], plan.frames[0]));
  EXPECT_TRUE(applies(plan.settings[0], plan.frames[1]));
}

TEST(BenchPlan, WhatIsWrongIsNamed) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& text, const std::string& json) {
    expect_error(ErrorKind::input, text, [&] { plan_of(folder, json); });
  };
  error("plan.json", "{");
  error("frames", R"({"settings": {}})");
  error("samples", R"({"settings": {}, "frames": [{"name": "f"}]})");
  error("24by16", R"({"settings": {}, "frames": [{"name": "f", "scene": "dof", "size": "24by16"}]})");
  error("rounds", R"({"settings": {}, "frames": [], "rounds": 0})");
}

TEST(BenchPlan, KeysTellMeasurementsApart) {
  SweepFrame frame, other;
  frame.samples = "/x/a.exr";
  other.samples = "/x/b.exr";
  const SweepSetting setting{"s", "--boxes 5"}, renamed{"t", "--boxes 5"}, changed{"s", "--boxes 7"};
  const std::string key = key_of(frame, setting, 0);
  EXPECT_EQ(key, key_of(frame, renamed, 0));
  EXPECT_NE(key, key_of(frame, changed, 0));
  EXPECT_NE(key, key_of(other, setting, 0));
  EXPECT_NE(key, key_of(frame, setting, 1));
}

TEST(BenchFrame, MeasuresReadingAndFilteringAndTheErrorOfTheResult) {
  const TemporaryFolder folder;
  const std::string samples = folder.file("a.samples.exr"), reference = folder.file("a.exr");
  write_samples(samples, test::defocused_edge({}));
  FrameJob job{samples, "", {}, {}};
  job.settings.box_widths = {5};
  write_image(reference, filter(read_samples(samples), job.settings).image);
  job.reference = reference;
  warm_up(job, {});
  const FrameRun run = run_frame(job, {});
  EXPECT_GT(run.cost.cpu, 0);
  EXPECT_GT(run.cost.wall, 0);
  ASSERT_TRUE(run.error.has_value());
  EXPECT_EQ(run.error->mse, 0) << "the reference is the result";
  EXPECT_EQ(run.report.passes.size(), 1U);
  job.settings.seed = 2;
  EXPECT_GT(run_frame(job, {}).error->mse, 0);
}

TEST(BenchChild, OutputAndExitCodes) {
  EXPECT_EQ(output_of({"printf", "a\\nb"}), "a\nb");
  EXPECT_EQ(output_of({"sh", "-c", "head -c 100000 /dev/zero"}).size(), 100000U);
  expect_error(ErrorKind::memory, "exit code 6", [] { output_of({"sh", "-c", "exit 6"}); });
  expect_error(ErrorKind::cancelled, "143", [] { output_of({"sh", "-c", "kill -TERM $$"}); });
  expect_error(ErrorKind::usage, "/nowhere/rpf", [] { output_of({"/nowhere/rpf"}); });
}

}  // namespace
}  // namespace rpf::bench
