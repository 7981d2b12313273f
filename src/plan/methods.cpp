#include "rpf/methods.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rpf/error.h"

namespace rpf {
namespace {

struct NamedMethod {
  const char* name;
  Method method;
};

/// In the order of Method.
constexpr NamedMethod all_methods[] = {{"rpf", Method::rpf},
                                       {"gaussian", Method::gaussian},
                                       {"bilateral", Method::bilateral},
                                       {"cross-bilateral", Method::cross_bilateral},
                                       {"learned", Method::learned},
                                       {"nlm", Method::nlm},
                                       {"gem", Method::gem},
                                       {"sbf", Method::sbf},
                                       {"axis-aligned", Method::axis_aligned},
                                       {"lightfield", Method::lightfield}};

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

std::string name_of(Method method) { return all_methods[static_cast<std::size_t>(method)].name; }

bool filters_pixels(Method method) {
  return method == Method::nlm || method == Method::gem || method == Method::sbf || method == Method::axis_aligned;
}

bool needs_whole_frame(Method method) { return filters_pixels(method) || method == Method::lightfield; }

Settings method_settings(const std::string& name) {
  for (const NamedMethod& m : all_methods)
    if (name == m.name) return settings_of(m.method);
  throw Error(ErrorKind::usage,
              fmt::format("method '{}': one of {} is expected", name, fmt::join(method_names(), ", ")));
}

}  // namespace rpf
