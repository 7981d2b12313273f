#include "study/harness.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "bench/results_file.h"
#include "bench/run_json.h"
#include "report/plot.h"
#include "rpf/error.h"
#include "rpf/filter.h"
#include "rpf/io.h"
#include "rpf/outputs.h"
#include "rpf/scene.h"
#include "study/findings.h"
#include "study/open_image_denoise.h"
#include "study/story.h"
#include "study/work.h"

namespace rpf::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What the run is called in file names: everything that its result depends on.
std::string file_name_of(const Run& run) {
  std::string name = fs::path(run.frame.samples).stem().stem().string() + " " + treatment_of(run);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != ',' && c != '.') c = '_';
  return name;
}

std::string key_of(const Run& run) {
  return fmt::format("{} | {}", file_name_of(run), fs::path(run.frame.reference).filename().string());
}

/// The commands that make the run's image and measure it.
Json commands_of(const Run& run) {
  const bench::SweepFrame& f = run.frame;
  const std::string scene = fmt::format("rpf scene {} --size {}x{}", f.scene, f.width, f.height);
  const std::string samples = fs::path(f.samples).filename().string(),
                    reference = fs::path(f.reference).filename().string();
  const std::string grow =
      fmt::format("rpf adapt {} --spp {} -- {} --spp 1 --density {{density}} --seed {{seed}} -o {{output}}", samples,
                  f.samples_per_pixel, scene);
  const std::string kinds =
      std::string(f.penumbra ? " --penumbra" : "") + std::string(f.lightfield ? " --lightfield" : "");
  Json commands = {
      fmt::format("{} --spp {}{} -o {}", scene, f.adapted ? bench::adapted_from : f.samples_per_pixel, kinds, samples)};
  if (f.adapted) commands.push_back(grow);
  commands.push_back(fmt::format("{} --reference {} --sampler sobol -o {}", scene, f.reference_samples, reference));
  commands.push_back(run.denoised
                         ? fmt::format("rpf {} --aov features.exr {} -o mean.exr  # then Open Image Denoise: color, "
                                       "albedo, normal to filtered.exr",
                                       run.options, samples)
                         : fmt::format("rpf {} {} -o filtered.exr", run.options, samples));
  commands.push_back(fmt::format("rpf compare filtered.exr {}", reference));
  return commands;
}

/// Says how far the whole is while parts of it run.
class Meter {
 public:
  Meter(double work, std::size_t runs, const Watch& watch) : work_(work), watch_(watch) { state_.runs = runs; }

  void begin(const std::string& what, std::size_t run) {
    state_.what = what;
    state_.run = run;
  }
  /// A control for a part of the work that takes `work`.
  Control control(double work) {
    Control control;
    control.progress = [this, work](const Progress& progress) { return tell(done_ + work * progress.fraction); };
    return control;
  }
  void finish(double work) { done_ += work; }

 private:
  bool tell(double done) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    state_.fraction = work_ > 0 ? done / work_ : 1;
    state_.seconds_left = done > 0 ? passed.count() * (work_ - done) / done : -1;
    return watch_(state_);
  }

  double work_, done_ = 0;
  const Watch& watch_;
  StudyProgress state_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The runs of a plan on their way to a results file.
class Measuring {
 public:
  Measuring(std::vector<Run> runs, const fs::path& folder, const StudyOptions& options, const std::string& results)
      : runs_(std::move(runs)), folder_(folder), options_(options), results_(results, "label") {}

  std::size_t missing() const {
    std::size_t count = 0;
    for (const Run& run : runs_) count += has(run) ? 0 : 1;
    return count;
  }

  void measure_missing(const Watch& watch) {
    Meter meter(work(), runs_.size(), watch);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (has(runs_[i])) continue;
      meter.begin(fmt::format("{}, {} samples a pixel, {}", runs_[i].frame.scene, runs_[i].frame.samples_per_pixel,
                              runs_[i].label),
                  i + 1);
      measure(runs_[i], meter);
    }
  }

  Findings findings() const {
    std::map<std::string, Json> lines;
    for (const Json& line : results_.lines()) lines[line.at("key").get<std::string>()] = line;
    std::vector<Outcome> outcomes;
    for (const Run& run : runs_) outcomes.push_back({run, lines.at(key_of(run)), image_of(run)});
    return Findings(std::move(outcomes));
  }

 private:
  std::string image_of(const Run& run) const { return (folder_ / "images" / (file_name_of(run) + ".exr")).string(); }
  bool has(const Run& run) const {
    return results_.has(key_of(run)) && fs::exists(image_of(run)) && fs::exists(run.frame.reference);
  }

  double work() const {
    double sum = 0;
    std::set<std::string> references, samples;  // counted once
    for (const Run& run : runs_) {
      if (has(run)) continue;
      sum += filtering_work(run.frame, options_.settings_of(run.options));
      if (!fs::exists(run.frame.reference) && references.insert(run.frame.reference).second)
        sum += rendering_work(run.frame, run.frame.reference_samples);
      if (samples.insert(run.frame.samples).second) sum += rendering_work(run.frame, run.frame.samples_per_pixel);
    }
    return sum;
  }

  void measure(const Run& run, Meter& meter) {
    const Image& reference = reference_of(run.frame, meter);
    SampleBuffer samples = samples_of(run.frame, meter);  // a copy: filter() works in it
    const Settings settings = options_.settings_of(run.options);
    const double work = filtering_work(run.frame, settings);
    const bench::CostClock clock;
    Result result = run.denoised ? open_image_denoise(std::move(samples))
                                 : filter(std::move(samples), settings, meter.control(work));
    const bench::Cost cost = clock.elapsed();
    meter.finish(work);
    make_folder((folder_ / "images").string());
    write_image(image_of(run), result.image);
    Json line{{"label", run.label}, {"scene", run.frame.scene}, {"options", treatment_of(run)}};
    line["commands"] = commands_of(run);
    line.update(bench::json_of({cost, cost, std::move(result.report), compare_images(result.image, reference)}));
    results_.add(key_of(run), line);
  }

  const Image& reference_of(const bench::SweepFrame& frame, Meter& meter) {
    const auto found = references_.find(frame.reference);
    if (found != references_.end()) return found->second;
    const bool missing = !fs::exists(frame.reference);
    const double work = rendering_work(frame, frame.reference_samples);
    bench::make_reference(frame, meter.control(work));
    if (missing) meter.finish(work);
    return references_[frame.reference] = read_image(frame.reference);
  }

  /// Of the frame that was asked for last: a plan takes frame after frame.
  const SampleBuffer& samples_of(const bench::SweepFrame& frame, Meter& meter) {
    if (samples_name_ == frame.samples) return samples_;
    samples_ = {};
    samples_name_.clear();
    const double work = rendering_work(frame, frame.samples_per_pixel);
    samples_ = bench::render_samples(frame, meter.control(work));
    meter.finish(work);
    samples_name_ = frame.samples;
    return samples_;
  }

  std::vector<Run> runs_;
  fs::path folder_;
  const StudyOptions& options_;
  bench::ResultsFile results_;
  std::map<std::string, Image> references_;
  SampleBuffer samples_;
  std::string samples_name_;
};

std::vector<Run> checked_plan(const Experiment& experiment, const StudyOptions& options) {
  std::vector<Run> runs = experiment.plan(options.extent);
  for (Run& run : runs) {
    options.settings_of(run.options);
    bench::name_scene_files(run.frame, (fs::path(options.folder) / "scenes").string());
  }
  return runs;
}

std::string stem_of(const Experiment& experiment, const StudyOptions& options) {
  return (fs::path(options.folder) / experiment.name).string();
}

PlannedOutput in_folder(const fs::path& folder, const char* name) {
  PlannedOutput output{(folder / name).string()};
  output.makes_folder = true;
  return output;
}

/// Pages, and for each folder a file as there will be.
std::vector<PlannedOutput> planned_outputs(const std::string& stem, const fs::path& folder) {
  return {{stem + ".html", OutputKind::page},
          {stem + ".json", OutputKind::page},
          in_folder(folder / "images", "filtered.exr"),
          in_folder(folder / "scenes", "reference.exr"),
          in_folder(stem + ".pictures", "picture.png")};
}

/// The runs, once it is known that they and all files can be.
std::vector<Run> checked_runs(const Experiment& experiment, const StudyOptions& options) {
  std::vector<Run> runs = checked_plan(experiment, options);
  report::check_plotting();
  make_folder(options.folder);
  const std::string stem = stem_of(experiment, options);
  check_outputs(planned_outputs(stem, options.folder), {});
  check_target(stem + ".runs.jsonl");
  return runs;
}

}  // namespace

void check_experiment(const Experiment& experiment, const StudyOptions& options) { checked_runs(experiment, options); }

StudyDone run_experiment(const Experiment& experiment, const StudyOptions& options, const Watch& watch) {
  std::vector<Run> runs = checked_runs(experiment, options);
  const std::string stem = stem_of(experiment, options);
  const std::size_t count = runs.size();
  Measuring measuring(std::move(runs), options.folder, options, stem + ".runs.jsonl");
  const std::size_t missing = measuring.missing();
  measuring.measure_missing(watch);
  make_folder(stem + ".pictures");
  const Findings findings = measuring.findings();
  Story story(experiment, options.extent, findings, stem + ".pictures");
  experiment.tell(findings, story);
  story.write(stem);
  return {stem + ".html", missing, count - missing};
}

}  // namespace rpf::study
