// The learned estimator.
#include <fmt/format.h>

#include "conformance/case_list.h"
#include "conformance/random_network.h"
#include "learned/network_file.h"

namespace rpf {
namespace {

/// Small, and with every kind of step: three levels, sizes that are and that are not whole vectors.
std::shared_ptr<const Network> small_network() { return random_network(1, {16, {16, 24, 40}, 5}); }

class EstimatorCases {
 public:
  explicit EstimatorCases(CaseList& all) : all_(all) {}

  static ConformanceCase basic(const std::string& scene = "dof", int samples = 4) {
    ConformanceCase c = CaseList::basic(scene, samples);
    c.settings.method = Method::learned;
    c.settings.box_widths.clear();
    c.network = small_network();
    return c;
  }

  void add(const std::string& name, ConformanceCase c) {
    c.name = "learned/" + name;
    all_.cases.push_back(std::move(c));
  }
  void add(const std::string& name, const std::function<void(ConformanceCase&)>& set) {
    ConformanceCase c = basic();
    set(c);
    add(name, c);
  }

 private:
  CaseList& all_;
};

void add_frames(EstimatorCases& list) {
  for (const char* scene : {"dof", "motion", "combined", "soft-shadow"}) {
    ConformanceCase c = EstimatorCases::basic(scene);
    c.quick = true;
    list.add(fmt::format("scene/{}", scene), c);
  }
  for (const int samples : {1, 2, 3, 8, 33, 150, CaseList::varying})
    list.add("samples/" + count_name(samples), EstimatorCases::basic("dof", samples));
  constexpr int sizes[][2] = {{1, 1}, {1, 17}, {17, 1}, {2, 2}, {3, 400}, {40, 3}, {64, 48}, {130, 70}};
  for (const auto& size : sizes)
    list.add(fmt::format("size/{}x{}", size[0], size[1]), [&](ConformanceCase& c) {
      c.options.width = size[0];
      c.options.height = size[1];
      c.quick = size[0] < 40;
    });
}

/// Every kind of layer text: vectors of 8 and of 16, one group of outputs and several, cells in fours and in eights.
void add_networks(EstimatorCases& list) {
  const struct {
    const char* name;
    NetworkShape shape;
  } networks[] = {{"one-level", {8, {8}, 1}},
                  {"two-levels", {24, {24, 40}, 8}},
                  {"wide", {24, {32, 64, 96, 128}, 10}},
                  {"odd", {5, {7, 12, 9}, 3}},
                  {"four-levels", {24, {24, 40, 64, 80}, 8}},
                  {"deep", {8, {8, 8, 16, 16, 24, 24}, 21}},
                  {"one-pass", {8, {8, 16}, 4, {1}, {1}}},
                  {"more-passes", {8, {8, 16}, 4, {1, 8, 3, 5, 2}, {7, 1, 3}}}};
  for (const auto& [name, shape] : networks)
    list.add(fmt::format("network/{}", name),
             [&shape = shape](ConformanceCase& c) { c.network = random_network(2, shape); });
  for (const EmbeddedNetwork& embedded : embedded_networks())
    list.add(fmt::format("network/{}", embedded.name), [&](ConformanceCase& c) {
      c.network = find_network(embedded.name);
      c.quick = true;
    });
}

void add_channels(EstimatorCases& list) {
  for (const char* group : {"N", "P", "albedo", "N2", "P2"})
    list.add(fmt::format("features/{}", group), [&](ConformanceCase& c) { c.settings.features = {group}; });
  list.add("features/none", [](ConformanceCase& c) { c.settings.features = std::vector<std::string>{}; });
  list.add("random/none", [](ConformanceCase& c) { c.settings.random = std::vector<std::string>{}; });
  list.add("color-alone", [](ConformanceCase& c) {
    c.settings.features = std::vector<std::string>{};
    c.settings.random = std::vector<std::string>{};
    c.quick = true;
  });
  list.add("carried/features", [](ConformanceCase& c) { c.settings.filter_features = true; });
}

void add_windows(EstimatorCases& list) {
  list.add("crop", [](ConformanceCase& c) {
    c.options.width = 90;
    c.options.height = 70;
    c.settings.crop = Window{30, 25, 11, 7};
  });
  list.add("crop/wide", [](ConformanceCase& c) {  // its window is narrower than the frame
    c.options.width = 700;
    c.options.height = 3;
    c.settings.crop = Window{350, 1, 3, 1};
  });
  list.add("crop/corner", [](ConformanceCase& c) { c.settings.crop = Window{20, 12, 5, 6}; });
  for (const auto& [name, change] : extremes()) {
    ConformanceCase c = EstimatorCases::basic();
    c.change = change;
    list.add("extreme/" + name, c);
  }
}

}  // namespace

void add_estimator(CaseList& all) {
  EstimatorCases list(all);
  add_frames(list);
  add_networks(list);
  add_channels(list);
  add_windows(list);
}

}  // namespace rpf
