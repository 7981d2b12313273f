// Joins renderings of one frame, sample by sample.
#include "frame/merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "rpf/error.h"
#include "rpf/samples.h"

namespace rpf {
namespace {

[[noreturn]] void reject(const std::string& message) { throw Error(ErrorKind::input, message); }

/// The slots of `a` that `b` does not have.
std::vector<std::string> missing_slots(const SampleLayout& a, const SampleLayout& b) {
  std::vector<std::string> missing;
  for (const std::string& slot : a.slots)
    if (!b.find(slot)) missing.push_back(slot);
  return missing;
}

void check_slots(const SamplePart& whole, const SamplePart& lacking) {
  const std::vector<std::string> missing = missing_slots(whole.samples.layout, lacking.samples.layout);
  if (missing.empty()) return;
  reject(
      fmt::format("\"{}\" has no slot {}, but \"{}\" has; equal slots are expected: render both with the same channels "
                  "or leave it out of all with --map {}=",
                  lacking.name, fmt::join(missing, ", "), whole.name, missing.front()));
}

void check_window(const SamplePart& first, const SamplePart& other) {
  const Window &a = first.samples.data_window, &b = other.samples.data_window;
  if (!(a == b))
    reject(fmt::format("\"{}\" has the data window {}, but \"{}\" has {}; renderings of one frame are expected",
                       other.name, text_of(b), first.name, text_of(a)));
}

/// What says where a rendering was seen from, and what its numbers mean: with another it is of another frame.
constexpr const char* seen_from[] = {"view",           "worldToCamera",     "worldToNDC",    "rpf:worldOrigin",
                                     "rpf:lensRadius", "rpf:focusDistance", "chromaticities"};

/// An attribute that only one has says nothing, but for the origin, which is 0 where it is not given.
void check_camera(const SamplePart& first, const SamplePart& other) {
  for (const std::string name : seen_from) {
    const auto value_of = [&](const SamplePart& part) -> std::optional<Attribute> {
      const auto found = part.samples.metadata.find(name);
      if (found != part.samples.metadata.end()) return found->second;
      return name == "rpf:worldOrigin" ? std::optional<Attribute>(std::vector<float>(3, 0.0F)) : std::nullopt;
    };
    const auto a = value_of(first), b = value_of(other);
    if (a && b && *a != *b)
      reject(fmt::format("\"{}\" has another {} than \"{}\"; renderings of one frame by one camera are expected",
                         other.name, name, first.name));
  }
}

std::string seeds_of(const SampleBuffer& samples) {
  for (const char* name : {seeds_attribute, seed_attribute}) {
    const auto found = samples.metadata.find(name);
    if (found == samples.metadata.end()) continue;
    if (const auto* text = std::get_if<std::string>(&found->second)) return *text;
    if (const auto* number = std::get_if<std::int32_t>(&found->second)) return std::to_string(*number);
    // Python writes numbers as floats.
    const auto* real = std::get_if<float>(&found->second);
    if (real != nullptr && *real == std::trunc(*real)) return fmt::format("{:.0f}", *real);
  }
  return "?";
}

/// Whether one of the pixel's samples in `b` is the pixel's first one in `a`, bit for bit.
bool repeats_first(const SampleBuffer& a, const SampleBuffer& b, std::size_t pixel) {
  const float* first = a.record(a.first_sample[pixel]);
  for (std::size_t s = b.first_sample[pixel]; s < b.first_sample[pixel + 1]; ++s)
    if (std::memcmp(first, b.record(s), a.layout.size() * sizeof(float)) == 0) return true;
  return false;
}

void check_parts(std::vector<SamplePart>& parts) {
  if (parts.empty()) throw Error(ErrorKind::usage, "merge_samples: one or more sample buffers are expected");
  std::uint64_t total = 0;
  for (SamplePart& part : parts) {
    part.samples.validate();
    check_alike(parts.front(), part);
    reorder(part.samples, parts.front().samples.layout);
    total += part.samples.sample_count();
  }
  check_total(parts.front().name, total);
  for (std::size_t b = 1; b < parts.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      Repetition repetition;
      repetition.look(parts[a].samples, parts[b].samples);
      repetition.check(parts[a], parts[b]);
    }
}

std::vector<std::uint32_t> merged_offsets(const std::vector<SamplePart>& parts) {
  std::vector<std::uint32_t> offsets(parts.front().samples.first_sample.size(), 0);
  for (const SamplePart& part : parts)
    for (std::size_t p = 0; p < offsets.size(); ++p) offsets[p] += part.samples.first_sample[p];
  return offsets;
}

/// Copies the samples of a part behind what `next` says is filled of each pixel.
void place(const SampleBuffer& part, std::vector<std::uint32_t>& next, SampleBuffer& merged) {
  for (std::size_t p = 0; p < next.size(); ++p) {
    const std::uint32_t count = part.first_sample[p + 1] - part.first_sample[p];
    std::copy_n(part.record(part.first_sample[p]), count * merged.layout.size(), merged.record(next[p]));
    next[p] += count;
  }
}

}  // namespace

void reorder(SampleBuffer& samples, const SampleLayout& layout) {
  if (samples.layout.slots == layout.slots) return;
  std::vector<std::size_t> columns;
  for (const std::string& slot : layout.slots) columns.push_back(*samples.layout.find(slot));
  std::vector<float> record(layout.size());
  for (std::size_t s = 0; s < samples.sample_count(); ++s) {
    std::copy_n(samples.record(s), record.size(), record.begin());
    for (std::size_t c = 0; c < columns.size(); ++c) samples.record(s)[c] = record[columns[c]];
  }
  samples.layout = layout;
}

void check_alike(const SamplePart& first, const SamplePart& other) {
  check_window(first, other);
  check_camera(first, other);
  check_slots(first, other);
  check_slots(other, first);
}

void check_total(const std::string& first, std::uint64_t samples) {
  if (samples > most_samples_of_frame)
    reject(fmt::format("\"{}\" and the others hold {} samples, more than the {} that one file takes; merge fewer",
                       first, samples, most_samples_of_frame));
}

void Repetition::look(const SampleBuffer& a, const SampleBuffer& b) {
  for (std::size_t pixel = 0; pixel < a.data_window.pixel_count() && everywhere; ++pixel) {
    const bool in_both =
        a.first_sample[pixel] < a.first_sample[pixel + 1] && b.first_sample[pixel] < b.first_sample[pixel + 1];
    if (!in_both) continue;
    everywhere = repeats_first(a, b, pixel) || repeats_first(b, a, pixel);
    any = true;
  }
}

void Repetition::check(const SamplePart& a, const SamplePart& b) const {
  if (!any || !everywhere) return;
  reject(
      fmt::format("\"{}\" repeats samples of \"{}\" in every pixel (seeds {} and {}), which would lower no noise; "
                  "render it with another seed",
                  b.name, a.name, seeds_of(b.samples), seeds_of(a.samples)));
}

Metadata merged_metadata(const std::vector<SamplePart>& parts) {
  Metadata metadata = parts.front().samples.metadata;
  if (parts.size() == 1) return metadata;
  std::string seeds;
  for (const SamplePart& part : parts) seeds += (seeds.empty() ? "" : " ") + seeds_of(part.samples);
  metadata.erase(seed_attribute);
  metadata[seeds_attribute] = seeds;
  return metadata;
}

SampleBuffer joined(std::vector<SamplePart> parts) {
  SampleBuffer merged;
  merged.data_window = parts.front().samples.data_window;
  merged.display_window = parts.front().samples.display_window;
  merged.layout = parts.front().samples.layout;
  merged.metadata = merged_metadata(parts);
  merged.first_sample = merged_offsets(parts);
  merged.values.resize(merged.sample_count() * merged.layout.size());
  std::vector<std::uint32_t> next(merged.first_sample.begin(), merged.first_sample.end() - 1);
  for (SamplePart& part : parts) {
    reorder(part.samples, merged.layout);
    place(part.samples, next, merged);
    part.samples = {};  // gives its memory back
  }
  return merged;
}

SampleBuffer merge_samples(std::vector<SamplePart> parts) {
  check_parts(parts);
  return joined(std::move(parts));
}

std::uint64_t merging_bytes(std::uint64_t pixels, std::uint64_t samples, std::size_t slots, std::size_t parts) {
  constexpr std::uint64_t word = 4;
  const std::uint64_t offsets = (pixels + 1) * (parts + 2);  // of the parts, of the result, of what is filled
  return word * (2 * samples * slots + offsets);
}

}  // namespace rpf
