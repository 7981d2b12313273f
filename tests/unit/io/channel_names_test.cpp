// Which channel fills which slot: canonical names, aliases, conflicts and --map.
#include <gtest/gtest.h>

#include <set>

#include "deep_files.h"
#include "io/channel_names.h"

namespace {

using deep_files::error_of;
using deep_files::expect_error;
using rpf::ErrorKind;
using rpf::io::assign_slots;
using rpf::io::slot_of_alias;
using Names = std::vector<std::string>;

TEST(ChannelNames, CanonicalNamesAreTheGrammarOfTheDocument) {
  for (const char* name : {"R", "G", "B", "A", "film.X", "film.Y", "weight", "feature.hit", "random.time",
                           "random.lens.U", "feature.P2.Z", "feature.depth"})
    EXPECT_TRUE(rpf::io::is_slot(name)) << name;
  for (const char* name : {"", "r", "Z", "film.Z", "film", "random.", "random", "random..U", "random.lens.",
                           "random.light.0.U", "feature.", "features.N.X"})
    EXPECT_FALSE(rpf::io::is_slot(name)) << name;
}

TEST(ChannelNames, AliasesOfEveryProgram) {
  const std::map<std::string, std::string> expected = {{"P.X", "feature.P.X"},
                                                       {"Px", "feature.P.X"},
                                                       {"Ns.Z", "feature.Ns.Z"},
                                                       {"Albedo.R", "feature.albedo.R"},
                                                       {"u", "feature.uv.U"},
                                                       {"v", "feature.uv.V"},
                                                       {"dzdy", "feature.dz.Y"},
                                                       {"nn.X", "feature.N.X"},
                                                       {"sh_normal.Y", "feature.N.Y"},
                                                       {"geo_normal.Y", "feature.Ng.Y"},
                                                       {"position.Z", "feature.P.Z"},
                                                       {"pos.X", "feature.P.X"},
                                                       {"albedo.G", "feature.albedo.G"},
                                                       {"uv.U", "feature.uv.U"},
                                                       {"uv.Y", "feature.uv.V"},
                                                       {"N.B", "feature.N.Z"},
                                                       {"denoise_albedo.B", "feature.albedo.B"},
                                                       {"Denoising Normal.X", "feature.N.X"},
                                                       {"ViewLayer.Denoising Normal.X", "feature.N.X"},
                                                       {"My.Layer.Denoising Albedo.R", "feature.albedo.R"},
                                                       {"ViewLayer.Position.X", "feature.P.X"},
                                                       {"ViewLayer.Combined.A", "A"},
                                                       {"COLOR_G", "G"},
                                                       {"IMAGE_X", "film.X"},
                                                       {"LENS_U", "random.lens.U"},
                                                       {"TIME", "random.time"},
                                                       {"LIGHT_Y", "random.light.V"},
                                                       {"WORLD_X", "feature.P.X"},
                                                       {"WORLD_X_1", "feature.P2.X"},
                                                       {"NORMAL_Z_1", "feature.N2.Z"},
                                                       {"TEXTURE_COLOR_B", "feature.albedo.B"}};
  for (const auto& [channel, slot] : expected) EXPECT_EQ(slot_of_alias(channel), slot) << channel;
  for (const char* channel : {"", "Z", "ZBack", "depth.T", "ViewLayer.nn.X", "WORLD_X_NS", "P", "Position", "id"})
    EXPECT_EQ(slot_of_alias(channel), "") << channel;
}

TEST(ChannelNames, EveryRowOfTheTableNamesRealSlotsAndNoChannelTwice) {
  std::set<std::string> channels;
  for (const rpf::io::ChannelAlias& alias : rpf::io::channel_aliases()) {
    const std::string letters = alias.channel_letters, slot_letters = alias.slot_letters;
    ASSERT_EQ(letters.size(), slot_letters.size()) << alias.channel;
    for (std::size_t i = 0; i < std::max<std::size_t>(1, letters.size()); ++i) {
      std::string channel = alias.channel;
      if (!letters.empty()) channel.replace(channel.find('*'), 1, 1, letters[i]);
      EXPECT_TRUE(channels.insert(channel).second) << channel;
      EXPECT_TRUE(rpf::io::is_slot(slot_of_alias(channel))) << channel;
      EXPECT_FALSE(rpf::io::is_slot(channel)) << channel;
    }
  }
}

TEST(ChannelNames, TheCanonicalNameBeatsAnAlias) {
  EXPECT_EQ(assign_slots("f", {"WORLD_X", "feature.P.X", "P.X", "other"}, {}), (Names{"", "feature.P.X", "", ""}));
}

TEST(ChannelNames, TwoAliasesOfOneSlotAreAnErrorThatMapSolves) {
  const Names channels = {"N.X", "nn.X"};
  const std::string error = error_of([&] { assign_slots("shot.exr", channels, {}); });
  expect_error(error, ErrorKind::input,
               {"shot.exr", "\"N.X\"", "\"nn.X\"", "--map \"feature.N.X=N.X\"", "--map \"feature.N.X=nn.X\""});
  EXPECT_EQ(assign_slots("f", channels, {{"feature.N.X", "nn.X"}}), (Names{"", "feature.N.X"}));
  EXPECT_EQ(assign_slots("f", channels, {{"feature.N.X", ""}}), (Names{"", ""}));
}

TEST(ChannelNames, MapBeatsTheCanonicalName) {
  EXPECT_EQ(assign_slots("f", {"R", "beauty.R"}, {{"R", "beauty.R"}}), (Names{"", "R"}));
  EXPECT_EQ(assign_slots("f", {"R", "feature.N.X"}, {{"feature.N.X", ""}}), (Names{"R", ""}));
  // A mapped channel leaves the slot of its own name.
  EXPECT_EQ(assign_slots("f", {"R", "G"}, {{"B", "G"}}), (Names{"R", "B"}));
}

TEST(ChannelNames, MapErrorsSuggestNearNames) {
  const Names channels = {"R", "feature.albedo.R", "feature.P.X"};
  expect_error(error_of([&] {
                 assign_slots("f", channels, {{"feature.albedo.R", "feature.albedo.r"}});
               }),
               ErrorKind::input, {"\"feature.albedo.r\"", "near", "\"feature.albedo.R\""});
  expect_error(error_of([&] {
                 assign_slots("f", channels, {{"film.x", "R"}});
               }),
               ErrorKind::usage, {"film.x", "is not a slot", "\"film.X\""});
  expect_error(error_of([&] {
                 assign_slots("f", channels, {{"R", "R"}, {"G", "R"}});
               }),
               ErrorKind::usage, {"\"R\"", "two slots", "G and R"});
}

TEST(ChannelNames, TheRecordHasOneOrder) {
  const Names slots = {"feature.hit", "feature.P.X", "film.Y", "A",           "random.time",  "B", "", "G",
                       "R",           "film.X",      "weight", "feature.N.X", "random.lens.U"};
  EXPECT_EQ(rpf::io::record_layout(slots).slots,
            (Names{"R", "G", "B", "A", "film.X", "film.Y", "weight", "random.lens.U", "random.time", "feature.N.X",
                   "feature.P.X", "feature.hit"}));
}

}  // namespace
