// Memory is accounted for before it is taken.
#pragma once

#include "frame/facts.h"
#include "rpf/filter.h"
#include "rpf/rows.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

FrameSize frame_size(const SampleBuffer& samples);

/// Columns that the buffer of values can hold.
std::uint64_t room_of(const SampleBuffer& samples);

/// Values a sample that are averaged: color, alpha, and the features where they are wanted.
std::size_t carried_count(const SampleLayout& layout, const Settings& settings);

/// What is known at the most of a frame whose samples are not: all channels vary; wherever a box is it has room.
FrameFacts largest_facts(const FrameSize& size, const SampleLayout& layout, const Settings& settings);

/// Bytes per pixel of passes: offsets, statistics, images before and after a pass, the result.
std::uint64_t pixel_bytes(std::uint64_t carried);

/// What was read, before it was prepared.
struct RawSize {
  FrameSize size;
  SampleLayout layout;
  std::uint64_t room = 0;  ///< columns
};

/// Of a frame whose rows are read when they are needed: the samples are those that are in memory at least.
RawSize streamed_size(const SampleRows& rows, std::uint32_t most_samples);

/// Throws Error(memory) with the need and the limit where the run, with `more` bytes for what else the
/// caller does, would exceed Settings::max_memory.
void check_memory(const SampleBuffer& samples, const Settings& settings, std::uint64_t more = 0);

}  // namespace rpf
