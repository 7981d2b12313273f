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

/// How rows are gone through: at most `at_once` bytes at a time, or one row; from the first on so many bytes of those
/// that reach into first .. end - 1 stay in memory.
struct RowWalk {
  std::uint64_t at_once = bytes_at_once;
  int first = 0, end = 0;
  std::uint64_t kept_bytes = 0;
};

struct ScannedRows {
  RowFacts facts;
  // Of the learned method only:
  std::vector<std::uint32_t> first_sample;  ///< of the frame after cleaning
  std::vector<SampleBuffer> kept;           ///< cleaned rows, ascending
};

/// Whatever the crop of the settings. Throws as filter() does.
ScannedRows scan_rows(SampleRows& rows, Settings settings, const Control& control, const RowWalk& walk = {});

/// Fills in first_sample and what is kept, where only the rows of the walk are looked at: the others, but for those
/// that are read along with them, are as without samples.
void count_rows(SampleRows& rows, const RowWalk& walk, const CleanReport& cleaned, const Settings& settings,
                ScannedRows& scanned);

/// Bytes of filtering the rows first .. end - 1 at once.
std::uint64_t rows_need(const SampleRows& rows, int first, int end, std::uint32_t most_samples,
                        const Settings& settings);

/// Throws Error(memory) where filtering the rows first .. end - 1 at once would exceed Settings::max_memory.
void check_rows(const SampleRows& rows, int first, int end, std::uint32_t most_samples, const Settings& settings);

}  // namespace rpf
