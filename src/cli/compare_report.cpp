#include "cli/compare_report.h"

#include <fmt/format.h>

#include "bench/run_json.h"
#include "report/heat_map.h"

namespace rpf::cli {
namespace {

using Json = nlohmann::ordered_json;

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
  json.update(bench::json_of(image.error));
  return json;
}

}  // namespace

std::string table_of(const Comparison& comparison) {
  std::string text = fmt::format("{:>12} {:>12} {:>9} {:>12} {:>12} {:>8} {:>8} {:>8} {:>8}  {}\n", "relMSE", "MSE",
                                 "energy", "trimmed", "MAE", "PSNR", "SSIM", "FLIP", "HDR_FLIP", "image");
  for (const ComparedImage& image : comparison.images) text += error_row(image);
  text += fmt::format("\n{:>28} {:>28} {:>28}  {}\n", "largest difference of R", "of G", "of B", "image");
  for (const ComparedImage& image : comparison.images) text += difference_row(image);
  if (!comparison.diff.empty())
    text += fmt::format(
        "\n{}: relative squared error, logarithmic from {} (dark) to {} (bright), a tick each factor of 10\n",
        comparison.diff, report::darkest_error, report::brightest_error);
  return text;
}

std::string json_of(const Comparison& comparison) {
  Json json{{"reference", comparison.reference}, {"images", Json::array()}};
  for (const ComparedImage& image : comparison.images) json["images"].push_back(json_of_image(image));
  if (!comparison.diff.empty())
    json["diff"] = {
        {"file", comparison.diff}, {"darkest", report::darkest_error}, {"brightest", report::brightest_error}};
  // A file name need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rpf::cli
