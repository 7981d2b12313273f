#include "run/provenance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rpf/methods.h"
#include "rpf/samples.h"
#include "rpf/version.h"

namespace rpf {
namespace {

/// Not empty: an attribute without text gets lost in many programs.
std::string list(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, " "));
}

std::string neighborhood_text(const Settings& s) {
  std::string text = s.samples_factor              ? fmt::format("{} b^2", *s.samples_factor)
                     : s.profile == Profile::paper ? "b^2 s / 2"
                                                   : "b^2 / 2";
  if (s.max_samples > 0) text += fmt::format(", at most {}", s.max_samples);
  return text;
}

/// How values that cannot be colors are taken.
std::string cleaning_text(const Settings& s) {
  return fmt::format("clamp-negative={} clamp-infinite={}", s.clamp_negative, s.clamp_infinite);
}

std::string choices_text(const Settings& s) {
  return fmt::format(
      "alpha-factor={} position-scale={} redraws={} reject-second-hit={} "
      "bias-correction={} {} drop-uninformative={}",
      s.alpha_factor, s.position_scale, s.redraws, s.reject_second_hit, s.bias_correction, cleaning_text(s),
      s.drop_uninformative);
}

/// What Random Parameter Filtering was told.
void describe_rpf(const Settings& settings, const Report& report, Metadata& m) {
  m["rpf:boxes"] = fmt::format("{}", fmt::join(settings.box_widths, ","));
  m["rpf:profile"] = std::string(settings.profile == Profile::paper ? "paper" : "thesis");
  m["rpf:neighborhood"] = neighborhood_text(settings);
  m["rpf:noise"] = settings.noise;
  m["rpf:bins"] = std::int32_t{settings.bins};
  m["rpf:random"] = list(report.random);
  if (!report.uninformative.empty()) m["rpf:uninformative"] = list(report.uninformative);
  m["rpf:drawSeed"] = static_cast<std::int32_t>(settings.seed);
  m["rpf:choices"] = choices_text(settings);
}

/// Which network it was, and what it was shown.
void describe_learned(const Settings& settings, const Report& report, Metadata& m) {
  m["rpf:model"] = report.model;
  m["rpf:modelHash"] = report.model_hash;
  m["rpf:random"] = list(report.random);
  m["rpf:choices"] = fmt::format("clamp-negative={}", settings.clamp_negative);
}

/// What a method with fixed weights was told.
void describe_fixed_weights(const Settings& settings, Metadata& m) {
  m["rpf:boxes"] = fmt::format("{}", fmt::join(settings.box_widths, ","));
  if (settings.method != Method::gaussian) m["rpf:sigmaColor"] = settings.sigma_color;
  if (settings.method == Method::cross_bilateral) m["rpf:sigmaFeature"] = settings.sigma_feature;
  m["rpf:choices"] = cleaning_text(settings);
}

/// What the light field, or columns of pixels, were told.
void describe_views(const Settings& settings, Metadata& m) {
  m["rpf:views"] = std::int32_t{settings.views};
  m["rpf:choices"] = cleaning_text(settings);
}

/// What a method that filters pixels was told.
void describe_pixel_method(const Settings& settings, Metadata& m) {
  if (settings.method == Method::nlm) {
    m["rpf:damping"] = settings.damping;
    m["rpf:window"] = std::int32_t{settings.window};
  }
  if (settings.method == Method::gem) m["rpf:gamma"] = settings.gamma;
  if (settings.method == Method::axis_aligned) m["rpf:bandwidth"] = settings.bandwidth;
  m["rpf:choices"] = cleaning_text(settings);
}

}  // namespace

Metadata provenance(Metadata input, const Settings& settings, const Report& report) {
  Metadata m = std::move(input);
  m.erase(format_attribute);
  m.erase(version_attribute);
  m["rpf:software"] = std::string("rpf ") + version();
  m["rpf:backend"] = report.backend;
  m["rpf:method"] = name_of(settings.method);
  m["rpf:features"] = list(report.features);
  if (settings.method == Method::rpf)
    describe_rpf(settings, report, m);
  else if (settings.method == Method::learned)
    describe_learned(settings, report, m);
  else if (settings.method == Method::lightfield || settings.method == Method::multidim)
    describe_views(settings, m);
  else if (filters_pixels(settings.method))
    describe_pixel_method(settings, m);
  else
    describe_fixed_weights(settings, m);
  std::vector<std::string> notes;
  for (const InputNote& note : report.notes)
    notes.push_back(fmt::format("{}: {} (first at pixel {},{})", note.what, note.count, note.x, note.y));
  if (!notes.empty()) m["rpf:notes"] = fmt::format("{}", fmt::join(notes, "; "));
  return m;
}

}  // namespace rpf
