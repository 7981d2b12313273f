#include "rpf/methods.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rpf/error.h"

namespace rpf {
namespace {

/// What a method needs, as a sum.
enum Needs : unsigned {
  statistics_of_pixels = 1,
  whole_frame = 2,
  spread_of_features = 4,
  channels_that_do_not_vary = 8,
};

struct NamedMethod {
  const char* name;
  Method method;
  unsigned needs;
};

/// In the order of Method.
constexpr NamedMethod all_methods[] = {
    {"rpf", Method::rpf, 0},
    {"gaussian", Method::gaussian, 0},
    {"bilateral", Method::bilateral, 0},
    {"cross-bilateral", Method::cross_bilateral, spread_of_features},
    {"learned", Method::learned, 0},
    {"nlm", Method::nlm, statistics_of_pixels | whole_frame},
    {"gem", Method::gem, statistics_of_pixels | whole_frame},
    {"sbf", Method::sbf, statistics_of_pixels | whole_frame | spread_of_features},
    {"axis-aligned", Method::axis_aligned, statistics_of_pixels | whole_frame | spread_of_features},
    // Where surfaces are, not only how they differ.
    {"lightfield", Method::lightfield, whole_frame | spread_of_features | channels_that_do_not_vary},
    {"multidim", Method::multidim, whole_frame}};

const NamedMethod& entry_of(Method method) { return all_methods[static_cast<std::size_t>(method)]; }

bool needs(Method method, unsigned what) { return (entry_of(method).needs & what) != 0; }

Settings settings_of(Method method) {
  Settings s;
  s.method = method;
  if (method == Method::rpf || method == Method::learned) return s;
  if (method == Method::sbf) s.features = std::vector<std::string>{"first"};
  if (needs_whole_frame(method)) return s;
  s.box_widths = {method == Method::cross_bilateral ? 9 : 5};
  s.features = std::vector<std::string>{"first"};
  return s;
}

}  // namespace

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const NamedMethod& m : all_methods) names.emplace_back(m.name);
  return names;
}

std::string name_of(Method method) { return entry_of(method).name; }

bool filters_pixels(Method method) { return needs(method, statistics_of_pixels); }

bool needs_whole_frame(Method method) { return needs(method, whole_frame); }

bool needs_feature_spread(Method method) { return needs(method, spread_of_features); }

bool keeps_constant_channels(Method method) { return needs(method, channels_that_do_not_vary); }

Settings method_settings(const std::string& name) {
  for (const NamedMethod& m : all_methods)
    if (name == m.name) return settings_of(m.method);
  throw Error(ErrorKind::usage,
              fmt::format("method '{}': one of {} is expected", name, fmt::join(method_names(), ", ")));
}

}  // namespace rpf
