// What only all samples of a frame together tell, from rows that are read one after the other.
#pragma once

#include <cstdint>
#include <vector>

#include "rpf/filter.h"
#include "rpf/rows.h"
#include "run/row_facts.h"

namespace rpf {

/// Bytes of samples that are read at once where nothing asks for more.
constexpr std::uint64_t bytes_at_once = 32 << 20;

/// Bytes of the samples of a row.
std::uint64_t row_bytes(const SampleRows& rows, int row);

/// The end of the rows from `first` on, at least one, that are read at once.
int end_at_once(const SampleRows& rows, int first, std::uint64_t at_once = bytes_at_once);

struct ScannedRows {
  RowFacts facts;
  std::vector<std::uint32_t> first_sample;  ///< of the frame after cleaning; of the learned method only
};

/// Whatever the crop of the settings. Reads rows of at most `at_once` bytes, or one row. Throws as filter() does.
ScannedRows scan_rows(SampleRows& rows, Settings settings, const Control& control,
                      std::uint64_t at_once = bytes_at_once);

/// first_sample of the frame after cleaning, where only these rows are looked at: the others are as without samples.
std::vector<std::uint32_t> count_rows(SampleRows& rows, int first, int end, const CleanReport& cleaned,
                                      const Settings& settings);

/// Bytes of filtering the rows first .. end - 1 at once.
std::uint64_t rows_need(const SampleRows& rows, int first, int end, std::uint32_t most_samples,
                        const Settings& settings);

/// Throws Error(memory) where filtering the rows first .. end - 1 at once would exceed Settings::max_memory.
void check_rows(const SampleRows& rows, int first, int end, std::uint32_t most_samples, const Settings& settings);

}  // namespace rpf
