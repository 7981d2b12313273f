// The shared driver: runs a plan on a backend, pass by pass, tile by tile. It knows no device.
#pragma once

#include <functional>

#include "frame/prepare.h"
#include "rpf/filter.h"
#include "rpf/rows.h"
#include "run/row_facts.h"
#include "run/row_scan.h"
#include "seam/backend.h"

namespace rpf {

/// Called before each pass with the backend in the state that the pass starts from; for conformance tests.
using PassObserver = std::function<void(Backend&, const Plan&, int pass)>;

/// filter() of the public header, with an observer.
Result run_filter(SampleBuffer samples, const Settings& settings, const Control& control,
                  const PassObserver& before_pass);

/// The same of rows that were read, with what was found in the whole frame. They hold all that the crop reads around
/// it; `frame` is without samples.
Result run_rows(SampleBuffer rows, const SampleBuffer& frame, const RowFacts& facts, const Settings& settings,
                const Control& control);

/// The same of rows that are read when they are needed, at most `at_once` bytes of them, or one row, at a time: in as
/// little memory as predict_rows_memory() says. `scanned`: as far as rows are needed.
Result run_streamed(SampleRows& rows, ScannedRows scanned, const Settings& settings, const Control& control,
                    std::uint64_t at_once = bytes_at_once);

/// What a report says beside the passes: backend, modeled channels, notes about the input.
void describe_input(const Backend& backend, const PreparedFrame& prepared, Report& report);

}  // namespace rpf
