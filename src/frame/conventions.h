// What in a frame contradicts docs/file-format.md: each check sees every sample once, pixel by pixel.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rpf/filter.h"
#include "rpf/samples.h"

namespace rpf {

class ConventionCheck {
 public:
  ConventionCheck() = default;
  virtual ~ConventionCheck() = default;
  ConventionCheck(const ConventionCheck&) = delete;
  ConventionCheck& operator=(const ConventionCheck&) = delete;

  /// The samples of a pixel, which has the number `place` in these rows and `pixel` in the frame (row-major in its data
  /// window); pixels come in ascending order.
  virtual void add(const SampleBuffer& rows, std::size_t place, std::size_t pixel) = 0;
  virtual void tell(const Window& data_window, std::vector<InputNote>& notes) const = 0;
};

/// A check of single samples: `Check` has add_sample(record, pixel).
template <typename Check>
class SampleCheck : public ConventionCheck {
 public:
  void add(const SampleBuffer& rows, std::size_t place, std::size_t pixel) final {
    for (std::uint32_t i = rows.first_sample[place]; i < rows.first_sample[place + 1]; ++i)
      static_cast<Check*>(this)->add_sample(rows.record(i), pixel);
  }
};

using ConventionChecks = std::vector<std::unique_ptr<ConventionCheck>>;

/// All checks of a frame.
class Conventions {
 public:
  /// `frame`: may be without its samples.
  explicit Conventions(const SampleBuffer& frame);

  /// To be called for every pixel, in ascending order, before its samples are changed; ConventionCheck::add().
  void add(const SampleBuffer& rows, std::size_t place, std::size_t pixel) {
    for (const auto& check : checks_) check->add(rows, place, pixel);
  }
  /// What contradicts docs/file-format.md.
  std::vector<InputNote> notes(const Window& data_window) const;

 private:
  ConventionChecks checks_;
};

/// Film positions outside their pixel.
void add_film_check(const SampleBuffer& samples, ConventionChecks& checks);
/// Normals, reflectances, and whether positions lie on surfaces with these normals; of those that the frame has.
void add_surface_checks(const SampleBuffer& samples, ConventionChecks& checks);

/// A convention that values may follow in place of ours, and what to do about it.
struct Guess {
  std::string advice;
  std::uint64_t agreeing = 0;  ///< of the values that contradict ours
};

/// The advice of the first guess that nearly all of `count` values agree with, else `otherwise`.
std::string advice_of(const std::vector<Guess>& guesses, std::uint64_t count, const std::string& otherwise);

/// The columns of a slot's components, such as {"feature.N.X", "feature.N.Y", "feature.N.Z"}; empty where one is
/// missing.
std::vector<std::size_t> columns_of(const SampleLayout& layout, const std::string& prefix, const char* components);

}  // namespace rpf
