#include "cli/explain_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/heat_map.h"
#include "report/palette.h"
#include "report/picture.h"
#include "rpf/srgb.h"

namespace rpf::cli {
namespace {

/// Told apart by nearly everybody (Okabe and Ito). The groups that most files have keep their color in every picture.
constexpr std::uint32_t lens_color = report::orange, time_color = report::sky_blue, light_color = report::bluish_green,
                        bsdf_color = report::reddish_purple;
constexpr std::array<std::uint32_t, 3> other_colors = {report::yellow, report::vermillion, report::blue};
constexpr std::uint32_t nothing_color = 0x303030;

/// Pictures end at this part of the values: a few large ones would make all others dark.
constexpr double shown_part = 0.995;

using Color = std::array<float, 3>;

Image black(const Window& size) { return report::plain_picture(size.width, size.height, 0); }

/// Three channels as red, green and blue.
Image color_picture(const Image& layers, const std::string& first) { return part_of(layers, first, {"R", "G", "B"}); }

/// Three channels as red, green and blue: `least` has the byte 0, `most` 255.
Image false_colors(const Image& layers, const std::string& first, const std::array<Scale, 3>& scales) {
  Image picture = color_picture(layers, first);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Scale& scale = scales.at(i % 3);
    const double part = scale.most > scale.least ? (picture.pixels[i] - scale.least) / (scale.most - scale.least) : 0.5;
    picture.pixels[i] = static_cast<float>(srgb_decode(std::clamp(part, 0.0, 1.0)));
  }
  return picture;
}

std::uint32_t group_color(const std::vector<std::string>& groups, std::size_t group) {
  const std::string& name = groups[group];
  if (name == "lens") return lens_color;
  if (name == "time") return time_color;
  if (name == "light") return light_color;
  return name == "bsdf" ? bsdf_color : other_colors.at(group % other_colors.size());
}

/// Makes the maps of a chapter and hands them out.
class MapMaker {
 public:
  MapMaker(const Explanation& explanation, const std::function<void(const ExplainMap&)>& use)
      : explanation_(explanation), layers_(explanation.layers), use_(use) {}

  void chapter(const std::string& title) { chapter_ = title; }
  void add(ExplainMap map, const std::string& name, const std::string& reading) {
    map.name = name;
    map.chapter = chapter_;
    map.reading = reading;
    use_(map);
  }
  void add(const std::string& layer, const Scale& scale, const std::string& reading) {
    std::string file = layer;
    std::replace(file.begin(), file.end(), '.', '-');
    add(scalar_map(layers_, channel_of(layers_, layer), scale), file, reading);
  }
  void add_picture(const std::string& name, Image picture, const std::string& reading) {
    add({"", "", "", std::move(picture), {}}, name, reading);
  }
  /// From 0 to what nearly all pixels are below.
  Scale up_from_zero(const std::string& layer) const { return {0, std::max(shown_most(layer), 1e-30)}; }
  double shown_most(const std::string& layer) const {
    const std::vector<float> values = sorted_values(layers_, channel_of(layers_, layer));
    return values[static_cast<std::size_t>(shown_part * static_cast<double>(values.size() - 1))];
  }
  std::array<Scale, 3> whole_range(const std::string& layer) const {
    std::array<Scale, 3> scales;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::vector<float> values = sorted_values(layers_, channel_of(layers_, layer) + c);
      scales.at(c) = {values.front(), values.back()};
    }
    return scales;
  }

  void add_frame() {
    chapter("The frame");
    add_picture("mean", color_picture(layers_, "R"), "The plain mean of the samples: what the pass starts from.");
    add_picture("filtered", color_picture(layers_, "filtered.R"), "After the pass that is explained here.");
    constexpr Scale direction = {-1, 1};
    add_picture("normals", false_colors(layers_, "normal.X", {direction, direction, direction}),
                "Normals of the first hit: red, green and blue are x, y and z, from -1 (dark) to 1 (bright).");
    add_picture("positions", false_colors(layers_, "position.X", whole_range("position.X")),
                "World positions of the first hit: red, green and blue are x, y and z, from the least of the frame "
                "(dark) to the largest (bright).");
  }
  void add_noise() {
    chapter("Where the noise comes from");
    add(attribution_map(explanation_), "noise-attribution",
        "Which random parameters make a pixel noisy: the colors are mixed as their shares are.");
    add("share.explained", {0, 1},
        "How much of the noise these parameters cause one by one. Dark where others, such as the position inside the "
        "pixel, or several together cause it.");
    add("noise.mean", up_from_zero("noise.mean"), "Standard error of the plain mean, in units of radiance.");
    add("noise.remaining", up_from_zero("noise.mean"),
        "Standard error after the pass, on the scale of the picture before: noise only, not what the filter blurs.");
    add("noise.relative", {1e-3, 1}, "The same as a part of the pixel's brightness.");
    add("density", up_from_zero("density"),
        "Samples a pixel that the renderer's next pass should spend here; in all as many as the file has.");
  }
  void add_neighborhoods() {
    chapter("Whom the filter asks");
    add("neighborhood.size", up_from_zero("neighborhood.size"),
        "N: samples that are averaged, the pixel's own included.");
    add("neighborhood.acceptance", {0, 1}, "The part of the candidates whose features are like the pixel's.");
    add("neighborhood.effective", {1, std::max(shown_most("neighborhood.size"), 2.0)},
        "How many equally weighted samples would average as much noise away. Few: the weights are sharp.");
  }
  void add_dependencies() {
    chapter("What the filter concludes");
    add("W.mean", {0, 1}, "W_c^r: how much of the color's dependence is on the random parameters, which is noise.");
    constexpr Scale whole = {0, 1};
    add_picture("alpha", false_colors(layers_, "alpha.R", {whole, whole, whole}),
                "alpha of the channels R, G, B as red, green, blue: black where colors are not trusted at all.");
    for (const std::string& channel : layers_.channels)
      if (channel.rfind("beta.", 0) == 0)
        add(channel, up_from_zero(channel), "beta: how much a difference of feature " + channel.substr(5) + " counts.");
  }
  void add_information() {
    chapter("Mutual information of the colors, in nats");
    for (const std::string& channel : layers_.channels)
      if (channel.rfind("information.", 0) == 0)
        add(channel, up_from_zero(channel), "With " + channel.substr(12) + ", summed over channels and components.");
  }

 private:
  const Explanation& explanation_;
  const Image& layers_;
  std::string chapter_;
  const std::function<void(const ExplainMap&)>& use_;
};

}  // namespace

std::size_t channel_of(const Image& layers, const std::string& name) {
  return layers.find(name).value_or(layers.channel_count());
}

Image part_of(const Image& layers, const std::string& first, const std::vector<std::string>& names) {
  Image part;
  part.data_window = layers.data_window;
  part.display_window = layers.display_window;
  part.metadata = layers.metadata;
  part.channels = names;
  const std::size_t channel = channel_of(layers, first);
  part.pixels.reserve(part.data_window.pixel_count() * names.size());
  for (std::size_t p = 0; p < part.data_window.pixel_count(); ++p)
    part.pixels.insert(part.pixels.end(), layers.pixel(p) + channel, layers.pixel(p) + channel + names.size());
  return part;
}

std::vector<float> sorted_values(const Image& layers, std::size_t channel) {
  std::vector<float> values;
  for (std::size_t p = 0; p < layers.data_window.pixel_count(); ++p) values.push_back(layers.pixel(p)[channel]);
  std::sort(values.begin(), values.end());
  return values;
}

ExplainMap attribution_map(const Explanation& explanation) {
  const Image& layers = explanation.layers;
  const std::vector<std::string>& groups = explanation.groups;
  ExplainMap map{"noise-attribution", "", "", black(layers.data_window), {}};
  for (std::size_t g = 0; g < groups.size(); ++g) map.legend.entries.push_back({group_color(groups, g), groups[g]});
  map.legend.entries.push_back({nothing_color, "no noise that these explain"});
  const Color nothing = report::linear_light(nothing_color);
  for (std::size_t p = 0; p < layers.data_window.pixel_count(); ++p) {
    float* color = map.picture.pixel(p);
    float sum = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const float share = layers.pixel(p)[channel_of(layers, "share." + groups[g])];
      const Color mixed = report::linear_light(group_color(groups, g));
      for (std::size_t c = 0; c < 3; ++c) color[c] += share * mixed[c];
      sum += share;
    }
    if (sum == 0) std::copy(nothing.begin(), nothing.end(), color);
  }
  return map;
}

ExplainMap scalar_map(const Image& values, std::size_t channel, const Scale& scale) {
  ExplainMap map{"", "", "", black(values.data_window),
                 report::magma_legend(fmt::format("{:.3g}", scale.least), fmt::format("{:.3g}", scale.most))};
  for (std::size_t p = 0; p < values.data_window.pixel_count(); ++p) {
    const double value = values.pixel(p)[channel];
    const double position =
        scale.least > 0 ? std::log(std::max(value, scale.least) / scale.least) / std::log(scale.most / scale.least)
                        : value / scale.most;
    const Color color = report::color_at(position);
    std::copy(color.begin(), color.end(), map.picture.pixel(p));
  }
  if (scale.least > 0) map.legend.entries.back().text += ", logarithmic";
  return map;
}

void for_each_map(const Explanation& explanation, const std::function<void(const ExplainMap&)>& use) {
  MapMaker maps(explanation, use);
  maps.add_noise();
  maps.add_frame();
  maps.add_neighborhoods();
  maps.add_dependencies();
  maps.add_information();
}

std::vector<std::string> map_names(const std::vector<std::string>& channels) {
  Explanation smallest;
  smallest.layers.data_window = smallest.layers.display_window = {0, 0, 1, 1};
  smallest.layers.channels = channels;
  smallest.layers.pixels.resize(channels.size());
  std::vector<std::string> names;
  for_each_map(smallest, [&](const ExplainMap& map) { names.push_back(map.name); });
  return names;
}

}  // namespace rpf::cli
