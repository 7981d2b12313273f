// What the values of a frame are, from rows that are read one after the other.
#include <algorithm>

#include "frame/clean.h"
#include "rpf/rows.h"
#include "run/row_scan.h"

namespace rpf {
namespace {

/// Adds what was found in `samples` further ones, from pixel `first` on.
void include(ChannelSurvey& all, const ChannelSurvey& part, bool is_first, std::uint64_t samples, std::int64_t first) {
  const auto include_count = [&](std::uint64_t ChannelSurvey::*count, std::int64_t ChannelSurvey::*place) {
    if (all.*count == 0 && part.*count > 0) all.*place = first + part.*place;
    all.*count += part.*count;
  };
  const bool any_finite = part.non_finite < samples;
  if (any_finite) {
    all.minimum = is_first ? part.minimum : std::min(all.minimum, part.minimum);
    all.maximum = is_first ? part.maximum : std::max(all.maximum, part.maximum);
  }
  include_count(&ChannelSurvey::non_finite, &ChannelSurvey::first_non_finite);
  include_count(&ChannelSurvey::negative, &ChannelSurvey::first_negative);
  all.constant = all.minimum == all.maximum;
}

}  // namespace

RowSurvey survey_rows(SampleRows& rows) {
  const SampleBuffer& frame = rows.frame();
  const Columns columns = find_columns(frame, false);
  Cleaning cleaning(frame, columns, {});
  RowSurvey result;
  for (const std::string& slot : frame.layout.slots) {
    result.channels.emplace_back();
    result.channels.back().slot = slot;
  }
  std::vector<char> any_finite(frame.layout.size(), 0);
  for (int row = 0, end = 0; row < frame.data_window.height; row = end) {
    end = rows.end_within(row, bytes_at_once);
    SampleBuffer part = rows.read(row, end);
    const std::size_t first = first_pixel(part.data_window, frame.data_window);
    const std::vector<ChannelSurvey> found = survey(part);
    for (std::size_t c = 0; c < found.size(); ++c) {
      include(result.channels[c], found[c], any_finite[c] == 0, part.sample_count(), static_cast<std::int64_t>(first));
      if (found[c].non_finite < part.sample_count()) any_finite[c] = 1;
    }
    cleaning.add(part);
  }
  result.notes = cleaning.report().notes;
  return result;
}

}  // namespace rpf
