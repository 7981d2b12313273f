// What normals and positions keep: the thesis's column and Menger sponge.
#include <fmt/format.h>

#include "study/story.h"

namespace rpf::study {
namespace {

constexpr const char* boxes = "--profile thesis --boxes 35,17,7";

// The column's front edge is in the middle of the picture, a brick wall to each side.
constexpr Region corner = {"corner", -0.031, -0.156, 0.062, 0.25};
constexpr Region bricks = {"bricks", 0.031, -0.156, 0.144, 0.25};
// The sponge's front edge, its right side with holes, the lamp at the ceiling.
constexpr Region edge = {"edge", -0.068, 0.015, 0.05, 0.18};
constexpr Region holes = {"holes", -0.03, -0.016, 0.18, 0.19};
constexpr Region lamp = {"lamp", -0.125, -0.281, 0.25, 0.078};
constexpr Region sponge = {"sponge", -0.19, -0.06, 0.4, 0.3};

struct Choice {
  const char* label;
  const char* options;
};

constexpr Choice choices[] = {{"normals and positions", " --features N,P"},
                              {"normals", " --features N"},
                              {"positions", " --features P"},
                              {"positions, narrow", " --features P --position-scale 100"},
                              {"no features", " --features none"},
                              {"all of the file", ""}};

/// Numbers of one measure for the verdicts.
class Measure {
 public:
  Measure(Story& story, const Findings& findings, const char* scene, const Region& region,
          double (*measure)(const Image&, const Image&, const Region&))
      : story_(story), findings_(findings), scene_(scene), region_(region), measure_(measure) {}
  double of(const char* label) const { return story_.number_in(findings_.at(scene_, label), region_, measure_); }

 private:
  Story& story_;
  const Findings& findings_;
  const char* scene_;
  const Region& region_;
  double (*measure_)(const Image&, const Image&, const Region&);
};

Verdict column_corner(const Measure& step) {
  const double n = step.of("normals"), p = step.of("positions");
  return {"On the column normals alone keep the corner, positions alone lose it",
          fmt::format("of the step in brightness at the corner normals keep {:.2f}, positions {:.2f}", n, p),
          verdict_of(n > 0.8 && p < n - 0.1)};
}

Verdict column_texture(const Measure& contrast) {
  const double n = contrast.of("normals"), p = contrast.of("positions");
  return {
      "On the column positions alone keep the texture, normals alone smear it",
      fmt::format("of the detail of the bricks positions keep {:.2f}, normals {:.2f}", p, n),
      p > n + 0.1 ? verdict_of(p > 0.8) + (p > 0.8 ? "" : ": positions keep more, but not much") : verdict_of(false)};
}

Verdict menger_edge(const Measure& step, const Measure& detail) {
  const double n = step.of("normals"), p = step.of("positions");
  const double normals_holes = detail.of("normals"), positions_holes = detail.of("positions");
  const bool edge_holds = p > n, holes_hold = positions_holes > normals_holes;
  return {"On the sponge it is the other way round: positions alone keep what normals alone lose",
          fmt::format("of the step in brightness at the front edge positions keep {:.2f}, normals {:.2f}; of the holes "
                      "{:.2f} and {:.2f}",
                      p, n, positions_holes, normals_holes),
          edge_holds == holes_hold ? verdict_of(edge_holds)
          : edge_holds             ? "for the edge only"
                                   : "for the holes only"};
}

Verdict menger_error(const Measure& error) {
  const double n = error.of("normals"), p = error.of("positions");
  return {"On the sponge positions alone have the smaller error",
          fmt::format("relMSE of the sponge: positions {}, normals {}", number(p), number(n)), verdict_of(p < n)};
}

Verdict together(const Findings& findings) {
  std::size_t holding = 0;
  std::string measured = "relMSE of both, normals, positions:";
  for (const std::string& scene : findings.scenes()) {
    const double both = findings.at(scene, "normals and positions").error("relMSE"),
                 n = findings.at(scene, "normals").error("relMSE"), p = findings.at(scene, "positions").error("relMSE");
    holding += both <= n && both <= p ? 1 : 0;
    measured += fmt::format(" {} {}, {}, {};", scene, number(both), number(n), number(p));
  }
  measured.pop_back();
  return {"Together they are better than each alone", measured, verdict_of(holding, findings.scenes().size())};
}

}  // namespace

std::vector<Run> plan_features(const Extent& extent) {
  std::vector<Run> runs;
  for (const char* scene : {"column", "menger"}) {
    const bench::SweepFrame frame = frame_of(scene, extent);
    runs.push_back({"plain mean", frame, plain_mean});
    for (const Choice& choice : choices) runs.push_back({choice.label, frame, std::string(boxes) + choice.options});
  }
  return runs;
}

void tell_features(const Findings& findings, Story& story) {
  story.verdicts(
      {column_corner({story, findings, "column", corner, kept_step}),
       column_texture({story, findings, "column", bricks, kept_detail}),
       menger_edge({story, findings, "menger", edge, kept_step}, {story, findings, "menger", holes, kept_detail}),
       menger_error({story, findings, "menger", sponge, region_error}), together(findings)});
  story.paragraph(
      "Detail kept: the slope of the image's luminance over the reference's in a region, each less its mean around the "
      "pixel; 1 is all of it, 0 none. Step kept: the slope of the means of the region's columns, so that only what is "
      "upright counts.");
  story.heading("A column with a corner");
  story.pictures(findings.on("column"), Region{"", -0.125, -0.156, 0.3125, 0.25});
  story.runs(findings.on("column"),
             {story.step_in(corner), story.error_in(corner), story.detail_in(bricks), story.error_in(bricks)});
  story.heading("A Menger sponge in a Cornell box");
  story.pictures(findings.on("menger"), Region{"", -0.19, -0.06, 0.4, 0.3});
  story.runs(findings.on("menger"), {story.step_in(edge), story.error_in(edge), story.detail_in(holes),
                                     story.error_in(holes), story.error_in(sponge), story.error_in(lamp)});
}

}  // namespace rpf::study
