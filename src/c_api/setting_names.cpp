#include "c_api/setting_names.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <vector>

#include "rpf/error.h"
#include "rpf/methods.h"
#include "rpf/presets.h"
#include "rpf/ranges.h"

namespace rpf::c_api {
namespace {

using Setter = std::function<void(Settings&, const std::string& name, const std::string& value)>;

[[noreturn]] void refuse(const std::string& name, const std::string& value, const std::string& expected) {
  throw Error(ErrorKind::usage, fmt::format("{} '{}': {}", name, value.substr(0, 40), expected));
}

double number_of(const std::string& name, const std::string& value, const NumberRange& range) {
  double number = 0;
  const char* end = value.data() + value.size();
  const auto [stop, failure] = std::from_chars(value.data(), end, number);  // strtod() would ask the locale
  if (failure != std::errc() || stop != end || !range.has(number)) refuse(name, value, range.expected());
  return number;
}

template <class T>
Setter number(T Settings::*field, const NumberRange& range) {
  return [=](Settings& s, const std::string& name, const std::string& value) {
    s.*field = static_cast<T>(number_of(name, value, range));
  };
}

Setter maybe_number(std::optional<double> Settings::*field, const NumberRange& range) {
  return
      [=](Settings& s, const std::string& name, const std::string& value) { s.*field = number_of(name, value, range); };
}

Setter text(std::string Settings::*field) {
  return [=](Settings& s, const std::string& /*name*/, const std::string& value) { s.*field = value; };
}

Setter flag(bool Settings::*field) {
  return [=](Settings& s, const std::string& name, const std::string& value) {
    if (value != "0" && value != "1") refuse(name, value, "0 or 1 is expected");
    s.*field = value == "1";
  };
}

std::vector<std::string> list_of(const std::string& value) {
  std::vector<std::string> parts;
  if (value == "none") return parts;
  for (std::size_t begin = 0; begin <= value.size();) {
    const std::size_t end = std::min(value.find(',', begin), value.size());
    parts.push_back(value.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

Setter groups(std::optional<std::vector<std::string>> Settings::*field) {
  return [=](Settings& s, const std::string& /*name*/, const std::string& value) { s.*field = list_of(value); };
}

void set_boxes(Settings& s, const std::string& name, const std::string& value) {
  std::vector<int> widths;
  for (const std::string& part : list_of(value))
    widths.push_back(static_cast<int>(number_of(name, part, ranges::box_width)));
  s.box_widths = widths;
}

void set_crop(Settings& s, const std::string& name, const std::string& value) {
  Window w;
  int used = 0;
  const int found = std::sscanf(value.c_str(), "%9dx%9d%d%d%n", &w.width, &w.height, &w.x, &w.y, &used);
  if (found != 4 || used != static_cast<int>(value.size()) || w.width < 1 || w.height < 1)
    refuse(name, value, "WIDTHxHEIGHT+X+Y is expected, such as 256x128+100+60");
  s.crop = w;
}

/// Backend, device and limits stay as they were.
void set_method(Settings& s, const std::string& /*name*/, const std::string& value) {
  Settings named = method_settings(value);
  named.backend = s.backend, named.device = s.device, named.threads = s.threads, named.max_memory = s.max_memory;
  s = named;
}

void set_profile(Settings& s, const std::string& name, const std::string& value) {
  if (value != "thesis" && value != "paper") refuse(name, value, "thesis or paper is expected");
  s.profile = value == "paper" ? Profile::paper : Profile::thesis;
}

void set_max_memory(Settings& s, const std::string& name, const std::string& value) {
  constexpr NumberRange megabytes{1, 1 << 30, "4000", true, false, true};
  s.max_memory = static_cast<std::uint64_t>(number_of(name, value, megabytes)) << 20;
}

const std::map<std::string, Setter>& setters() {
  constexpr NumberRange seed{0, std::numeric_limits<std::uint32_t>::max(), "1", true};
  constexpr NumberRange threads{ranges::threads.least, ranges::threads.most, "8", true, false, true};
  using S = Settings;
  static const std::map<std::string, Setter> all = {
      {"method", set_method},
      {"profile", set_profile},
      {"model", text(&S::model)},
      {"backend", text(&S::backend)},
      {"device", text(&S::device)},
      {"boxes", set_boxes},
      {"samples-factor", maybe_number(&S::samples_factor, ranges::factor)},
      {"max-samples", number(&S::max_samples, ranges::count)},
      {"noise", number(&S::noise, ranges::noise)},
      {"bins", number(&S::bins, ranges::bins)},
      {"random", groups(&S::random)},
      {"features", groups(&S::features)},
      {"drop-uninformative", flag(&S::drop_uninformative)},
      {"seed", number(&S::seed, seed)},
      {"alpha-factor", number(&S::alpha_factor, ranges::alpha_factor)},
      {"position-scale", number(&S::position_scale, ranges::position_scale)},
      {"redraws", number(&S::redraws, ranges::redraws)},
      {"reject-second-hit", flag(&S::reject_second_hit)},
      {"bias-correction", flag(&S::bias_correction)},
      {"clamp-negative", flag(&S::clamp_negative)},
      {"clamp-infinite", flag(&S::clamp_infinite)},
      {"sigma-color", number(&S::sigma_color, ranges::sigma_color)},
      {"damping", number(&S::damping, ranges::damping)},
      {"window", number(&S::window, ranges::box_width)},
      {"gamma", number(&S::gamma, ranges::gamma)},
      {"views", number(&S::views, ranges::views)},
      {"bandwidth", number(&S::bandwidth, ranges::bandwidth)},
      {"sigma-feature", number(&S::sigma_feature, ranges::sigma_feature)},
      {"filter-features", flag(&S::filter_features)},
      {"estimate-error", flag(&S::estimate_error)},
      {"crop", set_crop},
      {"threads", number(&S::threads, threads)},
      {"max-memory", set_max_memory},
  };
  return all;
}

}  // namespace

Settings settings_named(const std::string& name) {
  Settings settings;
  if (name == "paper") settings.profile = Profile::paper;
  if (name != "thesis" && name != "paper") settings = preset_settings(name);
  settings.backend = "auto";  // as the command: the bits are the same
  return settings;
}

void set(Settings& settings, const std::string& name, const std::string& value) {
  const auto found = setters().find(name);
  if (found == setters().end())
    throw Error(ErrorKind::usage, fmt::format("there is no setting '{}'; names are those of the options of rpf --help, "
                                              "without the dashes",
                                              name.substr(0, 40)));
  found->second(settings, name, value);
}

}  // namespace rpf::c_api
