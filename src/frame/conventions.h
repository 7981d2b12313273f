// What in a frame contradicts docs/file-format.md.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "frame/column_block.h"
#include "frame/tally.h"
#include "rpf/filter.h"
#include "rpf/samples.h"

namespace rpf {

/// Of the records of a block: the corner of the pixel of each, in the coordinates of the data window.
struct PixelCorners {
  float x[block_records], y[block_records];
};

class ConventionCheck {
 public:
  ConventionCheck() = default;
  virtual ~ConventionCheck() = default;
  ConventionCheck(const ConventionCheck&) = delete;
  ConventionCheck& operator=(const ConventionCheck&) = delete;
};

/// A check of single samples.
class SampleCheck : public ConventionCheck {
 public:
  /// Marks at least the records that contradict, many at a time: in doubt and near a limit others too.
  virtual void look(const ColumnBlock& records, const PixelCorners& corners, BlockMask& odd) const = 0;
  /// A sample that was marked, of a pixel by its number in the frame (row-major in its data window), in ascending
  /// order.
  virtual void add(const float* record, std::size_t pixel) = 0;
  virtual void tell(const Window& data_window, std::vector<InputNote>& notes) const = 0;
};

/// What a check of pixels found so far.
struct PixelFindings {
  Tally wrong;
  std::uint64_t looked_at = 0;  ///< of what can be wrong

  /// Takes over what was found in later pixels.
  void join(const PixelFindings& later) {
    wrong.join(later.wrong);
    looked_at += later.looked_at;
  }
};

/// A check of samples together.
class PixelCheck : public ConventionCheck {
 public:
  /// The samples of a pixel, which has the number `place` in these rows and `pixel` in the frame; in ascending order.
  virtual void look(const SampleBuffer& rows, std::size_t place, std::size_t pixel, PixelFindings& found) const = 0;
  virtual void tell(const PixelFindings& found, const Window& data_window, std::vector<InputNote>& notes) const = 0;
};

struct ConventionChecks {
  std::vector<std::unique_ptr<SampleCheck>> of_samples;
  std::vector<std::unique_ptr<PixelCheck>> of_pixels;
};

/// All checks of a frame. Each sees every sample once, before it is changed: look() many of them, on any thread, and
/// then add what was found, in the order of the pixels.
class Conventions {
 public:
  using Found = std::vector<PixelFindings>;  ///< of the checks of pixels

  /// `frame`: may be without its samples.
  explicit Conventions(const SampleBuffer& frame);

  /// SampleCheck::look() of all checks.
  void look(const ColumnBlock& records, const PixelCorners& corners, BlockMask& odd) const {
    for (const auto& check : checks_.of_samples) check->look(records, corners, odd);
  }
  /// PixelCheck::look() of all checks. `found`: empty, or what was found in pixels before.
  void look(const SampleBuffer& rows, std::size_t place, std::size_t pixel, Found& found) const;

  void add(const float* record, std::size_t pixel) {
    for (const auto& check : checks_.of_samples) check->add(record, pixel);
  }
  void add(const Found& later);
  /// A pixel and all its samples, where nobody looked before.
  void add_all(const SampleBuffer& rows, std::size_t place, std::size_t pixel);

  /// What contradicts docs/file-format.md.
  std::vector<InputNote> notes(const Window& data_window) const;

 private:
  ConventionChecks checks_;
  Found found_;
};

/// Film positions outside their pixel.
void add_film_check(const SampleBuffer& samples, ConventionChecks& checks);
/// Normals, reflectances, and whether positions lie on surfaces with these normals; of those that the frame has.
void add_surface_checks(const SampleBuffer& samples, ConventionChecks& checks);

/// Marks what is below `least` or above `most`; NaN is neither.
void mark_outside(const float* values, float least, float most, BlockMask& odd);

/// Whether a value may be one of 0 to 255 that stand for 0 to 1; 0 itself says nothing.
bool looks_like_byte(float value);

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
