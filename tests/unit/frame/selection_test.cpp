#include <gtest/gtest.h>

#include <algorithm>

#include "frame/frame.h"
#include "frame/selection.h"
#include "rpf/error.h"
#include "rpf/filter.h"

namespace rpf {
namespace {

using Slots = std::vector<std::string>;

const SampleLayout layout{{"R", "G", "B", "film.X", "film.Y", "random.bsdf.U", "random.lens.U", "random.lens.V",
                           "random.time", "feature.N.X", "feature.P.X", "feature.depth", "feature.hit"}};

TEST(Selection, ModelsLensTimeAndLightByDefault) {
  Settings settings;
  settings.profile = Profile::paper;
  EXPECT_EQ(select_channels(layout, settings).random, (Slots{"random.lens.U", "random.lens.V", "random.time"}));
  settings.profile = Profile::thesis;
  EXPECT_EQ(select_channels(layout, settings).random,
            (Slots{"random.lens.U", "random.lens.V", "random.time", "pixel.X", "pixel.Y"}));
  EXPECT_EQ(select_channels(layout, settings).features, (Slots{"feature.N.X", "feature.P.X", "feature.depth"}));
}

TEST(Selection, FollowsTheUser) {
  Settings settings;
  settings.random = Slots{"bsdf"};
  settings.features = Slots{"P", "depth"};
  EXPECT_EQ(select_channels(layout, settings).random, (Slots{"random.bsdf.U"}));
  EXPECT_EQ(select_channels(layout, settings).features, (Slots{"feature.P.X", "feature.depth"}));
  settings.random = Slots{"all", "pixel"};
  settings.features = Slots{};
  EXPECT_EQ(select_channels(layout, settings).random.size(), 6U);
  EXPECT_TRUE(select_channels(layout, settings).features.empty());
}

TEST(Selection, LeavesOutSecondHitsOnRequest) {
  const SampleLayout both{{"R", "G", "B", "film.X", "film.Y", "random.lens2.U", "feature.N.X", "feature.N2.X",
                           "feature.depth", "feature.P2.X", "feature.P.X"}};
  Settings settings;
  settings.features = Slots{"first"};
  EXPECT_EQ(select_channels(both, settings).features, (Slots{"feature.N.X", "feature.depth", "feature.P.X"}));
  settings.features = Slots{"first", "P2"};
  EXPECT_EQ(select_channels(both, settings).features,
            (Slots{"feature.N.X", "feature.depth", "feature.P.X", "feature.P2.X"}));
  settings.random = Slots{"first"};  // a word for features only
  EXPECT_THROW(select_channels(both, settings), Error);
}

TEST(SelectedSlots, AreWhatIsModeledAndWhatMeasuresTheScene) {
  Settings settings;
  const Slots always = {"R", "G", "B", "film.X", "film.Y"};
  const auto needed_beside = [&] {
    Slots slots = selected_slots(layout, settings);
    EXPECT_TRUE(std::equal(always.begin(), always.end(), slots.begin()));
    slots.erase(slots.begin(), slots.begin() + static_cast<std::ptrdiff_t>(always.size()));
    return slots;
  };
  EXPECT_EQ(needed_beside(), (Slots{"random.lens.U", "random.lens.V", "random.time", "feature.N.X", "feature.P.X",
                                    "feature.depth", "feature.hit"}));
  settings.random = Slots{"bsdf", "pixel"};
  settings.features = Slots{"depth"};
  EXPECT_EQ(needed_beside(), (Slots{"random.bsdf.U", "feature.depth", "feature.hit"}));
  settings.features = Slots{"P"};  // normals tell hits from misses
  EXPECT_EQ(needed_beside(), (Slots{"random.bsdf.U", "feature.N.X", "feature.P.X", "feature.hit"}));
  settings.filter_features = true;
  EXPECT_EQ(needed_beside(), (Slots{"random.bsdf.U", "feature.N.X", "feature.P.X", "feature.depth", "feature.hit"}));
}

TEST(Selection, NamesWhatIsThereWhenAGroupIsNot) {
  Settings settings;
  settings.features = Slots{"albedo"};
  try {
    select_channels(layout, settings);
    FAIL() << "not refused";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::usage);
    EXPECT_STREQ(e.what(), "feature 'albedo' is not among the samples' channels; features there: N, P, depth");
  }
}

}  // namespace
}  // namespace rpf
