// What only all samples of a frame together tell, from rows that are read one after the other.
#pragma once

#include <cstdint>

#include "rpf/filter.h"
#include "rpf/rows.h"
#include "run/row_facts.h"

namespace rpf {

/// Bytes of samples that are read at once where nothing asks for more.
constexpr std::uint64_t bytes_at_once = 32 << 20;

/// Whatever the crop of the settings. Reads rows of at most `at_once` bytes, or one row. Throws as filter() does.
RowFacts scan_rows(SampleRows& rows, Settings settings, const Control& control, std::uint64_t at_once = bytes_at_once);

/// Throws Error(memory) where filtering the rows first .. end - 1 at once would exceed Settings::max_memory.
void check_rows(const SampleRows& rows, int first, int end, std::uint32_t most_samples, const Settings& settings);

}  // namespace rpf
