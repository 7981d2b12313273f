#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "frame/place_of.h"
#include "rpf/error.h"
#include "rpf/samples.h"

namespace rpf {
namespace {

const std::string random_prefix = "random.";
const std::string feature_prefix = "feature.";

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

[[noreturn]] void reject(const std::string& message) { throw Error(ErrorKind::input, "sample buffer: " + message); }

void validate_layout(const SampleLayout& layout) {
  for (const char* slot : {"R", "G", "B", "film.X", "film.Y"})
    if (!layout.find(slot))
      reject(fmt::format("channel {} is missing; every sample needs R, G, B, film.X and film.Y", slot));
  const std::set<std::string> distinct(layout.slots.begin(), layout.slots.end());
  if (distinct.size() != layout.size()) reject("a slot appears twice in the layout");
}

void include(ChannelSurvey& channel, float value, bool& any_finite, std::int64_t pixel) {
  if (!std::isfinite(value)) {
    if (channel.non_finite++ == 0) channel.first_non_finite = pixel;
    return;
  }
  if (value < 0 && channel.negative++ == 0) channel.first_negative = pixel;
  if (!any_finite) channel.minimum = channel.maximum = value;
  any_finite = true;
  channel.minimum = std::min(channel.minimum, value);
  channel.maximum = std::max(channel.maximum, value);
}

}  // namespace

std::optional<std::size_t> SampleLayout::find(const std::string& slot) const { return place_of(slot, slots); }

std::optional<std::size_t> Image::find(const std::string& channel) const { return place_of(channel, channels); }

bool is_random_slot(const std::string& slot) { return starts_with(slot, random_prefix); }

bool is_feature_slot(const std::string& slot) { return starts_with(slot, feature_prefix) && slot != "feature.hit"; }

std::string group_of(const std::string& slot) {
  const auto begin = slot.find('.');
  if (!starts_with(slot, random_prefix) && !starts_with(slot, feature_prefix)) return {};
  return slot.substr(begin + 1, slot.find('.', begin + 1) - begin - 1);
}

std::string text_of(const Window& window) {
  return fmt::format("{}x{}{:+}{:+}", window.width, window.height, window.x, window.y);
}

bool SampleBuffer::is_half(const std::string& slot) const {
  return std::find(half_slots.begin(), half_slots.end(), slot) != half_slots.end();
}

void SampleBuffer::validate() const {
  validate_layout(layout);
  if (data_window.width <= 0 || data_window.height <= 0) reject("the data window is empty");
  if (first_sample.size() != data_window.pixel_count() + 1)
    reject(fmt::format("first_sample has {} entries; {} are expected (pixels + 1)", first_sample.size(),
                       data_window.pixel_count() + 1));
  if (first_sample.front() != 0 || !std::is_sorted(first_sample.begin(), first_sample.end()))
    reject("first_sample must start at 0 and must not decrease");
  if (values.size() != sample_count() * layout.size())
    reject(fmt::format("values has {} entries; {} are expected (samples x channels)", values.size(),
                       sample_count() * layout.size()));
}

std::vector<ChannelSurvey> survey(const SampleBuffer& samples) {
  const std::size_t channels = samples.layout.size();
  std::vector<ChannelSurvey> result(channels);
  std::vector<char> any_finite(channels, 0);
  for (std::size_t c = 0; c < channels; ++c) result[c].slot = samples.layout.slots[c];
  for (std::size_t pixel = 0; pixel + 1 < samples.first_sample.size(); ++pixel)
    for (std::size_t sample = samples.first_sample[pixel]; sample < samples.first_sample[pixel + 1]; ++sample)
      for (std::size_t c = 0; c < channels; ++c) {
        bool any = any_finite[c] != 0;
        include(result[c], samples.record(sample)[c], any, static_cast<std::int64_t>(pixel));
        any_finite[c] = any;
      }
  for (ChannelSurvey& channel : result) channel.constant = channel.minimum == channel.maximum;
  return result;
}

}  // namespace rpf
