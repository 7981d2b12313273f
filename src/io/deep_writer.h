// Deep scan-line OpenEXR out.
#pragma once

#include <string>
#include <vector>

#include "rpf/rows.h"

namespace rpf::io {

/// As write_sample_rows() of rpf/rows.h, whatever the extension of `path`.
void write_deep(const std::string& path, SampleRows& rows, const std::vector<std::string>& half_slots,
                const Control& control);

}  // namespace rpf::io
