// The learned estimator: plain loops over kernels/rpf_network.h (docs/network.md).
#include "cpu/cpu_backend.h"

namespace rpf {

void CpuBackend::load_estimate(const Frame& /*frame*/, std::vector<float> /*colors*/, const EstimatePlan& /*plan*/) {}

std::vector<float> CpuBackend::estimate(const Window& /*region*/, const EstimateProgress& /*progress*/) { return {}; }

std::vector<EstimateStage> CpuBackend::trace_estimate(const Window& /*region*/) { return {}; }

std::uint64_t CpuBackend::estimate_bytes(const EstimatePlan& /*plan*/, const Window& /*window*/,
                                         std::uint64_t /*samples*/) const {
  return 0;
}

}  // namespace rpf
