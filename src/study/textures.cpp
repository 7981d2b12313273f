// Textures that look like noise.
#include <fmt/format.h>

#include "study/story.h"

namespace rpf::study {
namespace {

// A grainy floor in front, a grainy ball; the column's bricks for comparison.
constexpr Region floor_grain = {"floor", -0.4, 0.17, 0.8, 0.11};
constexpr Region ball_grain = {"ball", -0.281, -0.094, 0.1625, 0.156};
constexpr Region bricks = {"bricks", 0.031, -0.156, 0.144, 0.25};

constexpr const char* grain = "random-texture";

struct Choice {
  const char* label;
  const char* options;
};

constexpr Choice choices[] = {{"plain mean", plain_mean},        {"thesis, N and P", "--profile thesis --features N,P"},
                              {"thesis", "--profile thesis"},    {"paper", "--profile paper"},
                              {"balanced", "--preset balanced"}, {"high", "--preset high"}};

Verdict taken_for_noise(Story& story, const Findings& findings) {
  const Outcome& filtered = findings.at(grain, "thesis, N and P");
  const double floor = story.number_in(filtered, floor_grain, kept_detail),
               ball = story.number_in(filtered, ball_grain, kept_detail);
  return {"Random textures are mistaken for noise (normals and positions, as in the thesis)",
          fmt::format("of the grain {:.2f} is left on the floor, {:.2f} on the ball; relMSE {} where the plain "
                      "mean has {}",
                      floor, ball, number(filtered.error("relMSE")),
                      number(findings.at(grain, "plain mean").error("relMSE"))),
          verdict_of(floor < 0.5 && ball < 0.5)};
}

Verdict random_against_regular(Story& story, const Findings& findings) {
  const double random = story.number_in(findings.at(grain, "thesis"), ball_grain, kept_detail),
               regular = story.number_in(findings.at("column", "thesis"), bricks, kept_detail);
  return {"A regular texture is kept where a random one is lost (all features, albedo among them)",
          fmt::format("detail kept: grain of the ball {:.2f}, bricks {:.2f}", random, regular),
          verdict_of(regular > random)};
}

Verdict albedo_helps(Story& story, const Findings& findings) {
  const double without = story.number_in(findings.at(grain, "thesis, N and P"), ball_grain, kept_detail),
               with = story.number_in(findings.at(grain, "thesis"), ball_grain, kept_detail);
  return {"Albedo among the features cures it",
          fmt::format("detail kept on the ball: {:.2f} without, {:.2f} with albedo", without, with),
          with > 0.9             ? verdict_of(true)
          : with > without + 0.1 ? "in part"
                                 : verdict_of(false)};
}

}  // namespace

std::vector<Run> plan_textures(const Extent& extent) {
  std::vector<Run> runs;
  for (const char* scene : {grain, "column"})
    for (const Choice& choice : choices) runs.push_back({choice.label, frame_of(scene, extent), choice.options});
  return runs;
}

void tell_textures(const Findings& findings, Story& story) {
  story.verdicts(
      {taken_for_noise(story, findings), random_against_regular(story, findings), albedo_helps(story, findings)});
  story.paragraph(
      "Detail kept: the slope of the image's luminance over the reference's in a region, each less its mean around the "
      "pixel; 1 is all of it, 0 none.");
  story.heading("Grain");
  story.pictures(findings.on(grain), Region{"", -0.281, -0.094, 0.25, 0.25});
  story.runs(findings.on(grain), {story.detail_in(floor_grain), story.detail_in(ball_grain),
                                  story.error_in(floor_grain), story.error_in(ball_grain)});
  story.heading("Bricks");
  story.pictures(findings.on("column"), Region{"", -0.125, -0.156, 0.3125, 0.25});
  story.runs(findings.on("column"), {story.detail_in(bricks), story.error_in(bricks)});
}

}  // namespace rpf::study
