#include "frame/conventions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "frame/tally.h"

namespace rpf {
namespace {

constexpr double nearly_all = 0.95;

/// Random numbers; 1 itself is what half makes of the largest below it.
void check_random(const SampleBuffer& samples, std::vector<InputNote>& notes) {
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < samples.layout.size(); ++c)
    if (is_random_slot(samples.layout.slots[c])) columns.push_back(c);
  Tally outside;
  std::vector<char> wrong(samples.layout.size());
  Guess is_signed{"which look like -1 to 1; write (r + 1) / 2"};
  for (std::size_t pixel = 0; !columns.empty() && pixel + 1 < samples.first_sample.size(); ++pixel)
    for (std::uint32_t i = samples.first_sample[pixel]; i < samples.first_sample[pixel + 1]; ++i)
      for (const std::size_t c : columns) {
        const float value = samples.record(i)[c];
        if (!std::isfinite(value) || (value >= 0 && value <= 1)) continue;
        outside.add(pixel);
        wrong[c] = 1;
        if (value >= -1 && value < 0) ++is_signed.agreeing;
      }
  std::vector<std::string> names;
  for (const std::size_t c : columns)
    if (wrong[c] != 0) names.push_back(samples.layout.slots[c]);
  const std::string advice = advice_of({is_signed}, outside.count, "; write the number that was drawn, in [0,1)");
  outside.tell(fmt::format("random numbers outside 0 to 1 ({}){}", fmt::join(names, " "), advice), samples.data_window,
               notes);
}

/// Pixels whose samples are copies of one: a sampler that starts anew for every sample.
void check_copies(const SampleBuffer& samples, std::vector<InputNote>& notes) {
  const std::size_t bytes = samples.layout.size() * sizeof(float);
  Tally copies;
  for (std::size_t pixel = 0; pixel + 1 < samples.first_sample.size(); ++pixel) {
    const std::uint32_t begin = samples.first_sample[pixel], end = samples.first_sample[pixel + 1];
    std::uint32_t i = begin;
    while (i < end && std::memcmp(samples.record(begin), samples.record(i), bytes) == 0) ++i;
    if (end - begin > 1 && i == end) copies.add(pixel);
  }
  copies.tell(
      "pixels whose samples are all the same, which tells nothing about noise; give each sample random numbers "
      "of its own",
      samples.data_window, notes);
}

}  // namespace

std::string advice_of(const std::vector<Guess>& guesses, std::uint64_t count, const std::string& otherwise) {
  for (const Guess& guess : guesses)
    if (static_cast<double>(guess.agreeing) >= nearly_all * static_cast<double>(count)) return ", " + guess.advice;
  return otherwise;
}

std::vector<std::size_t> columns_of(const SampleLayout& layout, const std::string& prefix, const char* components) {
  std::vector<std::size_t> columns;
  for (const char* letter = components; *letter != '\0'; ++letter) {
    const auto column = layout.find(prefix + "." + *letter);
    if (!column) return {};
    columns.push_back(*column);
  }
  return columns;
}

std::vector<InputNote> check_conventions(const SampleBuffer& samples) {
  std::vector<InputNote> notes;
  check_film(samples, notes);
  check_random(samples, notes);
  check_surfaces(samples, notes);
  check_copies(samples, notes);
  return notes;
}

}  // namespace rpf
