// What cannot be used is left out or marked as missing before anything is computed (algorithm.md, section 1).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "frame/conventions.h"
#include "frame/tally.h"
#include "rpf/filter.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

/// What stands in the place of a value that is missing.
constexpr float missing = std::numeric_limits<float>::quiet_NaN();

/// Larger feature values count as missing: their squares would not survive a sum, and renderers write such values for
/// "no hit". Nor would sums of larger weights or alphas.
constexpr float largest_value = 1e15F;
inline bool is_missing(float value) { return !(std::fabs(value) <= largest_value); }

/// Where the slots that preparing a frame needs stand in a record.
struct Columns {
  std::size_t color[3] = {0, 0, 0}, film[2] = {0, 0};
  std::optional<std::size_t> alpha, weight, hit;
  std::vector<std::size_t> normal;                 ///< of the first hit: 3 columns, or none
  std::vector<std::size_t> position;               ///< of the first hit: the components there are
  std::vector<std::size_t> random;                 ///< random parameters
  std::vector<std::size_t> first_hit, second_hit;  ///< the features of each
  /// Of R, G, B: what an infinite value stands for; 0 where nothing does.
  float largest[3] = {0, 0, 0};
};

/// `clamp_infinite`: as in Settings.
Columns find_columns(const SampleBuffer& samples, bool clamp_infinite);

/// Of the colors of a pixel's samples, one after the other.
struct ColorSum {
  std::array<double, 3> color{};
  std::uint32_t samples = 0;
};

/// The mean color of a pixel's samples, where it has one.
struct PixelColor {
  std::array<float, 3> mean{};
  bool is_known = false;
};

/// A pixel that lost all its samples.
struct LostPixel {
  std::size_t pixel = 0;      ///< row-major in the data window
  std::uint32_t samples = 0;  ///< that it keeps
  std::array<float, 3> color{};
};

struct CleanReport {
  std::vector<InputNote> notes;    ///< what was found, and where first
  bool lacks_positions = false;    ///< whether a film position is missing
  float brightest = 0;             ///< the largest magnitude of R, G, B
  std::uint32_t most_samples = 0;  ///< of a pixel, that are left
  std::vector<LostPixel> lost;     ///< ascending
  bool has_color = true;           ///< false: no pixel of the frame has, and no sample is left
};

/// What was found so far.
struct CleanFindings {
  Tally infinite, not_finite, no_weight, negative, alpha, empty, lost, weightless;
  Tally missing;                      ///< samples
  std::vector<char> missing_columns;  ///< [column] of these
  float brightest = 0;
};

/// What is said of a sample: bits.
enum SampleMark : std::uint8_t {
  unclean = 1,  ///< has to be cleaned
  odd = 2       ///< may contradict a convention
};
using Marks = std::vector<std::uint8_t>;  ///< [sample] SampleMark

/// Cleans a frame, all at once or rows after rows, on all threads. Takes infinite radiance for the largest value of its
/// type where Columns::largest says so, leaves out samples whose color is not finite or whose weight is none, and marks
/// unusable features, random parameters and film positions as missing (NaN). A pixel that loses all its samples keeps
/// them, with weight 1; fill_lost() gives them the color of its neighbors. Buffers shrink in place.
class Cleaning {
 public:
  /// `frame`: may be without its samples. It and the columns outlive this.
  Cleaning(const SampleBuffer& frame, const Columns& columns, const Settings& settings);

  /// Hears of a pixel as soon as it is clean, while the cache still has its samples: its place in the rows, from which
  /// to before which sample it has them, and the sum of their colors. Called by several threads at once, and in any
  /// order.
  using Seen = std::function<void(std::size_t place, std::uint32_t begin, std::uint32_t end, const ColorSum& sum)>;

  /// Cleans the next rows, whose data window is their part of the frame's. Contradictions of the conventions are noted
  /// on the way, of the samples as they were.
  void add(SampleBuffer& rows, const Seen& seen = {});
  /// Whether a film position was missing so far.
  bool lacks_positions() const;
  /// After all rows.
  CleanReport report();

 private:
  Marks look(const SampleBuffer& rows, std::size_t first, const Seen& seen);

  const SampleBuffer& frame_;
  const Columns& columns_;
  bool clamp_negative_;
  int threads_;
  CleanFindings findings_;
  Conventions conventions_;
  std::uint32_t most_samples_ = 0;
  std::vector<LostPixel> lost_;
  std::vector<PixelColor> colors_;  ///< [pixel]
};

/// Cleans rows once more that were read again.
void clean_again(SampleBuffer& rows, const Columns& columns, const Settings& settings);

/// Gives the lost pixels among the rows their color, once all rows of the frame were looked at; leaves none of the
/// samples where no pixel has a color.
void fill_lost(SampleBuffer& rows, const Window& data_window, const Columns& columns, const CleanReport& report);

/// The number in the frame of the first pixel of some of its rows.
std::size_t first_pixel(const Window& rows, const Window& data_window);

}  // namespace rpf
