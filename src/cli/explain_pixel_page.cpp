// The page about one pixel.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <system_error>

#include "cli/explain_maps.h"
#include "cli/explain_pages.h"
#include "cli/explain_shares.h"
#include "report/html_page.h"
#include "report/palette.h"
#include "report/picture.h"
#include "rpf/io.h"

namespace rpf::cli {
namespace {

namespace fs = std::filesystem;

constexpr int least_picture = 300;  ///< CSS pixels
constexpr int histogram_cell = 4;   ///< pixels of a cell before side_by_side() enlarges it four times
constexpr int dotted_pixel = 17;    ///< pixels of one that carries a dot; odd

/// The part of the frame that the pass draws from, counted from the frame's first pixel.
Window box_around(const Explanation& explanation) {
  const Window& frame = explanation.layers.data_window;
  const PixelPosition& at = explanation.pixel->position;
  const int reach = (explanation.report.passes.front().box_width - 1) / 2;
  const int left = std::max(at.x - frame.x - reach, 0), top = std::max(at.y - frame.y - reach, 0);
  return {left, top, std::min(at.x - frame.x + reach + 1, frame.width) - left,
          std::min(at.y - frame.y + reach + 1, frame.height) - top};
}

/// What `value` gives for every neighbor, summed over the pixels of the box.
template <class Value>
Image box_map(const Explanation& explanation, const Value& value) {
  const Window box = box_around(explanation), &frame = explanation.layers.data_window;
  Image map;
  map.data_window = map.display_window = {0, 0, box.width, box.height};
  map.channels = {"Y"};
  map.pixels.resize(box.pixel_count());
  for (const ExplainedNeighbor& n : explanation.pixel->neighbors) {
    const int x = n.pixel.x - frame.x - box.x, y = n.pixel.y - frame.y - box.y;
    map.pixels[static_cast<std::size_t>(y) * box.width + x] += static_cast<float>(value(n));
  }
  return map;
}

float largest(const Image& map) { return *std::max_element(map.pixels.begin(), map.pixels.end()); }

/// Pixels of the box as large squares.
Image enlarged(const Image& picture, int factor) {
  Image result = picture;
  const Window& size = picture.data_window;
  result.data_window = result.display_window = {0, 0, size.width * factor, size.height * factor};
  result.pixels.resize(result.data_window.pixel_count() * picture.channel_count());
  for (int y = 0; y < result.data_window.height; ++y)
    for (int x = 0; x < result.data_window.width; ++x)
      std::copy_n(picture.pixel(static_cast<std::size_t>(y / factor) * size.width + x / factor),
                  picture.channel_count(), result.pixel(static_cast<std::size_t>(y) * result.data_window.width + x));
  return result;
}

/// The box of the frame with a square in the middle of each pixel, as large as `map` is there.
Image with_dots(const Image& frame, const Window& box, const Image& map) {
  Image part;
  part.data_window = part.display_window = {0, 0, box.width, box.height};
  part.channels = frame.channels;
  for (int y = box.y; y < box.y + box.height; ++y) {
    const float* row = frame.pixel(static_cast<std::size_t>(y) * frame.data_window.width + box.x);
    part.pixels.insert(part.pixels.end(), row, row + std::size_t{3} * box.width);
  }
  Image result = enlarged(part, dotted_pixel);
  const float most = largest(map);
  for (int y = 0; y < result.data_window.height; ++y)
    for (int x = 0; x < result.data_window.width; ++x) {
      const float value = map.pixels[static_cast<std::size_t>(y / dotted_pixel) * box.width + x / dotted_pixel];
      const double side = (dotted_pixel - 1) * std::sqrt(value / std::max(most, 1e-30F));
      const double off =
          std::max(std::abs(x % dotted_pixel - dotted_pixel / 2), std::abs(y % dotted_pixel - dotted_pixel / 2));
      if (value > 0 && off <= side / 2)
        std::copy(report::mark_color.begin(), report::mark_color.end(),
                  result.pixel(static_cast<std::size_t>(y) * result.data_window.width + x));
    }
  return result;
}

class PixelPage {
 public:
  PixelPage(const std::string& folder, const std::string& input, const Explanation& explanation,
            const ExplainedEstimate& estimate)
      : explanation_(explanation),
        estimate_(estimate),
        pixel_(*explanation.pixel),
        name_(pixel_page_name(pixel_.position)),
        folder_(folder),
        page_(fmt::format("Pixel {},{} of {}", pixel_.position.x, pixel_.position.y,
                          fs::path(input).filename().string())) {
    std::error_code error;  // writing into it says what is wrong
    fs::create_directories(fs::path(folder) / name_, error);
  }

  std::string write() {
    page_.link("index.html", "All maps");
    add_estimate((fs::path(folder_) / name_).string(), part_of(explanation_.layers, "R", {"R", "G", "B"}), estimate_,
                 page_);
    page_.heading("What the published filter measures here");
    page_.table(summary());
    add_neighborhood();
    add_weights();
    add_conclusions();
    add_histograms();
    std::string path = (fs::path(folder_) / (name_ + ".html")).string();
    page_.write(path);
    return path;
  }

 private:
  std::string write_picture(const std::string& name, const Image& picture) const {
    std::string file = (fs::path(folder_) / name_ / (name + ".png")).string();
    write_image(file, picture);
    return file;
  }

  report::Table summary() const {
    std::uint32_t accepted = 0;
    for (const ExplainedNeighbor& n : pixel_.neighbors) accepted += n.drawn;
    return {{"what", "value"},
            {{"own samples", fmt::format("{}", pixel_.samples)},
             {"candidates drawn", fmt::format("{}", pixel_.drawn)},
             {"neighbors N, own samples included", fmt::format("{}", accepted)},
             {"different samples among them", fmt::format("{}", pixel_.neighbors.size())},
             {"effective samples", number(pixel_.effective_samples)},
             {"W_c^r", number(pixel_.fraction_random)},
             {"plain mean R, G, B", color_text(pixel_.mean)},
             {"filtered R, G, B", color_text(pixel_.filtered)}},
            1};
  }

  void add_neighborhood() {
    page_.heading("Its neighborhood");
    const Image frame = part_of(explanation_.layers, "R", {"R", "G", "B"});
    const Window box = box_around(explanation_);
    const auto drawn = [](const ExplainedNeighbor& n) { return n.drawn; };
    page_.pictures(
        {{write_picture("box", report::side_by_side({frame}, box)),
          "Where the box lies in the frame, and the plain mean inside it, enlarged."},
         {write_picture("over", report::side_by_side({with_dots(frame, box, box_map(explanation_, drawn))})),
          "The neighbors over the plain mean: the larger the dot, the more samples of the pixel. Pixels of the "
          "box without a dot were rejected, or not drawn."},
         box_picture("neighbors", drawn,
                     "Samples of each pixel of the box that are neighbors: drawn, and not rejected."),
         box_picture(
             "share", [](const ExplainedNeighbor& n) { return n.share; },
             "The share of each pixel of the box in the filtered value.")},
        least_picture);
  }

  template <class Value>
  report::Picture box_picture(const std::string& name, const Value& value, const std::string& caption) const {
    const Image map = box_map(explanation_, value);
    const ExplainMap colored = scalar_map(map, 0, {0, std::max<double>(largest(map), 1e-30)});
    const int factor = std::max(100 / map.data_window.width, 1);
    return {write_picture(name, report::side_by_side({enlarged(colored.picture, factor)})), caption, colored.legend};
  }

  void add_weights() {
    page_.heading("Weights");
    std::vector<float> shares;
    for (const ExplainedNeighbor& n : pixel_.neighbors) shares.push_back(n.share);
    page_.plot(share_plot(shares, "the filtered value"), "How many samples make the filtered value.");
    report::Table table{{"largest shares: pixel", "R, G, B of the sample", "times drawn", "share"}, {}, 1};
    for (std::size_t i = 0; i < std::min(listed_shares, pixel_.neighbors.size()); ++i) {
      const ExplainedNeighbor& n = pixel_.neighbors[i];
      table.rows.push_back({fmt::format("{},{}", n.pixel.x, n.pixel.y), color_text(n.color), fmt::format("{}", n.drawn),
                            number(n.share)});
    }
    page_.table(table);
  }

  void add_conclusions() {
    page_.heading("What follows from the mutual information");
    report::Table colors{{"color", "D^r, nats", "D^p", "D^f", "W^r", "alpha"}, {}, 1};
    for (const ExplainedColor& c : pixel_.colors)
      colors.rows.push_back({c.name, number(c.on_random), number(c.on_position), number(c.on_features),
                             number(c.fraction_random), number(c.alpha)});
    page_.table(colors);
    report::Table features{{"feature", "D_f^r, nats", "D_f^p", "W_f^r", "D_c^f", "W_c^f", "beta"}, {}, 1};
    for (const ExplainedFeature& f : pixel_.features)
      features.rows.push_back({f.name, number(f.on_random), number(f.on_position), number(f.fraction_random),
                               number(f.color_on_feature), number(f.fraction_feature), number(f.beta)});
    page_.table(features);
  }

  /// Three squares, R, G and B; bins of the color downwards, of the other variable to the right.
  Image histogram_picture(const std::vector<const ExplainedPair*>& pairs) const {
    std::vector<Image> squares;
    const int bins = static_cast<int>(pixel_.bins);
    for (const ExplainedPair* pair : pairs) {
      Image square;
      square.data_window = square.display_window = {0, 0, bins, bins};
      square.channels = {"Y"};
      square.pixels.assign(pair->histogram.begin(), pair->histogram.end());
      squares.push_back(enlarged(scalar_map(square, 0, {0, std::max(largest(square), 1.0F)}).picture, histogram_cell));
    }
    return report::side_by_side(squares);
  }

  void add_histograms() {
    page_.heading("Joint histograms");
    page_.paragraph(
        "Left to right: R, G and B; rows are bins of the color, columns of the other variable, bright where most "
        "samples "
        "are. Rows that look alike: the two have nothing in common.");
    std::vector<std::string> names;
    std::map<std::string, std::vector<const ExplainedPair*>> by_variable;
    for (const ExplainedPair& pair : pixel_.pairs) {
      if (pair.first != "R" && pair.first != "G" && pair.first != "B") continue;
      if (by_variable[pair.second].empty()) names.push_back(pair.second);
      by_variable[pair.second].push_back(&pair);
    }
    std::vector<report::Picture> pictures;
    for (const std::string& name : names) {
      std::string caption = name + ":";
      for (const ExplainedPair* pair : by_variable[name])
        caption += fmt::format(" {} {:.3f}", pair->first, pair->information);
      pictures.push_back({write_picture("histogram-" + name, histogram_picture(by_variable[name])), caption + " nats"});
    }
    page_.pictures(pictures, 220);
  }

  const Explanation& explanation_;
  const ExplainedEstimate& estimate_;
  const ExplainedPixel& pixel_;
  std::string name_, folder_;
  report::HtmlPage page_;
};

}  // namespace

std::string pixel_page_name(const PixelPosition& pixel) { return fmt::format("pixel-{}-{}", pixel.x, pixel.y); }

std::string write_pixel_page(const std::string& folder, const std::string& input, const Explanation& explanation,
                             const ExplainedEstimate& estimate) {
  return PixelPage(folder, input, explanation, estimate).write();
}

}  // namespace rpf::cli
