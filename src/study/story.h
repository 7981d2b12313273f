// The page of a study while it is told, and the JSON behind it.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/html_page.h"
#include "report/plot.h"
#include "study/findings.h"
#include "study/regions.h"

namespace rpf::study {

/// A statement of the thesis, what was measured, and whether it holds.
struct Verdict {
  std::string statement, measured, verdict;
};

/// A column of numbers in a table of runs.
struct Column {
  std::string name;
  std::function<std::string(const Outcome&)> text;
};

using Outcomes = std::vector<const Outcome*>;

class Story {
 public:
  /// `pictures`: the folder for pictures and plots as files; they are in the page too.
  Story(const Experiment& experiment, const Extent& extent, const Findings& findings, std::string pictures);

  /// Whether this is the quick form of the study.
  bool quick() const { return quick_; }
  void heading(const std::string& text) { page_.heading(text); }
  void paragraph(const std::string& text) { page_.paragraph(text); }
  void table(const report::Table& table) { page_.table(table); }
  void verdicts(const std::vector<Verdict>& verdicts);
  /// A row a run: label and options, relMSE, MSE, SSIM, FLIP, energy, CPU seconds, and more columns.
  void runs(const Outcomes& outcomes, const std::vector<Column>& more = {});
  /// A picture each, and the reference last; with a region also that part, enlarged.
  void pictures(const Outcomes& outcomes, const std::optional<Region>& region = {});
  /// `name`: of the file.
  void plot(const std::string& name, const report::Plot& plot, const std::string& caption);
  /// A number that the page tells beside the runs' own.
  void value(const std::string& group, const std::string& name, double number);

  /// Adds what repeats the runs; then writes STEM.html and STEM.json.
  void write(const std::string& stem);

  /// The measure of a region as a column; its numbers stand in the JSON too.
  Column error_in(const Region& region);
  Column detail_in(const Region& region);
  Column step_in(const Region& region);
  static double number_in(const Outcome& outcome, const Region& region,
                          double (*measure)(const Image&, const Image&, const Region&));

 private:
  std::string picture_of(const Image& image, const std::string& name, const std::optional<Region>& region);
  Column measure_in(const Region& region, const char* name,
                    double (*measure)(const Image&, const Image&, const Region&));

  const Findings& findings_;
  bool quick_;
  std::string pictures_;
  report::HtmlPage page_;
  nlohmann::ordered_json json_;
};

/// Numbers as tables have them: three significant digits.
std::string number(double value);

/// "holds" or "does not hold".
std::string verdict_of(bool holds);

/// "holds", "does not hold", or "holds on 2 of 3 scenes"; `what` was judged.
std::string verdict_of(std::size_t holding, std::size_t all, const char* what = "scenes");

}  // namespace rpf::study
