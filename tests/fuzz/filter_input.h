// Bytes to a small frame and settings, for the fuzzer to choose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "rpf/explain.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

struct FilterInput {
  rpf::SampleBuffer samples;
  rpf::Settings settings;
  bool explains = false;                    ///< explain() in place of filter()
  std::optional<rpf::PixelPosition> pixel;  ///< that it explains
};

/// Any bytes do; what is missing at their end is filled up with plain values. OpenCL compiles a kernel for every kind
/// of frame, so channels, samples a pixel and bins come from a short list, and the first two samples are the same in
/// every frame, so that no channel is constant. The rest is free: any values, counts, windows, methods and settings,
/// also impossible.
FilterInput filter_input(const std::uint8_t* data, std::size_t size);
