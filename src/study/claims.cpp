// What the papers of 2008 to 2012 say, as statements that figures decide.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "study/comparisons.h"
#include "study/contemporaries.h"
#include "study/places.h"

namespace rpf::study {
namespace {

/// Holds on a frame where a ratio is below a limit.
struct Claim {
  std::string statement;
  std::string label;                            ///< of the runs that it is about
  std::string ratio;                            ///< in words
  std::function<double(const Outcome&)> value;  ///< the ratio
  double limit = 1;
  std::string scene = {};  ///< the only one that it is about; empty: all
};

const Outcome& same_frame(const Findings& findings, const Outcome& outcome, const std::string& label) {
  return findings.at(outcome.run.frame.scene, label, outcome.run.frame.samples_per_pixel);
}

/// "relMSE of a as part of b's" and so on.
Claim less_than(const Findings& findings, const std::string& statement, const std::string& a, const std::string& b,
                const Quantity& quantity) {
  return {statement, a, fmt::format("{} of {} over that of {}", quantity.name, a, b),
          [=, &findings](const Outcome& o) { return quantity.of(o) / quantity.of(same_frame(findings, o, b)); }};
}

/// The plain mean's error falls in proportion to the samples, so a quarter of it is what four times the samples bring.
Claim worth_four_times(const Findings& findings, const std::string& statement, const std::string& label) {
  return {statement, label, fmt::format("relMSE of {} over that of the plain mean", label),
          [&findings](const Outcome& o) { return part_of_mean(findings, o); }, 0.25};
}

Claim worth_four_times_in(const Findings& findings, const std::string& statement, const Region& region) {
  const auto error = [region](const Outcome& o) { return Story::number_in(o, region, region_error); };
  return {statement,
          axis_aligned,
          fmt::format("relMSE in the {} over that of the plain mean", region.name),
          [=, &findings](const Outcome& o) { return error(o) / error(same_frame(findings, o, "plain mean")); },
          0.25,
          "soft-shadow"};
}

Claim adapted_gains(const Findings& findings, const std::string& label) {
  return {fmt::format("samples where the noise is lower the error of {}", label), adapted(label),
          "trimmed relMSE over that of as many samples everywhere",
          [=, &findings](const Outcome& o) { return part_of_even(findings, o, label); }};
}

/// Against the best of all that are no network, picked frame by frame.
Claim beats_all(const Findings& findings, const std::string& preset) {
  const auto best = [&findings](const Outcome& of) {
    double least = std::numeric_limits<double>::infinity();
    for (const Outcome* o : findings.on(of.run.frame.scene))
      if (o->run.frame.samples_per_pixel == of.run.frame.samples_per_pixel && o->run.options.find("--preset") != 0 &&
          !o->run.denoised && !o->run.frame.adapted)
        least = std::min(least, o->error("relMSE"));
    return least;
  };
  return {fmt::format("{} is better than the best filter without a network", preset), preset,
          "relMSE over the least of those filters", [=](const Outcome& o) { return o.error("relMSE") / best(o); }};
}

Verdict judged(const Findings& findings, const Claim& claim) {
  std::set<int> counts;
  std::string scenes;
  std::size_t holding = 0, all = 0;
  for (const std::string& scene : claim.scene.empty() ? findings.scenes() : std::vector<std::string>{claim.scene}) {
    std::vector<std::string> ratios;
    for (const Outcome* o : findings.on(scene)) {
      if (o->run.label != claim.label) continue;
      const double ratio = claim.value(*o);
      holding += ratio < claim.limit ? 1 : 0;
      ratios.push_back(number(ratio));
      ++all;
      counts.insert(o->run.frame.samples_per_pixel);
    }
    scenes += fmt::format("{} {} {}", scenes.empty() ? "" : ";", scene, fmt::join(ratios, ", "));
  }
  const std::string asked = claim.limit == 1 ? "" : fmt::format(" (less than {} is asked)", claim.limit);
  return {claim.statement, fmt::format("{}{}, at {} samples:{}", claim.ratio, asked, fmt::join(counts, ", "), scenes),
          verdict_of(holding, all, "frames")};
}

std::vector<Claim> claims_of_papers(const Findings& findings) {
  const Quantity error = error_named("relMSE"), time = cpu_seconds();
  const auto less = [&](const char* statement, const char* a, const char* b, const Quantity& quantity) {
    return less_than(findings, statement, a, b, quantity);
  };
  return {
      less("cross-bilateral: features keep more than colors do", "cross-bilateral", "bilateral", error),
      less("gem (Rousselle et al. 2011): a Gaussian chosen for each pixel is better than one for all", "gem",
           "Gaussian", error),
      less("nlm (Rousselle et al. 2012): non-local means are better than Gaussians of chosen width", "nlm", "gem",
           error),
      less("sbf (Li et al. 2012): widths chosen by Stein's risk are better than one width", "sbf", "cross-bilateral",
           error),
      less("sbf: better than Gaussians of chosen width", "sbf", "gem", error),
      less("sbf: better than Random Parameter Filtering", "sbf", "paper", error),
      less("sbf: takes less time than Random Parameter Filtering", "sbf", "paper", time),
      worth_four_times(findings, "paper (Sen and Darabi 2012): as good as four times the samples", "paper"),
      worth_four_times(findings, "thesis (Van Campenhout): as good as four times the samples", "thesis"),
      worth_four_times(findings, "multidim (Hachisuka et al. 2008): as good as four times the samples", "multidim"),
      worth_four_times(findings, "lightfield (Lehtinen et al. 2011): as good as four times the samples", light_field),
      worth_four_times_in(findings, "axis-aligned (Mehta et al. 2012): as good as four times the samples in a penumbra",
                          penumbra)};
}

}  // namespace

double part_of_even(const Findings& findings, const Outcome& adaptive, const std::string& label) {
  return adaptive.error("trimmed_relMSE") / same_frame(findings, adaptive, label).error("trimmed_relMSE");
}

std::vector<Verdict> claims(const Findings& findings) {
  std::vector<Claim> all = claims_of_papers(findings);
  for (const char* label : adapted_labels) all.push_back(adapted_gains(findings, label));
  for (const char* preset : {"fast", "balanced", "high"}) all.push_back(beats_all(findings, preset));
  if (findings.has(open_image_denoise_label))
    all.push_back(less_than(findings, "high is better than Open Image Denoise", "high", open_image_denoise_label,
                            error_named("relMSE")));
  std::vector<Verdict> verdicts;
  verdicts.reserve(all.size());
  for (const Claim& claim : all) verdicts.push_back(judged(findings, claim));
  return verdicts;
}

}  // namespace rpf::study
