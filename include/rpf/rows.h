// Frames that are read by rows as they are needed: larger than memory, or one part of many.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rpf/filter.h"
#include "rpf/io.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

/// The samples of a frame, row by row, in any order and as often as they are asked for.
class SampleRows {
 public:
  SampleRows() = default;
  virtual ~SampleRows() = default;
  SampleRows(const SampleRows&) = delete;
  SampleRows& operator=(const SampleRows&) = delete;

  /// The frame without its samples: windows, slots, metadata.
  virtual const SampleBuffer& frame() const = 0;
  /// Samples of a row of the data window, the topmost being 0.
  virtual std::uint64_t row_samples(int row) const = 0;
  /// The rows first .. end - 1 as a frame of their own, whose data window they are. Throws Error(input).
  virtual SampleBuffer read(int first, int end) = 0;

  /// Samples of the rows first .. end - 1.
  std::uint64_t sample_count(int first, int end) const;
  /// Of the frame.
  std::uint64_t sample_count() const;
  /// Bytes of the samples of a row, with the room that readers leave behind them.
  std::uint64_t row_bytes(int row) const;
  /// The end of the rows from `first` on, at least one, that take at most so many bytes together.
  int end_within(int first, std::uint64_t bytes) const;
};

/// Opens a sample file to be read by rows; checks what inspect_samples() checks. `options`: as for read_samples(), but
/// nobody looks at the memory: that is for who asks for rows. Throws Error(input).
std::unique_ptr<SampleRows> open_sample_rows(const std::string& path, const SampleReadOptions& options = {});

/// write_samples() of rows that are read when they are needed, from the top, each once: a frame larger than memory.
/// Throws as write_samples() does, what reading throws, and Error(cancelled), after which nothing is written.
void write_sample_rows(const std::string& path, SampleRows& rows, const std::vector<std::string>& half_slots = {},
                       const Control& control = {});

/// Bytes that this takes at the most.
std::uint64_t write_rows_memory(const SampleRows& rows);

/// A rendering to be merged with others, row by row.
struct RowsPart {
  std::string name;  ///< what errors call it, for example its file
  std::unique_ptr<SampleRows> rows;
};

/// merge_samples() of rows that are read when they are needed, each as often as it is asked for. Looks for repeated
/// samples at once, which of different renderings takes the first row of each. Throws as merge_samples() does.
std::unique_ptr<SampleRows> merge_rows(std::vector<RowsPart> parts);

/// What filter() finds out of all samples of a frame together, in one pass over its rows, as JSON: notes, what is
/// constant, how bright it is, where it lies. Depends on the settings but for crop, backend, threads and memory. Throws
/// as filter() does.
std::string find_facts(SampleRows& rows, const Settings& settings, const Control& control = {});

/// filter(), of rows that are read when they are needed: the same bits. `facts`: of find_facts() with these settings,
/// so that only those rows are read that the crop needs; empty: they are found first. Throws as filter() does.
Result filter_rows(SampleRows& rows, const Settings& settings, const std::string& facts = {},
                   const Control& control = {});

/// What `rpf info` says of the values of a frame.
struct RowSurvey {
  std::vector<ChannelSurvey> channels;  ///< as of survey()
  std::vector<InputNote> notes;         ///< what filter() would say of the samples
};

/// Reads every row once, some at a time. Throws Error(input).
RowSurvey survey_rows(SampleRows& rows);

/// Whether filter_rows() with these settings reads rows when they are needed where they do not fit into memory: not
/// where channels without information are to be found, and not with methods that filter pixels.
bool can_stream(const Settings& settings);

/// What filter_rows() takes of a frame whose rows are read when they are needed.
struct RowsMemory {
  std::uint64_t bytes = 0;  ///< of Method::learned at the least: it keeps more rows where there is room
  int rows_read = 0;        ///< at once, about
  int rows_held = 0;        ///< with what passes read around them; of Method::learned 0
};

/// Of settings that can_stream(). Throws Error(usage) as filter() does.
RowsMemory predict_rows_memory(const SampleRows& rows, std::uint32_t max_samples_per_pixel, const Settings& settings);

}  // namespace rpf
