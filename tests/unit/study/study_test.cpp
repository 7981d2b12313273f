// Experiments: what is measured in a region, plans, runs that are made once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "deep_files.h"
#include "rpf/error.h"
#include "rpf/scene.h"
#include "study/findings.h"
#include "study/harness.h"
#include "study/regions.h"
#include "study/story.h"
#include "temporary_folder.h"
#include "tolerances.h"

namespace rpf::study {
namespace {

using testing::HasSubstr;

/// Gray: value(x, y) in every channel.
template <class Value>
Image gray(int width, int height, const Value& value) {
  Image image;
  image.data_window = image.display_window = {0, 0, width, height};
  image.channels = {"R", "G", "B"};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.pixels.insert(image.pixels.end(), 3, static_cast<float>(value(x, y)));
  return image;
}

int checks(int x, int y) { return (x + y) % 2; }

constexpr Region middle = {"middle", -0.25, -0.125, 0.5, 0.25};

// ---- regions

TEST(StudyRegions, CountFromTheCenterInWidths) {
  EXPECT_EQ(window_of(middle, {0, 0, 64, 36}), (Window{16, 10, 32, 16}));
  EXPECT_EQ(window_of(middle, {5, -7, 64, 64}), (Window{16, 24, 32, 16})) << "the same part of the picture";
  EXPECT_EQ(window_of({"", -2, -2, 4, 4}, {0, 0, 64, 36}), (Window{0, 0, 63, 35})) << "cut off";
  EXPECT_EQ(window_of({"", 0, 0, 0.001, 0.001}, {0, 0, 64, 36}), (Window{32, 18, 1, 1})) << "at least a pixel";
}

TEST(StudyRegions, ErrorIsThatOfThePart) {
  const Image reference = gray(64, 36, [](int, int) { return 1; });
  const Image image = gray(64, 36, [](int x, int) { return x < 32 ? 1 : 3; });
  EXPECT_NEAR(region_error(image, reference, middle), 0.5 * 4 / 1.01, test::tolerance::study);
  EXPECT_EQ(region_error(image, reference, {"left", -0.5, -0.1, 0.25, 0.2}), 0);
}

TEST(StudyRegions, DetailIsKeptInPart) {
  const Image reference = gray(64, 36, checks);
  EXPECT_NEAR(kept_detail(reference, reference, middle), 1, test::tolerance::study);
  EXPECT_NEAR(kept_detail(gray(64, 36, [](int x, int y) { return 5 + 0.25 * checks(x, y); }), reference, middle), 0.25,
              test::tolerance::study);
  EXPECT_NEAR(kept_detail(gray(64, 36, [](int, int) { return 0.5; }), reference, middle), 0, test::tolerance::study);
  EXPECT_TRUE(std::isnan(kept_detail(reference, gray(64, 36, [](int, int) { return 1; }), middle)));
}

TEST(StudyRegions, ShadingIsNoDetail) {
  const auto shaded = [](int x, int y) { return 0.1 * checks(x, y) + 0.3 * x; };
  const Image reference = gray(64, 36, shaded), blurred = gray(64, 36, [](int x, int) { return 0.05 + 0.3 * x; });
  EXPECT_NEAR(kept_detail(blurred, reference, middle), 0, test::tolerance::study);
  EXPECT_NEAR(kept_detail(reference, reference, middle), 1, test::tolerance::study);
}

TEST(StudyRegions, StepIsWhatIsUpright) {
  const Image reference = gray(64, 36, [](int x, int y) { return (x < 32 ? 1.0 : 2.0) + checks(x, y); });
  EXPECT_NEAR(kept_step(gray(64, 36, [](int x, int) { return x < 32 ? 1 : 2; }), reference, middle), 1,
              test::tolerance::study)
      << "without the texture";
  EXPECT_NEAR(kept_step(gray(64, 36, [](int x, int y) { return 1.5 + checks(x, y); }), reference, middle), 0,
              test::tolerance::study)
      << "without the step";
}

// ---- plans

TEST(StudyPlans, NameEveryRunOnceAndScenesThatThereAre) {
  std::set<std::string> scene_names;
  for (const SceneInfo& scene : scenes()) scene_names.insert(scene.name);
  for (const Experiment& experiment : experiments())
    for (const bool quick : {false, true}) {
      std::set<std::string> labels, treatments;
      for (const study::Run& run : experiment.plan({64, 36, 8, quick})) {
        const std::string frame = run.frame.scene + std::to_string(run.frame.samples_per_pixel);
        const std::string treatment = frame + (run.frame.adapted ? " adapted " : " ") + treatment_of(run);
        EXPECT_TRUE(labels.insert(frame + run.label).second) << experiment.name << ": " << run.label << " twice";
        EXPECT_TRUE(treatments.insert(treatment).second) << experiment.name << ": " << treatment << " twice";
        EXPECT_EQ(scene_names.count(run.frame.scene), 1U) << run.frame.scene;
        EXPECT_EQ(run.frame.width, 64);
        EXPECT_EQ(run.frame.reference_samples, 8);
      }
    }
}

TEST(StudyPlans, QuickIsNoMoreWork) {
  for (const Experiment& experiment : experiments())
    EXPECT_LE(experiment.plan({64, 36, 8, true}).size(), experiment.plan({64, 36, 8, false}).size()) << experiment.name;
}

TEST(StudyPlans, UnknownNamesAreRefused) {
  deep_files::expect_error(deep_files::error_of([] { find_experiment("no-such"); }), ErrorKind::usage,
                           {"no-such", "passes", "thesis-vs-paper"});
}

// ---- running

std::vector<Run> small_plan(const Extent& extent) {
  const bench::SweepFrame frame = frame_of("two-values", extent);
  return {{"plain mean", frame, ""}, {"three", frame, "3"}, {"five", frame, "5"}};
}

void tell_all(const Findings& findings, Story& story) {
  story.verdicts({{"a <statement>", "numbers", verdict_of(true)}});
  story.runs(findings.on("two-values"));
  story.pictures(findings.on("two-values"), middle);
}

const Experiment small = {"small", "a question", small_plan, tell_all};

StudyOptions options_for(const std::string& folder) {
  return {folder, {32, 18, 4, false}, [](const std::string& options) {
            Settings settings;
            settings.box_widths.clear();
            if (!options.empty()) settings.box_widths = {std::stoi(options)};
            return settings;
          }};
}

bool go_on(const StudyProgress&) { return true; }

TEST(StudyRuns, AreMadeOnceAndTold) {
  const TemporaryFolder folder;
  const StudyDone first = run_experiment(small, options_for(folder.path()), go_on);
  EXPECT_EQ(first.measured, 3U);
  const std::string page = file_bytes(first.page), json = file_bytes(folder.file("small.json"));
  EXPECT_THAT(page, HasSubstr("a &lt;statement&gt;"));
  EXPECT_EQ(nlohmann::json::parse(json).at("runs").size(), 3U);
  const StudyDone second = run_experiment(small, options_for(folder.path()), go_on);
  EXPECT_EQ(second.measured, 0U);
  EXPECT_EQ(second.known, 3U);
  EXPECT_EQ(file_bytes(second.page), page);
  EXPECT_EQ(file_bytes(folder.file("small.json")), json);
}

TEST(StudyRuns, SayHowFarTheyAre) {
  const TemporaryFolder folder;
  std::vector<double> fractions;
  std::set<std::size_t> runs;
  run_experiment(small, options_for(folder.path()), [&](const StudyProgress& p) {
    fractions.push_back(p.fraction);
    runs.insert(p.run);
    EXPECT_EQ(p.runs, 3U);
    return true;
  });
  EXPECT_THAT(runs, testing::ElementsAre(1U, 2U, 3U));
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_NEAR(fractions.back(), 1, test::tolerance::study);
}

TEST(StudyRuns, KeepWhatWasMeasuredWhenStopped) {
  const TemporaryFolder folder;
  const auto stop_at_two = [](const StudyProgress& p) { return p.run < 2; };
  deep_files::expect_error(
      deep_files::error_of([&] { run_experiment(small, options_for(folder.path()), stop_at_two); }),
      ErrorKind::cancelled, {});
  EXPECT_FALSE(std::filesystem::exists(folder.file("small.html")));
  const StudyDone done = run_experiment(small, options_for(folder.path()), go_on);
  EXPECT_EQ(done.measured, 2U);
  EXPECT_EQ(done.known, 1U);
}

TEST(StudyRuns, AreMadeAgainWhereTheirImageIsMissing) {
  const TemporaryFolder folder;
  run_experiment(small, options_for(folder.path()), go_on);
  std::filesystem::remove_all(folder.file("images"));
  EXPECT_EQ(run_experiment(small, options_for(folder.path()), go_on).measured, 3U);
}

}  // namespace
}  // namespace rpf::study
