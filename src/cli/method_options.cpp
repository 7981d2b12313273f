#include "cli/method_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/choices.h"
#include "cli/numbers.h"
#include "rpf/error.h"
#include "rpf/methods.h"

namespace rpf::cli {
namespace {

/// Options, and the only methods that they mean something to.
struct Limited {
  std::vector<const char*> options;
  std::vector<Method> methods;
};

const Limited limited[] = {
    {{"--preset", "--model", "--time-budget"}, {Method::learned}},
    {{"--profile", "--samples-factor", "--max-samples", "--noise", "--bins", "--drop-uninformative", "--seed",
      "--alpha-factor", "--position-scale", "--redraws", "--reject-second-hit", "--bias-correction"},
     {Method::rpf}},
    {{"--boxes"}, {Method::rpf, Method::gaussian, Method::bilateral, Method::cross_bilateral}},
    {{"--random"}, {Method::rpf, Method::learned}},
    {{"--features"}, {Method::rpf, Method::cross_bilateral, Method::learned, Method::sbf, Method::axis_aligned}},
    {{"--sigma-color"}, {Method::bilateral, Method::cross_bilateral}},
    {{"--sigma-feature"}, {Method::cross_bilateral}},
    {{"--damping", "--window"}, {Method::nlm}},
    {{"--gamma"}, {Method::gem}},
    {{"--bandwidth"}, {Method::axis_aligned}},
    {{"--views"}, {Method::lightfield, Method::multidim}},
};

bool knows(const Limited& group, Method method) {
  return std::find(group.methods.begin(), group.methods.end(), method) != group.methods.end();
}

void check_given_options(const CLI::App& app, Method method) {
  for (const Limited& group : limited) {
    if (knows(group, method)) continue;
    std::vector<std::string> names;
    for (const Method m : group.methods) names.push_back(name_of(m));
    for (const char* option : group.options)
      if (app.count(option) > 0)
        throw Error(ErrorKind::usage, fmt::format("{} means nothing to --method {}, only to {}; leave it out", option,
                                                  name_of(method), fmt::join(names, " and ")));
  }
}

}  // namespace

bool asks_for_published(const std::vector<std::string>& arguments) {
  const auto is_given = [&](const char* option) {
    return std::any_of(arguments.begin(), arguments.end(),
                       [&](const std::string& a) { return a.substr(0, a.find('=')) == option; });
  };
  return std::any_of(std::begin(limited), std::end(limited), [&](const Limited& group) {
    return !knows(group, Method::learned) && std::any_of(group.options.begin(), group.options.end(), is_given);
  });
}

void add_method_options(CLI::App& app, FilterOptions& o) {
  app.add_option(
         "--method", o.method,
         "learned: weights from a network; rpf: Random Parameter Filtering as published; gaussian: weights from the "
         "distance on the film; bilateral: and from the color; cross-bilateral: and from the features. gaussian and "
         "bilateral also filter any image. Of pixels: nlm: from the likeness of patches; gem: Gaussians, each as wide "
         "as bias and variance allow; sbf: cross-bilateral, each as wide as Stein's risk says; axis-aligned: soft "
         "shadows, as wide as their occluders allow. lightfield: samples seen again from other places of the lens at "
         "other times. multidim: the nearest samples in the space of film, lens and time")
      ->check(one_of(method_names()))
      ->default_str("learned; rpf where an option asks for it");
  restrict_to(app.add_option("--sigma-color", o.sigma_color,
                             "Standard deviation of the color, in linear radiance as the file has it"),
              ranges::sigma_color)
      ->default_str(fmt::format("{:g}, of an image {:g}", Settings{}.sigma_color, image_sigma_color));
  restrict_to(app.add_option("--sigma-feature", o.settings.sigma_feature,
                             "Standard deviation of a feature, 1 is that of its group over the frame"),
              ranges::sigma_feature)
      ->capture_default_str();
  restrict_to(app.add_option("--damping", o.settings.damping, "k of nlm: larger takes patches for more alike"),
              ranges::damping)
      ->capture_default_str();
  restrict_to(app.add_option("--window", o.settings.window, "Box that nlm takes neighbors from, pixels, odd"),
              ranges::box_width)
      ->capture_default_str();
  restrict_to(app.add_option("--gamma", o.settings.gamma, "Of gem: larger holds wide Gaussians back"), ranges::gamma)
      ->capture_default_str();
  restrict_to(app.add_option("--bandwidth", o.settings.bandwidth, "mu of axis-aligned: larger makes filters narrower"),
              ranges::bandwidth)
      ->capture_default_str();
  restrict_to(app.add_option("--views", o.settings.views,
                             "Places of lens and time that lightfield and multidim see each pixel from"),
              ranges::views)
      ->capture_default_str();
  app.parse_complete_callback([&app, &o] { check_given_options(app, method_settings(o.method).method); });
}

bool filters_images(Method method) { return method == Method::gaussian || method == Method::bilateral; }

}  // namespace rpf::cli
