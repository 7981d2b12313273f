// The learned estimator on a device.
#include "opencl/opencl_backend.h"
#include "rpf/error.h"

namespace rpf {
namespace {

[[noreturn]] void refuse() {
  throw Error(ErrorKind::device, "the learned estimator has no OpenCL kernels yet; use --backend=cpu");
}

}  // namespace

void OpenClBackend::load_estimate(const Frame& /*frame*/, std::vector<float> /*colors*/, const EstimatePlan& /*plan*/) {
  refuse();
}

std::vector<float> OpenClBackend::estimate(const Window& /*region*/, const EstimateProgress& /*progress*/) { refuse(); }

std::vector<EstimateStage> OpenClBackend::trace_estimate(const Window& /*region*/) { refuse(); }

std::uint64_t OpenClBackend::estimate_bytes(const EstimatePlan& /*plan*/, const Window& /*window*/,
                                            std::uint64_t /*samples*/) const {
  return 0;
}

}  // namespace rpf
