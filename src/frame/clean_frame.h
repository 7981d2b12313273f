// A frame before its records are made: what preparing begins with, whatever the method.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frame/clean.h"
#include "frame/prepare.h"
#include "frame/selection.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

struct CleanFrame {
  SampleBuffer frame;    ///< windows and slots, without samples
  SampleBuffer samples;  ///< those of all rows, or of some, that can be used; what is missing is NaN
  Columns columns;
  Selection selection;
  std::vector<std::size_t> carried;  ///< columns of what is averaged beside the color
  PreparedFrame prepared;            ///< without records, colors, first_sample and what says how these came to be
};

/// Windows, slots and metadata of a frame, or of some of its rows.
SampleBuffer without_samples(const SampleBuffer& samples);

/// What is known of a frame before its samples are.
CleanFrame begin_frame(const SampleBuffer& frame, const Settings& settings);

/// Puts missing film positions of rows in the middle of their pixels where the method needs positions.
void center_missing_positions(SampleBuffer& rows, const Columns& columns, Method method);

/// 2^exponent, held within what is a normal float and has one for its inverse, also for subnormal radiance.
float power_of_two(int exponent);

/// The power of two that brings the brightest value of a frame to [2^40, 2^41); 1 for a black frame.
float radiance_scale(float brightest);

/// Takes over what cleaning found out of all rows: notes, the scale of the radiance.
void take_report(CleanFrame& clean, const CleanReport& report);

/// Takes rows over that were cleaned, by Cleaning or clean_again(): all of the frame, or some.
void take_rows(CleanFrame& clean, SampleBuffer rows, const CleanReport& report, Method method);

/// first_sample of the frame, from that of some rows; the others have no samples.
std::vector<std::uint32_t> first_sample_in_frame(std::vector<std::uint32_t> of_rows, const Window& rows,
                                                 const Window& data_window);

/// "lens.U" of the slot "random.lens.U".
std::string short_name(const std::string& slot);

/// What is averaged, sample by sample: the scaled color where it is wanted, then CleanFrame::carried; 0 for a value
/// that is missing, which has nothing to average.
std::vector<float> carried_values(const CleanFrame& clean, bool with_color);

}  // namespace rpf
