// What docs/trade.md claims of the presets, as ratios: of errors, and of the numbers of operations.
#include "rpf/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "rpf/error.h"
#include "rpf/metrics.h"
#include "rpf/scene.h"
#include "test_frames.h"

namespace rpf {
namespace {

/// A preset's settings on the backend under test.
Settings settings_of(const std::string& preset) {
  Settings settings = preset_settings(preset);
  settings.backend = test::backend_under_test();
  return settings;
}

/// What a run did for a pixel, over all passes.
struct Operations {
  double draws = 0, neighbors = 0, measured = 0;  ///< `measured`: neighbors whose mutual information was measured
};

struct Outcome {
  double relmse = 0, energy = 0;
  Operations operations;
};

Outcome outcome_of(const SampleBuffer& samples, const Image& reference, const Settings& settings) {
  const Result result = filter(samples, settings);
  Outcome outcome;
  const ImageError error = compare_images(result.image, reference);
  outcome.relmse = error.relmse;
  outcome.energy = error.energy;
  const double own =
      static_cast<double>(samples.sample_count()) / static_cast<double>(samples.data_window.pixel_count());
  for (const PassReport& pass : result.report.passes) {
    outcome.operations.draws += (pass.neighbors - own) / pass.acceptance;
    outcome.operations.neighbors += pass.neighbors;
    outcome.operations.measured += pass.neighbors / (settings.statistics_block * settings.statistics_block);
  }
  return outcome;
}

using Outcomes = std::map<std::string, Outcome>;

/// Every preset, the paper's profile and the plain mean on a scene.
Outcomes outcomes_of(const std::string& scene) {
  SceneOptions options;
  options.width = 96;
  options.height = 54;
  const SampleBuffer samples = render_scene(scene, options);
  options.samples = 256;
  const Image reference = render_reference(scene, options);
  Outcomes outcomes;
  for (const PresetInfo& preset : presets())
    outcomes[preset.name] = outcome_of(samples, reference, settings_of(preset.name));
  Settings settings;
  settings.backend = test::backend_under_test();
  settings.profile = Profile::paper;
  outcomes["paper"] = outcome_of(samples, reference, settings);
  settings.box_widths = {};
  outcomes["mean"] = outcome_of(samples, reference, settings);
  return outcomes;
}

class PresetClaims : public testing::TestWithParam<const char*> {};

TEST_P(PresetClaims, LessErrorThanThePaperAtAFractionOfItsWorkAndMoreOfBothFromOneToTheNext) {
  const Outcomes outcomes = outcomes_of(GetParam());
  const Outcome &mean = outcomes.at("mean"), &paper = outcomes.at("paper");
  for (const PresetInfo& preset : presets()) {
    const Outcome& ours = outcomes.at(preset.name);
    EXPECT_LT(ours.relmse, 0.75 * paper.relmse) << preset.name;
    EXPECT_LT(ours.relmse, 0.5 * mean.relmse) << preset.name;
    EXPECT_LT(ours.operations.draws, 0.9 * paper.operations.draws) << preset.name;
    EXPECT_NEAR(ours.energy / mean.energy, 1, 0.03) << preset.name;
  }
  const Outcome &fast = outcomes.at("fast"), &balanced = outcomes.at("balanced"), &high = outcomes.at("high");
  EXPECT_LT(balanced.relmse, fast.relmse);
  EXPECT_LT(high.relmse, 1.05 * balanced.relmse);  // on some scenes they are equal
  EXPECT_GT(balanced.operations.draws, 3 * fast.operations.draws);
  EXPECT_GT(balanced.operations.measured, 10 * fast.operations.measured);
  EXPECT_GT(high.operations.draws, balanced.operations.draws);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PresetClaims, testing::Values("dof", "soft-shadow", "combined"));

TEST(Presets, AreNamedFromFastToAccurate) {
  std::vector<std::string> names;
  for (const PresetInfo& preset : presets()) names.push_back(preset.name);
  EXPECT_THAT(names, testing::ElementsAre("fast", "balanced", "high"));
}

TEST(Presets, AnUnknownNameIsRefusedWithThoseThereAre) {
  try {
    preset_settings("best");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::usage);
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("'best'"), testing::HasSubstr("fast, balanced, high")));
  }
}

TEST(Presets, TheMostAccurateThatFitsIsTaken) {
  const std::vector<PresetTime> times = {{"fast", 1}, {"balanced", 3}, {"high", 9}};
  EXPECT_EQ(best_within(times, 100).name, "high");
  EXPECT_EQ(best_within(times, 8.9).name, "balanced");
  EXPECT_EQ(best_within(times, 3).name, "balanced");
  EXPECT_EQ(best_within(times, 0.1).name, "fast");
}

TEST(Presets, ThereIsAPredictionForEachPreset) {
  Settings settings;
  settings.backend = test::backend_under_test();
  const auto times = predict_presets(test::defocused_edge({40, 30, 2, 1}), settings);
  ASSERT_EQ(times.size(), presets().size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(times[i].name, presets()[i].name);
    EXPECT_GT(times[i].seconds, 0);
  }
}

}  // namespace
}  // namespace rpf
