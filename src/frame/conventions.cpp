#include "frame/conventions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "frame/clean.h"
#include "frame/tally.h"

namespace rpf {
namespace {

constexpr double nearly_all = 0.9;  // some agree by chance with ours, and so are not among those that contradict it

/// Random numbers; 1 itself is what half makes of the largest below it.
class RandomCheck : public SampleCheck {
 public:
  explicit RandomCheck(const SampleLayout& layout) : layout_(layout), wrong_(layout.size()) {
    for (std::size_t c = 0; c < layout.size(); ++c)
      if (is_random_slot(layout.slots[c])) columns_.push_back(c);
  }

  void look(const ColumnBlock& records, const PixelCorners& /*corners*/, BlockMask& odd) const override {
    for (const std::size_t c : columns_) mark_outside(records[c], 0, 1, odd);
  }

  void add(const float* record, std::size_t pixel) override {
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

/// Coverage; what is missing is told as such.
class AlphaCheck : public SampleCheck {
 public:
  explicit AlphaCheck(std::size_t column) : column_(column) {}

  void look(const ColumnBlock& records, const PixelCorners& /*corners*/, BlockMask& odd) const override {
    mark_outside(records[column_], least, most, odd);
  }

  void add(const float* record, std::size_t pixel) override {
    const float alpha = record[column_];
    if ((alpha >= least && alpha <= most) || is_missing(alpha)) return;
    outside_.add(pixel);
    bytes_.agreeing += looks_like_byte(alpha) ? 1 : 0;
  }

  void tell(const Window& data_window, std::vector<InputNote>& notes) const override {
    outside_.tell("values of alpha outside 0 to 1" +
                      advice_of({bytes_}, outside_.count, "; write the part of the sample that is covered"),
                  data_window, notes);
  }

 private:
  // Sums that make 1 but for rounding, also of half.
  static constexpr float least = -1e-3F, most = 1 + 1e-3F;

  std::size_t column_;
  Tally outside_;
  Guess bytes_{"which look like 0 to 255; divide by 255"};
};

/// Pixels whose samples are copies of one: a sampler that starts anew for every sample.
class CopyCheck : public PixelCheck {
 public:
  void look(const SampleBuffer& rows, std::size_t place, std::size_t pixel, PixelFindings& found) const override {
    const std::uint32_t begin = rows.first_sample[place], end = rows.first_sample[place + 1];
    for (std::uint32_t i = begin + 1; i < end; ++i)
      if (std::memcmp(rows.record(begin), rows.record(i), rows.layout.size() * sizeof(float)) != 0) return;
    if (end - begin > 1) found.wrong.add(pixel);
  }

  void tell(const PixelFindings& found, const Window& data_window, std::vector<InputNote>& notes) const override {
    found.wrong.tell(
        "pixels whose samples are all the same, which tells nothing about noise; give each sample random numbers of "
        "its own",
        data_window, notes);
  }
};

}  // namespace

void mark_outside(const float* values, float least, float most, BlockMask& odd) {
  for (std::size_t i = 0; i < block_records; ++i)
    odd[i] |= static_cast<std::int32_t>(values[i] < least) | static_cast<std::int32_t>(values[i] > most);
}

bool looks_like_byte(float value) { return value > 0 && value <= 255 && value == std::floor(value); }

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
  checks_.of_samples.push_back(std::make_unique<RandomCheck>(frame.layout));
  if (const auto alpha = frame.layout.find("A")) checks_.of_samples.push_back(std::make_unique<AlphaCheck>(*alpha));
  add_surface_checks(frame, checks_);
  checks_.of_pixels.push_back(std::make_unique<CopyCheck>());
}

void Conventions::look(const SampleBuffer& rows, std::size_t place, std::size_t pixel, Found& found) const {
  found.resize(checks_.of_pixels.size());
  for (std::size_t i = 0; i < found.size(); ++i) checks_.of_pixels[i]->look(rows, place, pixel, found[i]);
}

void Conventions::add(const Found& later) {
  found_.resize(checks_.of_pixels.size());
  for (std::size_t i = 0; i < later.size(); ++i) found_[i].join(later[i]);
}

void Conventions::add_all(const SampleBuffer& rows, std::size_t place, std::size_t pixel) {
  for (std::uint32_t i = rows.first_sample[place]; i < rows.first_sample[place + 1]; ++i) add(rows.record(i), pixel);
  look(rows, place, pixel, found_);
}

std::vector<InputNote> Conventions::notes(const Window& data_window) const {
  std::vector<InputNote> notes;
  for (const auto& check : checks_.of_samples) check->tell(data_window, notes);
  for (std::size_t i = 0; i < found_.size(); ++i) checks_.of_pixels[i]->tell(found_[i], data_window, notes);
  return notes;
}

std::vector<InputNote> check_conventions(const SampleBuffer& samples) {
  Conventions conventions(samples);
  for (std::size_t pixel = 0; pixel + 1 < samples.first_sample.size(); ++pixel)
    conventions.add_all(samples, pixel, pixel);
  return conventions.notes(samples.data_window);
}

}  // namespace rpf
