// What the parts of the study "contemporaries" share: names of runs, and the statements that they judge.
#pragma once

#include "study/story.h"

namespace rpf::study {

/// The label of a run whose samples went where the noise is.
inline std::string adapted(const std::string& label) { return label + ", adaptive"; }

constexpr const char *axis_aligned = "axis-aligned", *light_field = "lightfield",
                     *open_image_denoise_label = "Open Image Denoise";

/// What was filtered with adaptive samples too; against the same number of samples everywhere.
inline const std::vector<const char*> adapted_labels = {"plain mean", "gem", "nlm", "sbf", "balanced"};

/// Trimmed relMSE of an adaptive run as part of that with as many samples everywhere.
double part_of_even(const Findings& findings, const Outcome& adaptive, const std::string& label);

/// The main statement of each paper in our words, and those on adaptive sampling, each over all scenes and numbers of
/// samples that were run.
std::vector<Verdict> claims(const Findings& findings);

}  // namespace rpf::study
