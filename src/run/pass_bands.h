// How many rows passes take at once where memory is limited.
#pragma once

#include "rpf/rows.h"
#include "seam/backend.h"

namespace rpf {

struct PassBands {
  std::uint64_t at_once = 0;  ///< bytes of rows that are read at a time
  std::uint64_t bytes = 0;    ///< of everything
  int rows_read = 0;          ///< at a time, at most
  int rows_held = 0;          ///< in memory, at most
};

/// The most rows at a time, of a frame whose rows are read when they are needed, that keep Settings::max_memory; single
/// rows where none do. Throws Error(usage) as filter() does.
PassBands pass_bands(const SampleRows& rows, std::uint32_t most_samples, const Settings& settings,
                     const Backend& backend);

}  // namespace rpf
