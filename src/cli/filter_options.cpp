#include "cli/filter_options.h"

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <regex>

#include "cli/choices.h"
#include "cli/environment.h"
#include "cli/method_options.h"
#include "cli/numbers.h"
#include "rpf/error.h"
#include "rpf/filter.h"
#include "rpf/methods.h"
#include "rpf/presets.h"

namespace rpf::cli {
namespace {

constexpr const char* running_group = "Running";

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& expected) {
  constexpr std::size_t shown = 40;
  throw Error(ErrorKind::usage, fmt::format("{} {}: {}", option, value.substr(0, shown), expected));
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t comma; (comma = text.find(',', begin)) != std::string::npos; begin = comma + 1)
    parts.push_back(text.substr(begin, comma - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

std::vector<int> box_widths(const std::string& text) {
  std::vector<int> widths;
  if (text == "none") return widths;
  for (const std::string& part : split(text)) {
    const std::string refusal = refusal_of(part, ranges::box_width);
    if (!refusal.empty()) refuse("--boxes", text, refusal + ", several with commas, or none for the plain mean");
    widths.push_back(std::stoi(part));
  }
  return widths;
}

std::vector<std::string> groups(const std::string& text) {
  return text == "none" ? std::vector<std::string>{} : split(text);
}

void add_file_options(CLI::App& app, FilterOptions& o) {
  app.add_option("-i,--input,INPUT", o.input, "Sample file (deep OpenEXR or raw floats)")->type_name("FILE");
  app.add_option("-o,--output", o.output, "Filtered image; the extension chooses the format (exr, png, ...)")
      ->type_name("FILE");
  app.add_option(
         "--aov", o.aov,
         "Also write the features, filtered with the same weights: layers of FILE.exr, or one file each in a folder")
      ->type_name("FILE|DIR");
  app.add_flag("--error", o.settings.estimate_error,
               "Also estimate the relative error of each pixel: layer error of --aov; twice the time")
      ->needs("--aov");
  app.add_option("--report", o.report, "Also write a page about the frame, before and after, as rpf report does")
      ->type_name("FILE.html");
  add_map_option(app, o.map);
}

void add_model_options(CLI::App& app, FilterOptions& o) {
  add_preset_option(app, o.preset);
  app.add_option("--model", o.settings.model, "The network of this file in place of a preset's")
      ->type_name("FILE")
      ->excludes("--preset");
  app.add_option("--time-budget", o.time_budget,
                 "Take the most accurate preset that is predicted to be done in this time, such as 10s, 500ms or 2m")
      ->excludes("--preset");
  app.add_option(
         "--profile", o.profile,
         "Random Parameter Filtering as published. thesis: M = b^2/2 samples a neighborhood; paper: M = b^2 s/2 "
         "and the outlier step")
      ->check(one_of({"thesis", "paper"}))
      ->capture_default_str();
  app.add_option("--boxes", o.boxes, "Box width of each pass in pixels, or none")
      ->type_name("LIST")
      ->default_str("55,35,17,7");
  const auto number = [&](const char* name, auto& value, const NumberRange& range, const char* text) {
    return restrict_to(app.add_option(name, value, text), range);
  };
  number("--samples-factor", o.samples_factor, ranges::factor, "M = FACTOR * b^2 in place of the profile's");
  number("--max-samples", o.settings.max_samples, ranges::count, "Upper limit of M");
  number("--noise", o.settings.noise, ranges::noise, "sigma_8^2: 0.02 for very noisy scenes, 0.002 otherwise")
      ->capture_default_str();
  number("--bins", o.settings.bins, ranges::bins, "Histogram bins, odd")->capture_default_str();
  add_channel_options(app, o);
  app.add_flag("--drop-uninformative", o.settings.drop_uninformative,
               "Leave out random parameters and features that carry no information");
  number("--seed", o.settings.seed, ranges::seed, "Seed of the neighborhood draws")->capture_default_str();
}

void add_tuning_options(CLI::App& app, FilterOptions& o) {
  const std::string group = "Choices (docs/deviations.md)";
  Settings& s = o.settings;
  const auto number = [&](const char* name, auto& value, const NumberRange& range, const char* text) {
    restrict_to(app.add_option(name, value, text), range)->capture_default_str()->group(group);
  };
  number("--alpha-factor", s.alpha_factor, ranges::alpha_factor, "Factor in alpha (T 5.9)");
  number("--position-scale", s.position_scale, ranges::position_scale,
         "Least tolerance of positions: 0.1 * scene diagonal / SCALE");
  number("--redraws", s.redraws, ranges::redraws, "Further attempts of a draw that left the image");
  app.add_flag("--reject-second-hit", s.reject_second_hit, "Features of the second hit take part in the rejection")
      ->group(group);
  app.add_flag("--bias-correction", s.bias_correction, "Subtract the bias of the mutual information")->group(group);
  app.add_flag("--clamp-negative", s.clamp_negative, "Negative radiance becomes 0")->group(group);
  app.add_flag("--clamp-infinite", s.clamp_infinite,
               "Infinite radiance of float channels becomes the largest float, as that of half channels always becomes "
               "65504; else such a sample is left out")
      ->group(group);
}

void add_run_options(CLI::App& app, FilterOptions& o) {
  app.add_option("--crop", o.crop, "Filter only this part; its pixels are those of the whole frame")
      ->type_name("WxH+X+Y")
      ->group(running_group);
  app.add_option("--rows", o.rows,
                 "Filter only these rows, such as 0-269, or the first, second, ... of so many parts of them, such as "
                 "2/4; rpf join makes a whole of parts")
      ->type_name("A-B|PART/PARTS")
      ->excludes("--crop")
      ->group(running_group);
  app.add_option(
         "--facts", o.facts,
         "What rpf facts found in the whole frame with these settings, so that only rows that are needed are read")
      ->type_name("FILE")
      ->group(running_group);
  add_machine_options(app, o);
  app.add_flag("--dry-run", o.dry_run, "Check options, files and memory; write nothing")->group(running_group);
  app.add_flag("-v,--verbose", o.verbose, "Say what every pass did")->group(running_group);
}

/// What an option among the arguments says, read before they are parsed; empty without it.
std::string value_in(const std::vector<std::string>& arguments, const std::string& option) {
  CLI::App app;
  app.allow_extras();
  app.set_help_flag();
  std::string value;
  app.add_option(option, value);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  app.parse(reversed);
  return value;
}

}  // namespace

void add_preset_option(CLI::App& app, std::string& preset) {
  std::vector<std::string> names;
  std::string text = "Which network weighs the samples";
  for (const PresetInfo& info : presets()) {
    names.push_back(info.name);
    text += fmt::format("\n{}: {}", info.name, info.purpose);
  }
  app.add_option("--preset", preset, text)->check(one_of(names))->default_str("balanced");
}

void add_map_option(CLI::App& app, std::vector<std::string>& map) {
  app.add_option("--map", map, "SLOT=CHANNEL: read a slot from a channel of another name; SLOT= leaves the slot out")
      ->type_name("SLOT=CHANNEL")
      ->allow_extra_args(false);
}

void add_channel_options(CLI::App& app, FilterOptions& o) {
  app.add_option("--features", o.features,
                 "Groups of features to model, first (all but those of the second hit), or none")
      ->type_name("LIST")
      ->default_str("all");
  app.add_option("--random", o.random,
                 "Groups of random parameters to model, all, or none; pixel is the position inside the pixel")
      ->type_name("LIST")
      ->default_str("lens,time,light,bsdf; of the profiles lens,time,light, with pixel in thesis");
}

std::array<CLI::Option*, 2> add_backend_options(CLI::App& app, std::string& backend, std::string& device) {
  return {
      app.add_option(
             "--backend", backend,
             "cpu: the scalar reference; opencl: the same bits, faster; auto: opencl where a device passes its test")
          ->check(one_of(backend_names(), "RPF_BACKEND"))
          ->envname("RPF_BACKEND")
          ->capture_default_str(),
      app.add_option("-d,--device", device, "OpenCL device: index of `rpf devices` or a part of its name")
          ->envname("RPF_DEVICE")};
}

void add_machine_options(CLI::App& app, FilterOptions& o) {
  for (CLI::Option* option : add_backend_options(app, o.settings.backend, o.settings.device))
    option->group(running_group);
  add_running_options(app, o);
}

void add_running_options(CLI::App& app, FilterOptions& o) {
  restrict_to(app.add_option("-t,--threads", o.settings.threads, "Threads; all cores if not given"), ranges::threads,
              "RPF_NUM_THREADS")
      ->group(running_group);
  add_memory_option(app, o.max_memory_mb)->group(running_group);
  app.add_option("--progress", o.progress, "auto, never, always")
      ->check(one_of({"auto", "never", "always"}))
      ->capture_default_str()
      ->group(running_group);
  app.add_flag("-q,--quiet", o.quiet, "Only errors")->group(running_group);
}

CLI::Option* add_memory_option(CLI::App& app, std::uint64_t& megabytes) {
  return restrict_to(app.add_option("--max-memory", megabytes, "Memory limit in MB"), ranges::megabytes,
                     "RPF_MAX_MEMORY_MB");
}

void add_picture_options(CLI::App& app, FilterOptions& options) {
  add_method_options(app, options);
  add_model_options(app, options);
  add_tuning_options(app, options);
}

void add_filter_options(CLI::App& app, FilterOptions& options) {
  add_file_options(app, options);
  add_picture_options(app, options);
  add_run_options(app, options);
}

void start_from(const Settings& named, FilterOptions& options) {
  const std::string backend = options.settings.backend;
  options.settings = named;
  options.settings.backend = backend;
  options.profile = named.profile == Profile::paper ? "paper" : "thesis";
  options.method = name_of(named.method);
}

void start_from_named_settings(const std::vector<std::string>& arguments, const std::string& preset,
                               FilterOptions& options) {
  const std::string method = value_in(arguments, "--method");
  const std::string name = preset.empty() ? value_in(arguments, "--preset") : preset;
  if (!method.empty()) start_from(method_settings(method), options);
  if (!method.empty() && options.settings.method != Method::learned) return;
  const bool is_published = asks_for_published(arguments) && value_in(arguments, "--model").empty();
  if (!name.empty() || !is_published) start_from(preset_settings(name.empty() ? "balanced" : name), options);
}

FilterOptions parse_filter_options(const std::vector<std::string>& arguments, const std::string& preset) {
  CLI::App app;
  FilterOptions options;
  start_from_named_settings(arguments, preset, options);
  add_filter_options(app, options);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  app.parse(reversed);
  return options;
}

double time_budget_of(const FilterOptions& options) {
  if (options.time_budget.empty()) return 0;
  static const std::map<std::string, double> seconds = {{"", 1}, {"s", 1}, {"ms", 1e-3}, {"m", 60}, {"h", 3600}};
  static const std::regex pattern(R"((\d{1,9}|\d{0,9}\.\d{1,9})(s|ms|m|h|))");
  std::smatch parts;
  const bool is_time = std::regex_match(options.time_budget, parts, pattern);
  const double number = is_time ? std::stod(parts[1]) : 0;
  if (number <= 0) refuse("--time-budget", options.time_budget, "a time above 0 is expected, such as 10s, 500ms or 2m");
  return number * seconds.at(parts[2]);
}

Window window_of(const std::string& option, const std::string& text) {
  // +-37 is what %+d after a plus makes of a negative position, as other programs print it.
  static const std::regex pattern(R"((\d{1,9})x(\d{1,9})(\+|-|\+-)(\d{1,9})(\+|-|\+-)(\d{1,9}))");
  std::smatch parts;
  if (!std::regex_match(text, parts, pattern) || std::stoi(parts[1]) == 0 || std::stoi(parts[2]) == 0)
    refuse(option, text, "WIDTHxHEIGHT+X+Y is expected, such as 256x128+100+60 or 8x6-37-12");
  const auto place = [&](int sign) { return std::stoi(parts[sign + 1]) * (parts[sign] == "+" ? 1 : -1); };
  return {place(3), place(5), std::stoi(parts[1]), std::stoi(parts[2])};
}

std::pair<int, int> size_of(const std::string& text) {
  constexpr int longest_side = 1 << 20;
  int width = 0, height = 0, used = 0;
  const bool parsed = std::sscanf(text.c_str(), "%7dx%7d%n", &width, &height, &used) == 2;
  if (!parsed || width < 1 || height < 1 || width > longest_side || height > longest_side ||
      used != static_cast<int>(text.size()))
    refuse("--size", text, fmt::format("WIDTHxHEIGHT from 1 to {} pixels is expected, such as 480x270", longest_side));
  return {width, height};
}

Settings settings_of(const FilterOptions& o) {
  Settings s = o.settings;
  s.profile = o.profile == "paper" ? Profile::paper : Profile::thesis;
  if (!o.boxes.empty()) s.box_widths = box_widths(o.boxes);
  if (o.samples_factor > 0) s.samples_factor = o.samples_factor;
  if (o.sigma_color > 0) s.sigma_color = o.sigma_color;
  if (!o.features.empty()) s.features = groups(o.features);
  if (!o.random.empty()) s.random = groups(o.random);
  if (!o.crop.empty()) s.crop = window_of("--crop", o.crop);
  s.filter_features = !o.aov.empty();
  if (s.threads == 0) s.threads = default_threads();
  s.max_memory = memory_limit(o.max_memory_mb);
  validate(s);  // before a file is read
  return s;
}

SampleReadOptions read_options_of(const std::vector<std::string>& map, std::uint64_t max_memory) {
  SampleReadOptions options;
  options.max_memory = max_memory;
  options.threads = default_threads();
  for (const std::string& entry : map) {
    const auto equals = entry.find('=');
    if (equals == std::string::npos || equals == 0)
      refuse("--map", entry, "SLOT=CHANNEL is expected, such as feature.N.X=Ns.X");
    options.slot_map[entry.substr(0, equals)] = entry.substr(equals + 1);
  }
  return options;
}

SampleReadOptions read_options_of(const FilterOptions& options, const Settings& settings) {
  SampleReadOptions reading = read_options_of(options.map, settings.max_memory);
  reading.threads = settings.threads;
  return reading;
}

}  // namespace rpf::cli
