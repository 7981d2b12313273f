// How many samples the filter is worth.
#include <fmt/format.h>

#include <cmath>

#include "study/story.h"

namespace rpf::study {
namespace {

struct Method {
  const char* label;
  const char* options;
  int most_samples;  ///< beyond, it takes too long, or more of a device than bands of 55 rows have
};

constexpr Method methods[] = {{"plain mean", plain_mean, 64},
                              {"thesis", "--profile thesis", 16},
                              {"paper", "--profile paper", 8},
                              {"Gaussian", "--method gaussian", 64},
                              {"cross-bilateral", "--method cross-bilateral", 64},
                              {"balanced", "--preset balanced", 64},
                              {"high", "--preset high", 16}};

std::vector<int> counts(bool quick) {
  return quick ? std::vector<int>{1, 4, 16} : std::vector<int>{1, 2, 4, 8, 16, 32, 64};
}

std::vector<const char*> scenes(bool quick) {
  return quick ? std::vector<const char*>{"combined"} : std::vector<const char*>{"combined", "dof", "soft-shadow"};
}

/// Samples a pixel at which the plain mean has this error: a line through its errors in the logarithms.
double worth(const Findings& findings, const std::string& scene, double error) {
  double x = 0, y = 0, xx = 0, xy = 0, n = 0;
  for (const Outcome* o : findings.on(scene)) {
    if (o->run.label != "plain mean") continue;
    const double lx = std::log(o->run.frame.samples_per_pixel), ly = std::log(o->error("relMSE"));
    x += lx, y += ly, xx += lx * lx, xy += lx * ly, n += 1;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x), at_one = (y - slope * x) / n;
  return std::exp((std::log(error) - at_one) / slope);
}

report::Plot error_plot(const Findings& findings, const std::string& scene, bool quick) {
  report::Plot plot{"samples a pixel", "relMSE", {}, true, true, false, {}};
  for (const int count : counts(quick)) plot.x_ticks.push_back(count);
  for (const Method& method : methods) {
    report::Curve curve{method.label, {}};
    for (const Outcome* o : findings.on(scene))
      if (o->run.label == method.label)
        curve.points.push_back({double(o->run.frame.samples_per_pixel), o->error("relMSE")});
    plot.curves.push_back(curve);
  }
  return plot;
}

Verdict worth_at_four(const Findings& findings, const char* label) {
  std::string measured = "4 filtered samples are as good as";
  std::size_t holding = 0;
  for (const std::string& scene : findings.scenes()) {
    const double samples = worth(findings, scene, findings.at(scene, label, 4).error("relMSE"));
    holding += samples > 8 ? 1 : 0;
    measured += fmt::format(" {:.1f} ({}),", samples, scene);
  }
  measured.pop_back();
  return {fmt::format("{} is worth more than doubling the samples", label), measured + " of the plain mean",
          verdict_of(holding, findings.scenes().size())};
}

Verdict never_worse(const Findings& findings, const char* label) {
  std::size_t holding = 0, all = 0;
  std::string worse;
  for (const Outcome& o : findings.all()) {
    if (o.run.label != label) continue;
    const bool better =
        o.error("relMSE") < findings.at(o.run.frame.scene, "plain mean", o.run.frame.samples_per_pixel).error("relMSE");
    holding += better ? 1 : 0;
    ++all;
    if (!better) worse += fmt::format(" {} at {},", o.run.frame.scene, o.run.frame.samples_per_pixel);
  }
  if (!worse.empty()) worse.pop_back();
  return {fmt::format("{} is better than the plain mean at every number of samples", label),
          worse.empty() ? fmt::format("better in all {} cases", all) : "worse:" + worse, verdict_of(holding == all)};
}

}  // namespace

std::vector<Run> plan_spp(const Extent& extent) {
  std::vector<Run> runs;
  for (const char* scene : scenes(extent.quick))
    for (const int count : counts(extent.quick))
      for (const Method& method : methods)
        if (count <= method.most_samples)
          runs.push_back({method.label, frame_of(scene, extent, count), method.options});
  return runs;
}

void tell_spp(const Findings& findings, Story& story) {
  std::vector<Verdict> verdicts;
  for (const char* label : {"thesis", "paper", "balanced"}) verdicts.push_back(worth_at_four(findings, label));
  for (const char* label : {"thesis", "paper", "balanced"}) verdicts.push_back(never_worse(findings, label));
  story.verdicts(verdicts);
  story.paragraph(
      "Worth: so many samples a pixel the plain mean needs for the same relMSE, by a line through its errors in the "
      "logarithms.");
  for (const std::string& scene : findings.scenes()) {
    story.heading(scene);
    story.plot(scene, error_plot(findings, scene, story.quick()), "relMSE against samples a pixel");
    const auto samples = [](const Outcome& o) { return std::to_string(o.run.frame.samples_per_pixel); };
    const auto worth_text = [&](const Outcome& o) {
      const double value = worth(findings, scene, o.error("relMSE"));
      story.value(scene + " worth", fmt::format("{}, {} samples", o.run.label, o.run.frame.samples_per_pixel), value);
      return fmt::format("{:.1f}", value);
    };
    story.runs(findings.on(scene), {{"samples", samples}, {"worth", worth_text}});
  }
}

}  // namespace rpf::study
