#include "report/viewer.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "io/deflate.h"
#include "report/heat_map.h"
#include "report/html_text.h"
#include "report/page_files.h"

namespace rpf::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view legends_place = "<!-- legends -->\n";  ///< in viewer.html
constexpr unsigned float_bits = 23;                               ///< of a mantissa

/// How exactly a layer is kept: bits of the mantissa, and decimal digits that these are good for.
struct Precision {
  unsigned bits;
  int digits;
};

Precision precision_of(const ViewerLayer& layer) {
  if (layer.kind != LayerKind::light) return {8, 3};
  return layer.image.data_window.pixel_count() <= exact_pixels ? Precision{float_bits, 6} : Precision{12, 4};
}

/// The nearest float with so many bits of mantissa; what is not finite stays as it is.
std::uint32_t rounded(float value, unsigned bits) {
  std::uint32_t word = 0;
  std::memcpy(&word, &value, sizeof word);
  if (bits == float_bits || !std::isfinite(value)) return word;
  const std::uint32_t half = 1U << (float_bits - bits - 1);
  return (word + half) & ~(2 * half - 1);
}

/// Channel by channel the highest byte of every pixel, then the next ones: like stands beside like, which deflates
/// well.
std::string planes_of(const Image& image, unsigned bits) {
  const std::size_t pixels = image.data_window.pixel_count();
  std::string bytes(pixels * image.channel_count() * sizeof(float), '\0');
  for (std::size_t c = 0; c < image.channel_count(); ++c)
    for (std::size_t p = 0; p < pixels; ++p) {
      const std::uint32_t word = rounded(image.pixel(p)[c], bits);
      for (unsigned b = 0; b < sizeof word; ++b)
        bytes[(c * sizeof word + b) * pixels + p] = static_cast<char>(word >> (24 - 8 * b) & 0xffU);
    }
  return bytes;
}

const char* name_of(LayerKind kind) {
  if (kind == LayerKind::light) return "light";
  return kind == LayerKind::error ? "error" : "color";
}

Json description_of(const ViewerLayer& layer) {
  return {{"name", layer.name},
          {"kind", name_of(layer.kind)},
          {"channels", layer.image.channels},
          {"digits", precision_of(layer).digits}};
}

/// JSON inside of HTML: no text in it can end the element.
std::string text_of(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

Json frame_of(const Viewer& viewer) {
  const Window& window = viewer.layers.front().image.data_window;
  Json frame{
      {"x", window.x},       {"y", window.y},          {"width", window.width},    {"height", window.height},
      {"left", viewer.left}, {"right", viewer.right},  {"darkest", darkest_error}, {"brightest", brightest_error},
      {"magma", magma},      {"layers", Json::array()}};
  for (const ViewerLayer& layer : viewer.layers) frame["layers"].push_back(description_of(layer));
  return frame;
}

/// Hidden until their layers are shown.
std::string legends_of(const Viewer& viewer) {
  std::string html;
  for (std::size_t i = 0; i < viewer.layers.size(); ++i)
    html += fmt::format("<div class=\"layer-legend\" id=\"viewer-legend-{}\" hidden><b>{}</b>{}</div>\n", i,
                        escaped(viewer.layers[i].name), legend_html(viewer.layers[i].legend));
  return html;
}

}  // namespace

bool is_exact(const Viewer& viewer) { return viewer.layers.front().image.data_window.pixel_count() <= exact_pixels; }

std::string viewer_html(const Viewer& viewer) {
  std::string html = page_files().at("viewer.html");
  html.replace(html.find(legends_place), legends_place.size(), legends_of(viewer));
  html += R"(<script type="application/json" id="viewer-frame">)" + text_of(frame_of(viewer)) + "</script>\n";
  for (std::size_t i = 0; i < viewer.layers.size(); ++i) {
    const ViewerLayer& layer = viewer.layers[i];
    html += fmt::format("<script type=\"text/plain\" id=\"viewer-layer-{}\">{}</script>\n", i,
                        base64(io::deflated(planes_of(layer.image, precision_of(layer).bits))));
  }
  return html;
}

}  // namespace rpf::report
