#include "frame/conventions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "frame/tally.h"

namespace rpf {
namespace {

constexpr double nearly_all = 0.9;  // some agree by chance with ours, and so are not among those that contradict it

/// Random numbers; 1 itself is what half makes of the largest below it.
class RandomCheck : public SampleCheck<RandomCheck> {
 public:
  explicit RandomCheck(const SampleLayout& layout) : layout_(layout), wrong_(layout.size()) {
    for (std::size_t c = 0; c < layout.size(); ++c)
      if (is_random_slot(layout.slots[c])) columns_.push_back(c);
  }

  void add_sample(const float* record, std::size_t pixel) {
    for (const std::size_t c : columns_) {
      const float value = record[c];
      if ((value >= 0 && value <= 1) || !std::isfinite(value)) continue;
      outside_.add(pixel);
      wrong_[c] = 1;
      if (value >= -1 && value < 0) ++is_signed_.agreeing;
    }
  }

  void tell(const Window& data_window, std::vector<InputNote>& notes) const override {
    std::vector<std::string> names;
    for (const std::size_t c : columns_)
      if (wrong_[c] != 0) names.push_back(layout_.slots[c]);
    outside_.tell(fmt::format("random numbers outside 0 to 1 ({}){}", fmt::join(names, " "),
                              advice_of({is_signed_}, outside_.count, "; write the number that was drawn, in [0,1)")),
                  data_window, notes);
  }

 private:
  SampleLayout layout_;
  std::vector<std::size_t> columns_;
  std::vector<char> wrong_;  ///< [column]
  Tally outside_;
  Guess is_signed_{"which look like -1 to 1; write (r + 1) / 2"};
};

/// Pixels whose samples are copies of one: a sampler that starts anew for every sample.
class CopyCheck : public ConventionCheck {
 public:
  void add(const SampleBuffer& rows, std::size_t place, std::size_t pixel) override {
    const std::uint32_t begin = rows.first_sample[place], end = rows.first_sample[place + 1];
    for (std::uint32_t i = begin + 1; i < end; ++i)
      if (std::memcmp(rows.record(begin), rows.record(i), rows.layout.size() * sizeof(float)) != 0) return;
    if (end - begin > 1) copies_.add(pixel);
  }

  void tell(const Window& data_window, std::vector<InputNote>& notes) const override {
    copies_.tell(
        "pixels whose samples are all the same, which tells nothing about noise; give each sample random numbers of "
        "its own",
        data_window, notes);
  }

 private:
  Tally copies_;
};

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

Conventions::Conventions(const SampleBuffer& frame) {
  add_film_check(frame, checks_);
  checks_.push_back(std::make_unique<RandomCheck>(frame.layout));
  add_surface_checks(frame, checks_);
  checks_.push_back(std::make_unique<CopyCheck>());
}

std::vector<InputNote> Conventions::notes(const Window& data_window) const {
  std::vector<InputNote> notes;
  for (const auto& check : checks_) check->tell(data_window, notes);
  return notes;
}

std::vector<InputNote> check_conventions(const SampleBuffer& samples) {
  Conventions conventions(samples);
  for (std::size_t pixel = 0; pixel + 1 < samples.first_sample.size(); ++pixel) conventions.add(samples, pixel, pixel);
  return conventions.notes(samples.data_window);
}

}  // namespace rpf
