// Runs an experiment: what its results file lacks is measured, then its page is written.
#pragma once

#include <functional>
#include <string>

#include "rpf/settings.h"
#include "study/experiment.h"

namespace rpf::study {

struct StudyOptions {
  std::string folder;  ///< made where it is not there
  Extent extent;
  /// What the command's options mean; throws Error(usage). Backend and threads are its business too.
  std::function<Settings(const std::string& options)> settings_of;
};

struct StudyProgress {
  std::string what;  ///< the run in words
  std::size_t run = 0, runs = 0;
  double fraction = 0;       ///< of the work of this start, 0 .. 1, as predicted
  double seconds_left = -1;  ///< estimate; negative while there is none
};

/// Called between tiles. Returning false cancels: what was measured so far stays.
using Watch = std::function<bool(const StudyProgress&)>;

struct StudyDone {
  std::string page;                     ///< the page of HTML; the JSON behind it has the same name
  std::size_t measured = 0, known = 0;  ///< runs
};

/// Finds before the work what run_experiment() would end with, and makes the folder. Throws Error(usage) for options,
/// Error(output) without gnuplot or where a page, the results or a folder cannot be written.
void check_experiment(const Experiment& experiment, const StudyOptions& options);

/// In the folder: NAME.html and NAME.json; NAME.runs.jsonl, a line a run as soon as it is made; scenes/, images/ and
/// NAME.pictures/ with what was rendered, filtered and shown. Pages are whole or untouched. Throws what
/// check_experiment() throws, and what render_scene(), filter() and the writers do.
StudyDone run_experiment(const Experiment& experiment, const StudyOptions& options, const Watch& watch);

}  // namespace rpf::study
