// Deep scan-line OpenEXR out.
#pragma once

#include <string>
#include <vector>

#include "rpf/io.h"

namespace rpf::io {

/// As write_samples() of rpf/io.h, whatever the extension of `path`.
void write_deep(const std::string& path, const SampleBuffer& samples, const std::vector<std::string>& half_slots);

}  // namespace rpf::io
