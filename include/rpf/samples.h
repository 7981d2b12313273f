// Sample buffers: every Monte Carlo sample of a frame as one record of floats (algorithm.md, section 1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rpf/image.h"

namespace rpf {

/// Which slot stands in which column of a sample's record. Slots are the canonical channel names of
/// docs/file-format.md: R G B [A] film.X film.Y [weight] random.GROUP[.COMPONENT] feature.GROUP[.COMPONENT]
/// [feature.hit]
struct SampleLayout {
  std::vector<std::string> slots;

  /// Values of a record.
  std::size_t size() const { return slots.size(); }
  /// Column of `slot`, or nothing where the layout does not have it.
  std::optional<std::size_t> find(const std::string& slot) const;
};

/// Metadata that mean something beyond their name (docs/file-format.md): what marks a sample file, and its version; the
/// seed that a frame was rendered with, and those of the frames it was merged of.
constexpr const char *format_attribute = "rpf:format", *version_attribute = "rpf:version";
constexpr const char *seed_attribute = "rpf:seed", *seeds_attribute = "rpf:seeds";

/// True for the slots of random parameters: random.GROUP[.COMPONENT].
bool is_random_slot(const std::string& slot);
/// True for the slots of modeled features: feature.GROUP[.COMPONENT], without the mask feature.hit.
bool is_feature_slot(const std::string& slot);
/// "lens" of "random.lens.U", "N" of "feature.N.X"; empty for the slots that have no group.
std::string group_of(const std::string& slot);

/// The most samples that a buffer, and a file, can hold: their numbers are 32 bits.
constexpr std::uint64_t most_samples_of_frame = 0xFFFFFFFEU;

/// All samples of a frame. A missing value is NaN.
/// Invariants (checked by validate()): first_sample has pixel_count() + 1 entries, starts at 0 and does not decrease;
/// values has sample_count() * layout.size() entries; R, G, B, film.X and film.Y are in the layout; no slot twice.
struct SampleBuffer {
  Window data_window;
  Window display_window;
  SampleLayout layout;
  std::vector<std::uint32_t>
      first_sample;  ///< [pixel_count + 1]: the samples of pixel p are first_sample[p] .. first_sample[p + 1] - 1
  std::vector<float> values;  ///< [sample_count][layout.size()]
  Metadata metadata;
  /// Slots that were stored as half: there an infinite value is light that overflowed, at 65504.
  std::vector<std::string> half_slots = {};

  /// Samples of all pixels together.
  std::size_t sample_count() const { return first_sample.empty() ? 0 : first_sample.back(); }
  /// The values of sample number `sample`, in the layout's order.
  float* record(std::size_t sample) { return values.data() + sample * layout.size(); }
  /// The same, to be read.
  const float* record(std::size_t sample) const { return values.data() + sample * layout.size(); }

  /// Whether the slot was stored as half.
  bool is_half(const std::string& slot) const;

  /// Throws Error(input) that names the first invariant that does not hold.
  void validate() const;
};

/// The slots that samples_of_image() makes of an image's channels; does not look at its pixels. Throws Error(input) for
/// an image without R, G and B.
SampleLayout layout_of_image(const Image& image);

/// An image as a frame of one sample a pixel, in the pixel's center: R, G, B, A where there is one, no random
/// parameters and no features. An image of one channel is gray. Throws Error(input) for an image without R, G and B.
SampleBuffer samples_of_image(const Image& image);

/// A rendering to be merged with others.
struct SamplePart {
  std::string name;  ///< what errors call it, for example its file
  SampleBuffer samples;
};

/// Joins renderings of one frame with different seeds: in each pixel the samples of the first part, then those of the
/// second, and so on, unchanged. Display window, order of slots and metadata are the first part's; of two or more parts
/// the attribute rpf:seeds lists the seeds in place of rpf:seed. Throws Error(input) that names the parts where data
/// windows, slots, view or camera differ, where every pixel of two parts shares a sample (they have one seed), or where
/// a part is invalid; Error(usage) without a part.
SampleBuffer merge_samples(std::vector<SamplePart> parts);

/// Peak bytes of parts and result in merge_samples. `samples` is the sum over all parts.
std::uint64_t merging_bytes(std::uint64_t pixels, std::uint64_t samples, std::size_t slots, std::size_t parts);

/// What one column of a sample buffer holds; `rpf info` prints it.
struct ChannelSurvey {
  std::string slot;
  float minimum = 0, maximum = 0;      ///< over the finite values; 0 where there are none
  std::uint64_t non_finite = 0;        ///< NaN and infinite values
  std::uint64_t negative = 0;          ///< values below zero
  std::int64_t first_non_finite = -1;  ///< pixel number (row-major) of the first non-finite value, -1 if none
  std::int64_t first_negative = -1;    ///< pixel number of the first negative value, -1 if none
  bool constant = true;                ///< all finite values are equal (also where there are none)
};

/// Reads every value once. One entry per slot, in the layout's order.
std::vector<ChannelSurvey> survey(const SampleBuffer& samples);

}  // namespace rpf
