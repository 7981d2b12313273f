#include "cli/compare_report.h"

#include <fmt/format.h>

#include "cli/heat_map.h"

namespace rpf::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* channel_names[3] = {"R", "G", "B"};

std::string error_row(const ComparedImage& image) {
  const ImageError& e = image.error;
  return fmt::format("{:>12.6f} {:>12.6g} {:>9.4f} {:>12.6f} {:>12.6g} {:>8.2f} {:>8.4f} {:>8.4f} {:>8.4f}  {}\n",
                     e.relmse, e.mse, e.energy, e.trimmed_relmse, e.mae, e.psnr, e.ssim, e.flip, e.hdr_flip,
                     image.file);
}

std::string difference_row(const ComparedImage& image) {
  std::string row;
  for (const LargestDifference& d : image.error.largest)
    row += fmt::format("{:>28} ", fmt::format("{:.6g} at ({}, {})", d.difference, d.x, d.y));
  return row + " " + image.file + "\n";
}

Json json_of_image(const ComparedImage& image) {
  Json json{{"image", image.file}};
  json.update(json_of(image.error));
  return json;
}

}  // namespace

Json json_of(const ImageError& e) {
  Json json{{"relMSE", e.relmse},    {"MSE", e.mse},   {"energy", e.energy}, {"trimmed_relMSE", e.trimmed_relmse},
            {"MAE", e.mae},          {"PSNR", e.psnr}, {"SSIM", e.ssim},     {"FLIP", e.flip},
            {"HDR_FLIP", e.hdr_flip}};
  for (std::size_t c = 0; c < 3; ++c) {
    const LargestDifference& d = e.largest[c];
    json["largest_difference"][channel_names[c]] = {{"difference", d.difference}, {"x", d.x}, {"y", d.y}};
  }
  return json;
}

std::string table_of(const Comparison& comparison) {
  std::string text = fmt::format("{:>12} {:>12} {:>9} {:>12} {:>12} {:>8} {:>8} {:>8} {:>8}  {}\n", "relMSE", "MSE",
                                 "energy", "trimmed", "MAE", "PSNR", "SSIM", "FLIP", "HDR_FLIP", "image");
  for (const ComparedImage& image : comparison.images) text += error_row(image);
  text += fmt::format("\n{:>28} {:>28} {:>28}  {}\n", "largest difference of R", "of G", "of B", "image");
  for (const ComparedImage& image : comparison.images) text += difference_row(image);
  if (!comparison.diff.empty())
    text += fmt::format(
        "\n{}: relative squared error, logarithmic from {} (dark) to {} (bright), a tick each factor of 10\n",
        comparison.diff, darkest_error, brightest_error);
  return text;
}

std::string json_of(const Comparison& comparison) {
  Json json{{"reference", comparison.reference}, {"images", Json::array()}};
  for (const ComparedImage& image : comparison.images) json["images"].push_back(json_of_image(image));
  if (!comparison.diff.empty())
    json["diff"] = {{"file", comparison.diff}, {"darkest", darkest_error}, {"brightest", brightest_error}};
  // A file name need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rpf::cli
