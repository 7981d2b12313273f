#include "run/backends.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cpu/cpu_backend.h"
#include "opencl/opencl_backend.h"
#include "rpf/error.h"
#include "rpf/filter.h"
#include "run/threads.h"

namespace rpf {
namespace {

std::unique_ptr<Backend> make_opencl(const Settings& settings) {
  return std::make_unique<OpenClBackend>(OpenClOptions{settings.device, thread_count(settings), 0});
}

std::unique_ptr<Backend> make_best(const Settings& settings) {
  try {
    return make_opencl(settings);
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::device) throw;
    return std::make_unique<CpuBackend>(thread_count(settings), fmt::format("no OpenCL: {}", e.what()));
  }
}

}  // namespace

std::vector<std::string> backend_names() { return {"cpu", "opencl", "auto"}; }

std::unique_ptr<Backend> make_backend(const Settings& settings) {
  if (settings.backend == "cpu") return std::make_unique<CpuBackend>(thread_count(settings));
  if (settings.backend == "opencl") return make_opencl(settings);
  if (settings.backend == "auto") return make_best(settings);
  throw Error(ErrorKind::usage, fmt::format("backend '{}' is not known; this build has: {}", settings.backend,
                                            fmt::join(backend_names(), ", ")));
}

}  // namespace rpf
