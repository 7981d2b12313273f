#include "streaming.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <tuple>

#include "io/row_pieces.h"
#include "rpf/error.h"
#include "rpf/methods.h"
#include "run/driver.h"
#include "same_bits.h"

namespace rpf::test {
namespace {

constexpr std::uint64_t a_row = 1;  ///< bytes: less than any row

std::string first_difference(const Image& found, const Image& expected) {
  if (found.channels != expected.channels || found.pixels.size() != expected.pixels.size()) return "another shape";
  for (std::size_t i = 0; i < found.pixels.size(); ++i)
    if (std::memcmp(&found.pixels[i], &expected.pixels[i], sizeof(float)) != 0)
      return fmt::format("value {} of {}: {:a}, in core {:a}", i, found.pixels.size(), found.pixels[i],
                         expected.pixels[i]);
  return "";
}

bool same_notes(const Report& a, const Report& b) {
  const auto same = [](const InputNote& x, const InputNote& y) {
    return x.what == y.what && x.count == y.count && x.x == y.x && x.y == y.y;
  };
  return std::equal(a.notes.begin(), a.notes.end(), b.notes.begin(), b.notes.end(), same) && a.dropped == b.dropped;
}

bool same_passes(const Report& a, const Report& b) {
  const auto same = [](const PassReport& x, const PassReport& y) {
    return x.box_width == y.box_width && x.neighbors == y.neighbors && x.acceptance == y.acceptance &&
           x.fraction_random == y.fraction_random && x.alpha == y.alpha && x.beta == y.beta && x.energy == y.energy;
  };
  return std::equal(a.passes.begin(), a.passes.end(), b.passes.begin(), b.passes.end(), same);
}

/// What filtering by rows refuses with; empty: it does not.
std::string refusal_by_rows(const SampleBuffer& samples, Settings settings) {
  settings.max_memory = 1;
  io::BufferRows rows(samples);
  try {
    filter_rows(rows, settings);
  } catch (const Error& error) {
    const bool is_expected =
        error.kind() == (needs_whole_frame(settings.method) ? ErrorKind::usage : ErrorKind::memory);
    return is_expected ? error.what() : fmt::format("another kind of error: {}", error.what());
  }
  return "";
}

}  // namespace

std::string difference(const Result& found, const Result& expected) {
  for (const auto& [name, image, whole] : {std::tuple{"image", &found.image, &expected.image},
                                           std::tuple{"features", &found.features, &expected.features}})
    if (!same_bits(image->pixels, whole->pixels) || image->channels != whole->channels)
      return fmt::format("{}, {}", name, first_difference(*image, *whole));
  if (found.image.metadata != expected.image.metadata) return "attributes of the image";
  if (found.report.backend != expected.report.backend) return "backend " + found.report.backend;
  if (!same_notes(found.report, expected.report)) return "notes";
  if (!same_passes(found.report, expected.report)) return "what is told of the passes";
  return "";
}

Result streamed(const SampleBuffer& samples, Settings settings) {
  settings.max_memory = 1;
  io::BufferRows rows(samples);
  return run_streamed(rows, scan_rows(rows, settings, {}, {a_row}), settings, {}, a_row);
}

std::string refusal_of(const Settings& settings) {
  if (needs_whole_frame(settings.method)) return "filters the whole frame at once";
  if (settings.method == Method::rpf && settings.drop_uninformative) return "take fewer rows at once";
  return "";
}

std::string difference_when_streamed(const SampleBuffer& samples, const Settings& settings, const Result& in_core) {
  const std::string refusal = refusal_of(settings);
  if (refusal.empty()) return difference(streamed(samples, settings), in_core);
  const std::string told = refusal_by_rows(samples, settings);
  return told.find(refusal) != std::string::npos ? "" : fmt::format("refused with '{}'", told);
}

}  // namespace rpf::test
