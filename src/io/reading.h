// What readers and writers of both kinds of sample files share.
#pragma once

#include <cstdint>
#include <string>

#include "rpf/io.h"

namespace rpf::io {

/// Throws Error(memory) with the need and the limit, in bytes, where the need is larger; a limit of 0 is none.
void check_budget(const std::string& path, std::uint64_t need, std::uint64_t limit);

/// Throws Error(input) for more samples than the numbers in SampleBuffer::first_sample can count.
void check_sample_count(const std::string& path, std::uint64_t samples);

/// Throws Error(output) where a file just written is not what went in, so that a defect of a writer does not replace a
/// good file. `back` is what was read of the temporary file.
void check_read_back(const std::string& path, const SampleFileInfo& back, const Window& window, std::uint64_t samples);

/// Takes their slots from the channels that are not to be read.
void leave_out_unwanted(SampleFileInfo& info, const SampleReadOptions& options);

/// Makes the values of all samples, 0, with spare_columns behind them. first_sample is known.
void allocate_values(SampleBuffer& samples);

/// A buffer with the file's windows, metadata and slots, without samples.
SampleBuffer empty_buffer(const SampleFileInfo& info);

/// The same of the rows first .. end - 1 of a frame's data window, as a frame of their own; first_sample begins.
SampleBuffer empty_rows(const SampleBuffer& frame, int first, int end);

}  // namespace rpf::io
