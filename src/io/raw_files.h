// Raw sample files in and out (docs/file-format.md): a line of JSON, sample counts, one plane of floats a channel.
#pragma once

#include <memory>
#include <string>

#include "rpf/io.h"
#include "rpf/rows.h"

namespace rpf::io {

/// As inspect_samples() and read_samples() of rpf/io.h, open_sample_rows() and write_sample_rows() of rpf/rows.h, for
/// raw files only.
SampleFileInfo inspect_raw(const std::string& path, const SampleReadOptions& options);
SampleBuffer read_raw(const std::string& path, const SampleReadOptions& options);
std::unique_ptr<SampleRows> open_raw_rows(const std::string& path, const SampleReadOptions& options);
void write_raw(const std::string& path, SampleRows& rows, const Control& control);

}  // namespace rpf::io
