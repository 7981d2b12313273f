#include "conformance/tolerances.h"

namespace rpf {
namespace {

struct Row {
  const char* platform;  ///< part of the platform's name; empty: any
  ConformanceTolerance tolerance;
};

constexpr Row table[] = {
    {"Portable Computing Language", {0, "PoCL rounds + - * / sqrt correctly and does not contract: measured"}},
    {"",
     {0, "a device is used only after its self-test: it then does what the reference does, operation by operation"}},
};

}  // namespace

ConformanceTolerance tolerance_of(const DeviceInfo& device) {
  for (const Row& row : table)
    if (device.platform.find(row.platform) != std::string::npos) return row.tolerance;
  return {};
}

}  // namespace rpf
