// rpf_trace CASE.json TRACE.json: filters a small frame and writes every intermediate value of every pixel and pass,
// for the oracle (compare.py) to check; by the backend RPF_TEST_BACKEND, or the reference. Colors are written in the
// case's own units, positions and features unshifted.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>  // test data between C++ and Python

#include "rpf/rpf.h"
#include "rpf_math.h"
#include "run/driver.h"

namespace {

using nlohmann::json;
using rpf::PixelTrace;
using rpf::Plan;

float number(const json& value) { return value.is_null() ? NAN : value.get<float>(); }

json number(float value) { return std::isfinite(value) ? json(value) : json(nullptr); }

template <typename T>
std::optional<T> optional(const json& settings, const char* key) {
  return settings.at(key).is_null() ? std::nullopt : std::optional<T>(settings.at(key).get<T>());
}

rpf::Settings read_settings(const json& s) {
  rpf::Settings settings;
  if (const char* backend = std::getenv("RPF_TEST_BACKEND")) settings.backend = backend;
  settings.method = rpf::method_settings(s.at("method")).method;
  settings.sigma_color = s.at("sigma_color");
  settings.sigma_feature = s.at("sigma_feature");
  settings.damping = s.at("damping");
  settings.window = s.at("window");
  settings.gamma = s.at("gamma");
  settings.views = s.at("views");
  settings.bandwidth = s.at("bandwidth");
  settings.profile = s.at("profile") == "paper" ? rpf::Profile::paper : rpf::Profile::thesis;
  settings.box_widths = s.at("boxes").get<std::vector<int>>();
  settings.noise = s.at("noise");
  settings.bins = s.at("bins");
  settings.seed = s.at("seed");
  settings.random = optional<std::vector<std::string>>(s, "random");
  settings.features = optional<std::vector<std::string>>(s, "features");
  settings.samples_factor = optional<double>(s, "samples_factor");
  settings.max_samples = optional<std::uint32_t>(s, "max_samples").value_or(0);
  settings.position_scale = s.at("position_scale");
  settings.reject_second_hit = s.at("reject_second_hit");
  settings.bias_correction = s.at("bias_correction");
  settings.alpha_factor = s.at("alpha_factor");
  settings.redraws = s.at("redraws");
  return settings;
}

rpf::SampleBuffer read_samples(const json& c) {
  rpf::SampleBuffer samples;
  samples.data_window = samples.display_window = {0, 0, c.at("width"), c.at("height")};
  samples.first_sample = {0};
  for (const std::uint32_t count : c.at("counts").get<std::vector<std::uint32_t>>())
    samples.first_sample.push_back(samples.first_sample.back() + count);
  for (const auto& attribute : c.at("metadata").items()) {
    if (attribute.value().is_array())
      samples.metadata[attribute.key()] = attribute.value().get<std::vector<float>>();
    else
      samples.metadata[attribute.key()] = attribute.value().get<float>();
  }
  for (const auto& channel : c.at("channels").items()) samples.layout.slots.push_back(channel.key());
  for (std::size_t i = 0; i < samples.sample_count(); ++i)
    for (const std::string& slot : samples.layout.slots)
      samples.values.push_back(number(c.at("channels").at(slot).at(i)));
  return samples;
}

/// Undoes the driver's radiance scale for the first three values of each group of `stride`.
json unscaled(const std::vector<float>& values, std::size_t stride, float scale) {
  json groups = json::array();
  for (std::size_t i = 0; i < values.size(); i += stride) {
    json group = json::array();
    for (std::size_t v = 0; v < 3; ++v) group.push_back(number(values[i + v] / scale));
    groups.push_back(group);
  }
  return groups;
}

/// All attempts of all draws of a pixel, used or not: [dx, dy, word].
json draws_of(const Plan& plan, int pass, std::uint32_t pixel, std::uint32_t own) {
  namespace k = rpf::kernel;
  const rpf::PassPlan& p = plan.passes[static_cast<std::size_t>(pass)];
  const k::rpf_words key = k::rpf_draw_key(plan.seed, static_cast<k::uint>(pass), pixel);
  json draws = json::array();
  for (std::uint32_t draw = 0; draw < p.neighborhood.draws(own); ++draw) {
    json attempts = json::array();
    for (std::uint32_t attempt = 0; attempt < plan.attempts; ++attempt) {
      const k::rpf_words words = k::rpf_draw_words(key, draw, attempt);
      attempts.push_back({p.offsets[words.x & 0xFFFFU], p.offsets[words.x >> 16], words.y});
    }
    draws.push_back(attempts);
  }
  return draws;
}

std::vector<std::string> variable_names(const rpf::Variables& variables) {
  std::vector<std::string> names = {"R", "G", "B", "film.X", "film.Y"};
  for (const std::string& name : variables.random_names) names.push_back("random." + name);
  for (const std::string& name : variables.feature_names) names.push_back("feature." + name);
  return names;
}

/// The pairs of PixelTrace::mutual_information as "x|y".
std::vector<std::string> pair_names(const rpf::Variables& variables) {
  const std::vector<std::string> names = variable_names(variables);
  std::vector<std::string> pairs;
  for (std::size_t x = 0; x < 3; ++x)
    for (std::size_t y = 3; y < names.size(); ++y) pairs.push_back(names[x] + "|" + names[y]);
  for (std::size_t x = variables.features(); x < names.size(); ++x)
    for (std::size_t y = 3; y < variables.features(); ++y) pairs.push_back(names[x] + "|" + names[y]);
  return pairs;
}

void write_neighborhood(json& out, const Plan& plan, const PixelTrace& t) {
  const std::size_t first_feature = plan.variables.features();
  out["neighbors"] = t.neighbors;
  out["own_std"] = t.own_deviation;
  for (std::size_t k = 0; k < t.own_mean.size(); ++k) {
    out["own_mean"].push_back(t.own_mean[k] + t.shift[first_feature + k]);
    out["tolerance"].push_back(number(t.tolerance[k]));
  }
}

void write_statistics(json& out, const Plan& plan, const PixelTrace& t, float scale) {
  const std::size_t variables = plan.variables.count();
  for (std::size_t v = 0; v < variables; ++v) {
    const float unit = v < 3 ? scale : 1;
    out["mean"].push_back((static_cast<double>(t.mean[v]) + t.shift[v]) / unit);
    out["std"].push_back(t.inverse_deviation[v] > 0 ? 1.0 / t.inverse_deviation[v] / unit : 0.0);
  }
  for (std::size_t j = 0; j < t.neighbors.size(); ++j) {
    const auto row = static_cast<std::ptrdiff_t>(j * variables),
               next = static_cast<std::ptrdiff_t>((j + 1) * variables);
    out["normalized"].push_back(std::vector<float>(t.normalized.begin() + row, t.normalized.begin() + next));
  }
}

void write_bins(json& out, const Plan& plan, const PixelTrace& t) {
  const auto variables = static_cast<std::ptrdiff_t>(plan.variables.count());
  for (auto row = t.bins.begin(); row != t.bins.end(); row += variables) {
    std::vector<int> bins(row, row + variables);
    for (int& bin : bins) bin -= plan.half_bins;
    out["bins"].push_back(bins);
  }
}

void write_dependencies(json& out, const Plan& plan, const PixelTrace& t) {
  const std::size_t cells =
      static_cast<std::size_t>(2 * plan.half_bins + 1) * static_cast<std::size_t>(2 * plan.half_bins + 1);
  const std::vector<std::string> pairs = pair_names(plan.variables);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto begin = t.histograms.begin() + static_cast<std::ptrdiff_t>(i * cells);
    out["histograms"][pairs[i]] = std::vector<std::uint32_t>(begin, begin + static_cast<std::ptrdiff_t>(cells));
    out["mutual_information"][pairs[i]] = t.mutual_information[i];
  }
  out["W_c_r"] = t.filter_weights.color.color_fraction_random;
  out["W_f_r"] = t.filter_weights.feature_fraction_random;
  out["W_c_f"] = t.filter_weights.fraction_feature;
  out["fraction_random"] = t.filter_weights.color.fraction_random;
  out["alpha"] = t.filter_weights.color.alpha;
  out["beta"] = t.filter_weights.beta;
}

/// Sections 3 to 5 of a pixel with so many samples.
void write_stages(json& out, const Plan& plan, const PixelTrace& t, std::uint32_t own, float scale) {
  out["own_mean"] = out["tolerance"] = json::array();
  out["draws"] = draws_of(plan, t.pass, t.pixel, own);
  write_neighborhood(out, plan, t);
  write_statistics(out, plan, t, scale);
  write_bins(out, plan, t);
  write_dependencies(out, plan, t);
}

/// `start`: c' of the pixel's own samples as the pass starts, [own][carried].
json write_pixel(const Plan& plan, const PixelTrace& t, const std::vector<float>& start, float scale) {
  const auto width = static_cast<std::uint32_t>(plan.width);
  json out = {{"x", t.pixel % width}, {"y", t.pixel / width}};
  out["start"] = unscaled(start, plan.carried, scale);
  if (plan.method == rpf::Method::rpf) {
    write_stages(out, plan, t, static_cast<std::uint32_t>(start.size() / plan.carried), scale);
  } else {
    out["neighbors"] = t.neighbors;
    out["weights"] = t.weights;
  }
  out["filtered"] = unscaled(t.filtered, plan.carried, scale);
  out["color"] = unscaled(t.colors, plan.carried, scale);
  return out;
}

/// The pixel's part of Backend::colors().
std::vector<float> own_colors(const rpf::Backend& backend, const Plan& plan, const rpf::Frame& frame,
                              std::uint32_t pixel) {
  const auto at = [&](std::uint32_t p) {
    return backend.colors().begin() + static_cast<std::ptrdiff_t>(frame.first_sample[p] * plan.carried);
  };
  return {at(pixel), at(pixel + 1)};
}

int run(const char* case_path, const char* trace_path) {
  json c, trace;
  std::ifstream(case_path) >> c;
  const rpf::Settings settings = read_settings(c.at("settings"));
  const rpf::SampleBuffer samples = read_samples(c);
  // The driver scales the radiance by a power of two; the same step tells which.
  const rpf::PreparedFrame prepared = rpf::prepare(samples, settings);
  trace["random"] = prepared.facts.variables.random_names;
  trace["features"] = prepared.facts.variables.feature_names;
  trace["radiance_scale"] = prepared.facts.radiance_scale;
  trace["passes"] = json::array();
  const auto trace_pass = [&](rpf::Backend& backend, const Plan& plan, int pass) {
    const rpf::PassPlan& p = plan.passes[static_cast<std::size_t>(pass)];
    json out = {{"box", p.box_width}, {"units_per_bit", p.entropy.units_per_bit}, {"pixels", json::array()}};
    for (std::uint32_t pixel = 0; pixel + 1 < samples.first_sample.size(); ++pixel) {
      if (prepared.frame.samples(pixel) == 0) continue;
      const std::vector<float> start = own_colors(backend, plan, prepared.frame, pixel);
      out["pixels"].push_back(write_pixel(plan, backend.trace(pass, pixel), start, prepared.facts.radiance_scale));
    }
    trace["passes"].push_back(out);
  };
  const rpf::Result result = rpf::run_filter(samples, settings, {}, trace_pass);
  trace["image"] = unscaled(result.image.pixels, result.image.channel_count(), 1);
  std::ofstream(trace_path) << trace;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: rpf_trace CASE.json TRACE.json\n";
    return 2;
  }
  return run(argv[1], argv[2]);
}
