// One pass or several, narrow or wide: the thesis's error sweeps.
#include <fmt/format.h>

#include "study/comparisons.h"
#include "study/places.h"

namespace rpf::study {
namespace {

/// The thesis's own features: with albedo, textures would be kept whatever the boxes are.
std::string with_boxes(const std::string& boxes) { return "--profile thesis --features N,P --boxes " + boxes; }

std::vector<int> single_widths(bool quick) {
  return quick ? std::vector<int>{3, 5, 7, 11, 17} : std::vector<int>{3, 5, 7, 9, 11, 13, 15, 17};
}

std::vector<int> first_widths(bool quick) {
  return quick ? std::vector<int>{15, 21} : std::vector<int>{15, 17, 19, 21};
}

std::string two_passes(int first, int second) { return fmt::format("{},{}", first, second); }

report::Plot single_plot(const Findings& findings, bool quick) {
  report::Plot plot{"box width of the one pass", "MSE, part of the plain mean's", {}, false, false, false, {}};
  for (const int width : single_widths(quick)) plot.x_ticks.push_back(width);
  for (const std::string& scene : findings.scenes()) {
    report::Curve curve{scene, {}};
    const double mean = findings.at(scene, "plain mean").error("MSE");
    for (const int width : single_widths(quick))
      curve.points.push_back({double(width), findings.at(scene, std::to_string(width)).error("MSE") / mean});
    plot.curves.push_back(curve);
  }
  return plot;
}

report::Plot double_plot(const Findings& findings, bool quick) {
  report::Plot plot{"box width of the first pass", "MSE, part of the plain mean's", {}, false, false, false, {}};
  for (const int width : first_widths(quick)) plot.x_ticks.push_back(width);
  for (const std::string& scene : findings.scenes())
    for (const int second : {7, 9}) {
      report::Curve curve{fmt::format("{}, then {}", scene, second), {}};
      const double mean = findings.at(scene, "plain mean").error("MSE");
      for (const int first : first_widths(quick))
        curve.points.push_back({double(first), findings.at(scene, two_passes(first, second)).error("MSE") / mean});
      plot.curves.push_back(curve);
    }
  return plot;
}

/// The same three forms of passes with other settings: what the thesis's statement depends on.
struct Variant {
  const char* suffix;  ///< of the label
  const char* options;
};

constexpr Variant variants[] = {{", noise 0.002", "--profile thesis --features N,P --noise 0.002 --boxes "},
                                {", all features", "--profile thesis --boxes "}};
constexpr const char* compared_boxes[] = {"7", "15,7", "35,17,7"};

/// Whether the first boxes are better than the second, by an error of which more is worse.
Verdict compare(const Findings& findings, const std::string& statement, const std::string& better,
                const std::string& worse, const char* error) {
  return less(findings, statement, better, worse, error_named(error));
}

/// SSIM is better the larger it is.
Quantity dissimilarity() {
  return {"1 - SSIM", [](const Outcome& o) { return 1 - o.error("SSIM"); }};
}

std::vector<Verdict> verdicts(const Findings& findings) {
  const std::string statement = "Large boxes first are better than one small pass: 35,17,7 against 7";
  std::vector<Verdict> all;
  all.push_back(compare(findings, statement + ", by MSE", "35,17,7", "7", "MSE"));
  all.push_back(less(findings, statement + ", by SSIM", "35,17,7", "7", dissimilarity()));
  all.push_back(compare(findings, statement + ", by FLIP", "35,17,7", "7", "FLIP"));
  for (const Variant& variant : variants)
    all.push_back(compare(findings, fmt::format("{}, by MSE{}", statement, variant.suffix),
                          std::string("35,17,7") + variant.suffix, std::string("7") + variant.suffix, "MSE"));
  all.push_back(
      compare(findings, "A pass of 15 before the one of 7 is better than the 7 alone, by MSE", "15,7", "7", "MSE"));
  for (const Variant& variant : variants)
    all.push_back(compare(findings, fmt::format("The same{}", variant.suffix), std::string("15,7") + variant.suffix,
                          std::string("7") + variant.suffix, "MSE"));
  all.push_back(compare(findings, "A wider first pass is better: 21 before 7 against 15", "21,7", "15,7", "MSE"));
  all.push_back(compare(findings, "As second pass 7 is better than 9", "15,7", "15,9", "MSE"));
  return all;
}

}  // namespace

std::vector<Run> plan_passes(const Extent& extent) {
  std::vector<Run> runs;
  for (const char* scene : {"dof", "soft-shadow", "column"}) {
    const bench::SweepFrame frame = frame_of(scene, extent);
    const auto add = [&](const std::string& boxes) { runs.push_back({boxes, frame, with_boxes(boxes)}); };
    runs.push_back({"plain mean", frame, plain_mean});
    for (const int width : single_widths(extent.quick)) add(std::to_string(width));
    for (const int second : {7, 9})
      for (const int first : first_widths(extent.quick)) add(two_passes(first, second));
    add("35,17,7");
    add("55,35,17,7");
    for (const Variant& variant : variants)
      for (const char* boxes : compared_boxes)
        runs.push_back({std::string(boxes) + variant.suffix, frame, std::string(variant.options) + boxes});
  }
  return runs;
}

void tell_passes(const Findings& findings, Story& story) {
  const bool quick = story.quick();
  story.verdicts(verdicts(findings));
  story.heading("One pass");
  story.plot("one-pass", single_plot(findings, quick), "MSE of one pass");
  story.heading("Two passes");
  story.plot("two-passes", double_plot(findings, quick), "MSE of two passes, the second of 7 or 9");
  for (const std::string& scene : findings.scenes()) {
    story.heading(scene);
    story.pictures({&findings.at(scene, "plain mean"), &findings.at(scene, "7"), &findings.at(scene, "35,17,7")});
    std::vector<Column> more;
    if (scene == "column") more = {story.detail_in(bricks)};
    story.runs(findings.on(scene), more);
  }
}

}  // namespace rpf::study
