#include "bench/run_json.h"

namespace rpf::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* channel_names[3] = {"R", "G", "B"};

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

double kept_energy(const Report& report) { return report.passes.empty() ? 1 : report.passes.back().energy; }

Json json_of(const FrameRun& run) {
  Json json{{"cpu", run.cost.cpu},
            {"wall", run.cost.wall},
            {"filter_cpu", run.filtering.cpu},
            {"filter_wall", run.filtering.wall},
            {"energy", kept_energy(run.report)},
            {"backend", run.report.backend},
            {"random", run.report.random},
            {"features", run.report.features}};
  for (const PassReport& pass : run.report.passes)
    json["passes"].push_back({{"box", pass.box_width},
                              {"neighbors", pass.neighbors},
                              {"acceptance", pass.acceptance},
                              {"wall", pass.seconds}});
  if (run.error) json["error"] = json_of(*run.error);
  return json;
}

}  // namespace rpf::bench
