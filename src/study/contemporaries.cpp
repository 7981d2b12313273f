// The related work of the thesis beside ours: filters of 2008 to 2012, both profiles, the presets, Open Image Denoise.
#include "study/contemporaries.h"

#include <fmt/format.h>

#include <cmath>

#include "study/comparisons.h"
#include "study/open_image_denoise.h"
#include "study/places.h"

namespace rpf::study {
namespace {

const std::vector<Setting> settings = {{"plain mean", plain_mean},
                                       {"Gaussian", "--method gaussian"},
                                       {"bilateral", "--method bilateral"},
                                       {"cross-bilateral", "--method cross-bilateral"},
                                       {"gem", "--method gem"},
                                       {"nlm", "--method nlm"},
                                       {"sbf", "--method sbf"},
                                       {"multidim", "--method multidim"},
                                       {"thesis", "--profile thesis"},
                                       {"paper", "--profile paper"},
                                       {"fast", "--preset fast"},
                                       {"balanced", "--preset balanced"},
                                       {"high", "--preset high"}};

/// In the order of tables and plots.
std::vector<std::string> labels(const Findings& findings) {
  std::vector<std::string> all;
  all.reserve(settings.size() + 3);
  for (const Setting& setting : settings) all.emplace_back(setting.label);
  all.emplace_back(axis_aligned);
  all.emplace_back(light_field);
  if (findings.has(open_image_denoise_label)) all.emplace_back(open_image_denoise_label);
  return all;
}

constexpr int adapted_samples = 16;

std::vector<const char*> scenes(bool quick) {
  return quick ? std::vector<const char*>{"dof", "soft-shadow"}
               : std::vector<const char*>{"dof", "motion", "soft-shadow", "glossy", "column", "combined"};
}

std::vector<int> counts(bool quick) { return quick ? std::vector<int>{4, 16} : std::vector<int>{4, 16, 64}; }

const char* options_of(const std::string& label) {
  for (const Setting& setting : settings)
    if (label == setting.label) return setting.options;
  return plain_mean;
}

void add_frame(std::vector<Run>& runs, const bench::SweepFrame& frame) {
  for (const Setting& setting : settings) runs.push_back({setting.label, frame, setting.options});
  if (has_open_image_denoise()) runs.push_back({open_image_denoise_label, frame, plain_mean, true});
  // Apart: the others would take their channels for features.
  bench::SweepFrame with_penumbra = frame, with_lightfield = frame;
  with_penumbra.penumbra = with_lightfield.lightfield = true;
  runs.push_back({axis_aligned, with_penumbra, "--method axis-aligned"});
  runs.push_back({light_field, with_lightfield, "--method lightfield"});
}

const Quantity error = error_named("relMSE"), cpu = cpu_seconds();

/// The geometric mean over the scenes.
double mean_of(const Findings& findings, const std::string& label, int samples, const Quantity& quantity) {
  double sum = 0;
  for (const std::string& scene : findings.scenes()) sum += std::log(quantity.of(findings.at(scene, label, samples)));
  return std::exp(sum / static_cast<double>(findings.scenes().size()));
}

/// A curve a method, its points the numbers of samples.
report::Plot plot_against(const Findings& findings, bool quick, const std::string& x_label,
                          const std::function<double(const std::string&, int)>& x) {
  report::Plot plot{x_label, "relMSE", {}, true, true, false, {}};
  for (const std::string& label : labels(findings)) {
    report::Curve curve{label, {}};
    for (const int count : counts(quick))
      curve.points.push_back({x(label, count), mean_of(findings, label, count, error)});
    plot.curves.push_back(curve);
  }
  return plot;
}

void tell_plots(const Findings& findings, Story& story) {
  report::Plot samples =
      plot_against(findings, story.quick(), "samples a pixel", [](const auto&, int count) { return double(count); });
  for (const int count : counts(story.quick())) samples.x_ticks.push_back(count);
  story.plot("samples", samples, "Error against the number of samples, geometric means over the scenes");
  story.plot(
      "time",
      plot_against(findings, story.quick(), "CPU seconds",
                   [&](const std::string& label, int count) { return mean_of(findings, label, count, cpu); }),
      "Error against CPU time of filtering, geometric means over the scenes; points of a line: more and more samples");
}

void tell_means(const Findings& findings, Story& story) {
  report::Table table{{"method"}, {}, 1};
  for (const Quantity& quantity : {error, cpu})
    for (const int count : counts(story.quick())) table.header.push_back(fmt::format("{} at {}", quantity.name, count));
  for (const std::string& label : labels(findings)) {
    table.rows.push_back({label});
    for (const Quantity& quantity : {error, cpu})
      for (const int count : counts(story.quick())) {
        const double mean = mean_of(findings, label, count, quantity);
        table.rows.back().push_back(number(mean));
        story.value(fmt::format("{} at {}", quantity.name, count), label, mean);
      }
  }
  story.heading("All scenes together, geometric means");
  story.table(table);
}

void tell_adaptive(const Findings& findings, Story& story) {
  story.heading("Samples where the noise is");
  story.paragraph(fmt::format(
      "{} samples a pixel everywhere, and as many as rpf adapt places them from {} on: trimmed relMSE of both.",
      adapted_samples, bench::adapted_from));
  report::Table table{{"scene"}, {}, 1};
  table.header.insert(table.header.end(), adapted_labels.begin(), adapted_labels.end());
  for (const std::string& scene : findings.scenes()) {
    table.rows.push_back({scene});
    for (const std::string label : adapted_labels) {
      const Outcome& adaptive = findings.at(scene, adapted(label), adapted_samples);
      const double part = part_of_even(findings, adaptive, label), after = adaptive.error("trimmed_relMSE");
      table.rows.back().push_back(
          fmt::format("{}, {} ({:+.0f} %)", number(after / part), number(after), 100 * (part - 1)));
    }
  }
  story.table(table);
  for (const std::string& scene : findings.scenes()) {
    Outcomes shown;
    for (const std::string& label : {std::string("plain mean"), adapted("plain mean"), adapted("balanced")})
      shown.push_back(&findings.at(scene, label, adapted_samples));
    story.pictures(shown, center);
  }
}

void tell_scene(const Findings& findings, const std::string& scene, Story& story) {
  story.heading(scene);
  Outcomes shown;
  for (const std::string& label : labels(findings)) shown.push_back(&findings.at(scene, label));
  story.pictures(shown, center);
  story.runs(findings.on(scene),
             {{"samples", [](const Outcome& o) { return std::to_string(o.run.frame.samples_per_pixel); }}});
}

void tell_what_is_missing(const Findings& findings, Story& story) {
  story.heading("What is not here");
  if (!findings.has(open_image_denoise_label))
    story.paragraph(
        "Open Image Denoise was not found where this page was made. Where its library is installed, or its folder is "
        "in LD_LIBRARY_PATH, the study measures it too.");
  story.paragraph(
      "No filters of recorded samples are: sampling of visibility and semi-analytical visibility, which decide what "
      "is traced; compressive estimation, which solves for a picture from samples placed for that; the indirect light "
      "field, which traces the recorded light again.");
}

}  // namespace

std::vector<Run> plan_contemporaries(const Extent& extent) {
  std::vector<Run> runs;
  for (const char* scene : scenes(extent.quick)) {
    for (const int count : counts(extent.quick)) add_frame(runs, frame_of(scene, extent, count));
    bench::SweepFrame frame = frame_of(scene, extent, adapted_samples);
    frame.adapted = true;
    for (const char* label : adapted_labels) runs.push_back({adapted(label), frame, options_of(label)});
  }
  return runs;
}

void tell_contemporaries(const Findings& findings, Story& story) {
  story.verdicts(claims(findings));
  story.paragraph(
      "The papers' main statements in our words, each judged on every scene and number of samples; all constants are "
      "the papers', but for multidim and lightfield, whose papers were not at hand. Their boxes count in pixels, so a "
      "small picture is blurred more by wide ones: what loses here by "
      "a little may win in a large picture.");
  tell_plots(findings, story);
  tell_means(findings, story);
  tell_adaptive(findings, story);
  for (const std::string& scene : findings.scenes()) tell_scene(findings, scene, story);
  tell_what_is_missing(findings, story);
}

}  // namespace rpf::study
