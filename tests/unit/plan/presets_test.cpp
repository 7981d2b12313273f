// Presets: names, networks, and which one a time budget takes.
#include "rpf/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rpf/error.h"
#include "test_frames.h"

namespace rpf {
namespace {

TEST(Presets, AreNetworksOfTheirNames) {
  for (const PresetInfo& preset : presets()) {
    const Settings settings = preset_settings(preset.name);
    EXPECT_EQ(settings.method, Method::learned);
    EXPECT_EQ(settings.model, preset.name);
  }
}

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
