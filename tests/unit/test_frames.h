// Small synthetic frames for the tests, the same on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf::test {

/// Pseudo-random floats in [0, 1), exactly representable with 16 bits.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : state_(seed) {}
  float operator()() {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<float>(state_ >> 16) / 65536.0F;
  }

 private:
  std::uint32_t state_;
};

struct FrameOptions {
  int width = 13, height = 9;
  int samples = 4;  ///< a pixel; 0: varying from 0 to 5
  std::uint32_t seed = 1;
};

/// Two surfaces at different depths with an edge that the lens moves, textured and noisy.
/// Slots: R G B film.X film.Y random.lens.U random.lens.V random.time feature.N.X/Y/Z feature.P.X/Y/Z feature.albedo.R.
SampleBuffer defocused_edge(const FrameOptions& options = {});

/// The same with everything that the learned estimator has an input for: also random.light.U/.V, random.bsdf.U/.V,
/// feature.albedo.R/G/B, feature.hit, feature.N2.X/Y/Z, feature.P2.X/Y/Z. Some samples hit nothing, others nothing
/// after the first hit.
SampleBuffer every_input(const FrameOptions& options = {});

/// The backend under test: RPF_TEST_BACKEND, or the reference. CMake registers the functional tests once for each.
std::string backend_under_test();

/// Settings for small frames: the backend under test, box widths 9, 5, 3, one thread.
Settings small_settings();

/// Sets one channel of all samples.
void fill(SampleBuffer& samples, const std::string& slot, float value);

/// Multiplies R, G and B by a factor.
void scale_radiance(SampleBuffer& samples, float factor);

/// Adds a channel behind the others, with one value for all samples.
void add_channel(SampleBuffer& samples, const std::string& slot, float value);

/// Adds feature.penumbra.slope and .width: something stands before the light of every third sample or so.
void cast_shadows(SampleBuffer& samples);

/// The pixels of a part of an image, in the coordinates of its data window.
std::vector<float> part_of(const Image& image, const Window& part);

/// The same samples with these slots only, in this order.
SampleBuffer with_slots(const SampleBuffer& samples, const std::vector<std::string>& slots);

/// The value of a channel.
float& value_of(SampleBuffer& samples, std::size_t sample, const std::string& slot);

}  // namespace rpf::test
