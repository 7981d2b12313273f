// Textures that look like noise.
#include <fmt/format.h>

#include "study/comparisons.h"
#include "study/places.h"

namespace rpf::study {
namespace {

constexpr const char* grain = "random-texture";

const std::vector<Setting> settings = {
    {"plain mean", plain_mean},        {"thesis, N and P", "--profile thesis --features N,P"},
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

std::vector<Run> plan_textures(const Extent& extent) { return runs_of({grain, "column"}, settings, extent); }

void tell_textures(const Findings& findings, Story& story) {
  story.verdicts(
      {taken_for_noise(story, findings), random_against_regular(story, findings), albedo_helps(story, findings)});
  story.paragraph(
      "Detail kept: the slope of the image's luminance over the reference's in a region, each less its mean around the "
      "pixel; 1 is all of it, 0 none.");
  story.heading("Grain");
  story.pictures(findings.on(grain), ball_and_floor);
  story.runs(findings.on(grain), {story.detail_in(floor_grain), story.detail_in(ball_grain),
                                  story.error_in(floor_grain), story.error_in(ball_grain)});
  story.heading("Bricks");
  story.pictures(findings.on("column"), column_front);
  story.runs(findings.on("column"), {story.detail_in(bricks), story.error_in(bricks)});
}

}  // namespace rpf::study
