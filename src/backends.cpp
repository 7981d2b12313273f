#include <fmt/format.h>
#include <fmt/ranges.h>

#include "backend.h"
#include "cpu/cpu_backend.h"
#include "rpf/error.h"

namespace rpf {

std::vector<std::string> backend_names() { return {"cpu"}; }

std::unique_ptr<Backend> make_backend(const std::string& name, int threads) {
  if (name == "cpu") return std::make_unique<CpuBackend>(threads);
  throw Error(ErrorKind::usage,
              fmt::format("backend '{}' is not known; this build has: {}", name, fmt::join(backend_names(), ", ")));
}

}  // namespace rpf
