// What normals and positions keep: the thesis's column and Menger sponge.
#include <fmt/format.h>

#include "study/comparisons.h"
#include "study/places.h"

namespace rpf::study {
namespace {

const std::vector<Setting> settings = {
    {"plain mean", plain_mean},
    {"normals and positions", "--profile thesis --boxes 35,17,7 --features N,P"},
    {"normals", "--profile thesis --boxes 35,17,7 --features N"},
    {"positions", "--profile thesis --boxes 35,17,7 --features P"},
    {"positions, narrow", "--profile thesis --boxes 35,17,7 --features P --position-scale 100"},
    {"no features", "--profile thesis --boxes 35,17,7 --features none"},
    {"all of the file", "--profile thesis --boxes 35,17,7"}};

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

std::vector<Run> plan_features(const Extent& extent) { return runs_of({"column", "menger"}, settings, extent); }

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
  story.pictures(findings.on("column"), column_front);
  story.runs(findings.on("column"),
             {story.step_in(corner), story.error_in(corner), story.detail_in(bricks), story.error_in(bricks)});
  story.heading("A Menger sponge in a Cornell box");
  story.pictures(findings.on("menger"), sponge);
  story.runs(findings.on("menger"), {story.step_in(edge), story.error_in(edge), story.detail_in(holes),
                                     story.error_in(holes), story.error_in(sponge), story.error_in(lamp)});
}

}  // namespace rpf::study
