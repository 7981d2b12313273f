#include "report/error_json.h"

namespace rpf::report {
namespace {

constexpr const char* channel_names[3] = {"R", "G", "B"};

}  // namespace

nlohmann::ordered_json json_of(const ImageError& e) {
  nlohmann::ordered_json json{
      {"relMSE", e.relmse},    {"MSE", e.mse},   {"energy", e.energy}, {"trimmed_relMSE", e.trimmed_relmse},
      {"MAE", e.mae},          {"PSNR", e.psnr}, {"SSIM", e.ssim},     {"FLIP", e.flip},
      {"HDR_FLIP", e.hdr_flip}};
  for (std::size_t c = 0; c < 3; ++c) {
    const LargestDifference& d = e.largest[c];
    json["largest_difference"][channel_names[c]] = {{"difference", d.difference}, {"x", d.x}, {"y", d.y}};
  }
  return json;
}

}  // namespace rpf::report
