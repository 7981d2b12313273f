#include "opencl/environment.h"

#include <cstdlib>

namespace rpf {

std::string environment(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

}  // namespace rpf
