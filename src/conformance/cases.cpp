#include "conformance/case_list.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace rpf {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

std::string count_name(int samples) { return samples == CaseList::varying ? "varying" : fmt::format("{}spp", samples); }

Change poison(const std::string& slot, float value, std::size_t step) {
  return [=](SampleBuffer& samples) {
    for (std::size_t i = step / 2; i < samples.sample_count(); i += step)
      samples.record(i)[*samples.layout.find(slot)] = value;
  };
}

std::vector<std::pair<std::string, Change>> extremes() {
  return {{"nan-color", poison("G", nan, 7)},
          {"nan-feature", poison("feature.N.X", nan, 3)},
          {"missing-feature", poison("feature.N.X", nan, 1)},
          {"infinite-feature", poison("feature.P.Y", infinity, 5)},
          {"nan-random", poison("random.lens.U", nan, 4)},
          {"firefly", poison("R", 1e9F, 1001)},
          {"negative", poison("B", -3.0F, 11)},
          {"largest", poison("R", std::numeric_limits<float>::max(), 13)},
          {"black", poison("R", 0.0F, 1)},
          {"subnormal", [](SampleBuffer& samples) {
             for (std::size_t i = 0; i < samples.sample_count(); ++i)
               for (const char* slot : {"R", "G", "B"}) samples.record(i)[*samples.layout.find(slot)] *= 1e-42F;
           }}};
}

namespace {

/// Every scene, with the passes of the profiles but for the largest box.
void add_scenes(CaseList& list) {
  for (const SceneInfo& scene : scenes()) {
    ConformanceCase c = CaseList::basic(scene.name);
    c.settings.box_widths = {35, 17, 7};
    c.quick = true;
    list.add("scene/" + scene.name, c);
  }
}

void add_sample_counts(CaseList& list) {
  for (const int samples : {1, 2, 3, 5, 8, 16, CaseList::varying})
    list.add("samples/dof/" + count_name(samples), CaseList::basic("dof", samples));
  for (const int samples : {1, 3, CaseList::varying})
    list.add("samples/combined/" + count_name(samples), CaseList::basic("combined", samples));
}

void add_box_widths(CaseList& list) {
  for (const int samples : {4, CaseList::varying})
    for (const int width : {1, 3, 5, 7, 9, 11, 13, 17, 21, 27, 35, 55}) {
      ConformanceCase c = CaseList::basic("dof", samples);
      c.settings.box_widths = {width};
      list.add(fmt::format("box/{}/{}", width, count_name(samples)), c);
    }
}

void add_sizes(CaseList& list) {
  constexpr int sizes[][2] = {{1, 1}, {1, 17}, {17, 1}, {2, 2}, {17, 5}, {64, 48}, {130, 70}};
  for (const int samples : {4, CaseList::varying})
    for (const auto& size : sizes) {
      ConformanceCase c = CaseList::basic("dof", samples);
      c.options.width = size[0];
      c.options.height = size[1];
      c.settings.box_widths = size[0] > 100 ? std::vector<int>{5} : std::vector<int>{9, 3};
      c.quick = samples == 4 && size[0] < 64;
      list.add(fmt::format("size/{}x{}/{}", size[0], size[1], count_name(samples)), c);
    }
}

void add_channels(CaseList& list) {
  const std::vector<std::vector<std::string>> features = {{},     {"N"},      {"P"},       {"albedo"},
                                                          {"uv"}, {"N", "P"}, {"N2", "P2"}};
  for (const auto& groups : features)
    list.add("features/" + (groups.empty() ? "none" : groups.front() + (groups.size() > 1 ? "," + groups.back() : "")),
             [&](Settings& s) { s.features = groups; });
  const std::vector<std::vector<std::string>> random = {{}, {"lens"}, {"light"}, {"bsdf"}, {"pixel"}, {"all"}};
  for (const auto& groups : random)
    list.add("random/" + (groups.empty() ? "none" : groups.front()), [&](Settings& s) { s.random = groups; });
  list.add("carried/features", [](Settings& s) { s.filter_features = true; });
}

void add_bands(CaseList& list) {
  for (const int samples : {4, CaseList::varying})
    for (const int width : {5, 9})
      for (const int more : {0, 1, 2, 5}) {
        ConformanceCase c = CaseList::basic("dof", samples);
        c.settings.box_widths = {width, 3};
        c.band_rows = width + more;
        list.add(fmt::format("band/{}rows/box{}/{}", c.band_rows, width, count_name(samples)), c);
      }
}

void add_world(CaseList& list) {
  for (const float offset : {1e2F, 1e4F, 1e7F}) {
    ConformanceCase c = CaseList::basic();
    c.options.world_offset = {offset, -offset, offset};
    list.add(fmt::format("world/offset{:g}", offset), c);
  }
  for (const float scale : {1e-6F, 1e-3F, 1e3F, 1e6F}) {
    ConformanceCase c = CaseList::basic();
    c.options.world_scale = scale;
    list.add(fmt::format("world/scale{:g}", scale), c);
  }
}

void add_windows(CaseList& list) {
  constexpr int places[][2] = {{-7, -3}, {100000, 5}};
  for (const auto& place : places) {
    ConformanceCase c = CaseList::basic();
    c.change = [x = place[0], y = place[1]](SampleBuffer& samples) {
      samples.data_window.x = x;
      samples.data_window.y = y;
      for (std::size_t i = 0; i < samples.sample_count(); ++i) {
        samples.record(i)[*samples.layout.find("film.X")] += static_cast<float>(x);
        samples.record(i)[*samples.layout.find("film.Y")] += static_cast<float>(y);
      }
    };
    list.add(fmt::format("window/{},{}", place[0], place[1]), c);
  }
  for (const Window& crop : {Window{0, 0, 1, 1}, Window{24, 17, 1, 1}, Window{3, 5, 11, 7}})
    list.add("crop/" + text_of(crop), [&](Settings& s) { s.crop = crop; });
}

/// What `rpf explain` reads from backends: as whole tiles, and in tiles that the device takes in parts.
void add_explained(CaseList& list) {
  for (const int samples : {1, 4, CaseList::varying}) {
    ConformanceCase c = CaseList::basic("combined", samples);
    c.settings.box_widths = {21};
    c.explain = true;
    c.quick = samples == 4;
    list.add("explain/" + count_name(samples), c);
  }
  ConformanceCase c = CaseList::basic("dof", CaseList::varying);
  c.settings.box_widths = {9};
  c.explain = true;
  c.band_rows = 10;
  list.add("explain/band", c);
}

void add_settings(CaseList& list) {
  for (const float noise : {1e-12F, 0.0003F, 0.002F, 0.2F, 1e6F})
    list.add(fmt::format("noise/{:g}", noise), [&](Settings& s) { s.noise = noise; });
  for (const float factor : {0.0F, 1.0F, 5.2F})
    list.add(fmt::format("alpha-factor/{:g}", factor), [&](Settings& s) { s.alpha_factor = factor; });
  for (const float scale : {1e-3F, 1.0F, 1e3F})
    list.add(fmt::format("position-scale/{:g}", scale), [&](Settings& s) { s.position_scale = scale; });
  for (const int redraws : {0, 1, 15})
    list.add(fmt::format("redraws/{}", redraws), [&](Settings& s) { s.redraws = redraws; });
  for (const std::uint32_t seed : {0U, 7U, 4294967295U})
    list.add(fmt::format("seed/{}", seed), [&](Settings& s) { s.seed = seed; });
  for (const double factor : {0.01, 0.1, 2.0, 4.0})
    list.add(fmt::format("samples-factor/{:g}", factor), [&](Settings& s) { s.samples_factor = factor; });
  // Around the sizes at which the bit planes change their form: 64, 128, 256 and 512 neighbors.
  for (const std::uint32_t most : {1U, 3U, 16U, 17U, 64U, 65U, 128U, 129U, 256U, 257U, 512U, 513U, 1025U})
    list.add(fmt::format("max-samples/{}", most), [&](Settings& s) {
      s.box_widths = {35};
      s.samples_factor = 2;
      s.max_samples = most;
      s.features = std::vector<std::string>{};  // nothing is rejected: N is M
    });
  for (const int bins : {3, 5, 9, 31}) list.add(fmt::format("bins/{}", bins), [&](Settings& s) { s.bins = bins; });
  list.add("reject-second-hit", [](Settings& s) { s.reject_second_hit = true; });
  list.add("bias-correction", [](Settings& s) { s.bias_correction = true; });
}

void add_extremes(CaseList& list) {
  for (const auto& [name, change] : extremes()) {
    ConformanceCase c = CaseList::basic();
    c.change = change;
    list.add("extreme/" + name, c);
  }
}

}  // namespace

std::vector<ConformanceCase> all_conformance_cases() {
  CaseList list;
  add_scenes(list);
  add_sample_counts(list);
  add_box_widths(list);
  add_sizes(list);
  add_channels(list);
  add_bands(list);
  add_world(list);
  add_windows(list);
  add_settings(list);
  add_explained(list);
  add_extremes(list);
  add_methods(list);
  add_estimator(list);
  return std::move(list.cases);
}

}  // namespace rpf
