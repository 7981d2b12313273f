// Positions on the film that are not in their pixel, and what they look like instead.
#include <algorithm>
#include <cmath>

#include "frame/conventions.h"
#include "frame/tally.h"

namespace rpf {
namespace {

struct Place {
  double x = 0, y = 0;
};

/// Rounding may carry a position over the border of its pixel; half holds 11 bits.
double slack(double at, bool is_half) { return 1e-3 + std::fabs(at) * (is_half ? 1.0 / 1024 : 1.0 / (1 << 22)); }

class FilmCheck : public SampleCheck {
 public:
  explicit FilmCheck(const SampleBuffer& samples)
      : window_(samples.data_window),
        columns_{*samples.layout.find("film.X"), *samples.layout.find("film.Y")},
        is_half_(samples.is_half("film.X") || samples.is_half("film.Y")) {
    enter(0);
  }

  void look(const ColumnBlock& records, const PixelCorners& corners, BlockMask& odd) const override {
    mark_outside_pixels(records[columns_[0]], corners.x, odd);
    mark_outside_pixels(records[columns_[1]], corners.y, odd);
  }

  void add(const float* record, std::size_t pixel) override {
    const Place at{record[columns_[0]], record[columns_[1]]};
    if (pixel != pixel_) enter(pixel);
    if (is_in(corner_, at) || !std::isfinite(at.x) || !std::isfinite(at.y)) return;
    outside_.add(pixel);
    guess(at);
  }

  void tell(const Window& data_window, std::vector<InputNote>& notes) const override {
    outside_.tell("film positions outside their pixel" +
                      advice_of({normalized_, subpixel_, centered_, flipped_, exchanged_, moved_}, outside_.count,
                                "; write the pixel's x and y plus the place inside it, 0 to 1"),
                  data_window, notes);
  }

 private:
  /// Without the slack, which floats would not hold.
  static void mark_outside_pixels(const float* values, const float (&corners)[block_records], BlockMask& odd) {
    for (std::size_t i = 0; i < block_records; ++i)
      odd[i] |=
          static_cast<std::int32_t>(values[i] < corners[i]) | static_cast<std::int32_t>(values[i] > corners[i] + 1);
  }

  void enter(std::size_t pixel) {
    const auto width = static_cast<std::size_t>(window_.width);
    pixel_ = pixel;
    corner_ = {static_cast<double>(window_.x) + static_cast<double>(pixel % width),
               static_cast<double>(window_.y) + static_cast<double>(pixel / width)};
    slack_ = std::max(slack(corner_.x, is_half_), slack(corner_.y, is_half_));
  }

  bool is_in(Place pixel, Place at) const {
    return at.x >= pixel.x - slack_ && at.x <= pixel.x + 1 + slack_ && at.y >= pixel.y - slack_ &&
           at.y <= pixel.y + 1 + slack_;
  }

  /// What a position outside its pixel would be right in.
  void guess(Place at) {
    const Place of_window{at.x * window_.width, at.y * window_.height};
    const Place inside{corner_.x - window_.x, corner_.y - window_.y};
    normalized_.agreeing += is_in(inside, of_window) || is_in(corner_, of_window) ? 1 : 0;
    subpixel_.agreeing += is_in({0, 0}, at) ? 1 : 0;
    centered_.agreeing += is_in({-0.5, -0.5}, at) ? 1 : 0;
    flipped_.agreeing += is_in(corner_, {at.x, 2.0 * window_.y + window_.height - at.y}) ? 1 : 0;
    exchanged_.agreeing += is_in(corner_, {at.y, at.x}) ? 1 : 0;
    const Place move{std::floor(at.x) - corner_.x, std::floor(at.y) - corner_.y};
    if (outside_.count == 1) move_ = move;
    moved_.agreeing += outside_.count > 1 && is_in({corner_.x + move_.x, corner_.y + move_.y}, at) ? 1 : 0;
  }

  Window window_;
  std::size_t columns_[2];
  bool is_half_;
  std::size_t pixel_ = 0;
  Place corner_;  ///< of that pixel, in the coordinates of the data window
  double slack_ = 0;
  Tally outside_;
  Place move_;  ///< of the first position outside, in pixels
  Guess normalized_{"which look like parts of the frame, 0 to 1; multiply by its width and height"};
  Guess subpixel_{"which look like places inside the pixel, 0 to 1; add the pixel's x and y"};
  Guess centered_{"which look like distances from the pixel's center; add its x + 0.5 and y + 0.5"};
  Guess flipped_{"which look counted from the bottom; count y from the top"};
  Guess exchanged_{"which look as if X and Y were exchanged; exchange them"};
  Guess moved_{"which all lie equally far away; write them in the coordinates of the data window"};
};

}  // namespace

void add_film_check(const SampleBuffer& samples, ConventionChecks& checks) {
  checks.of_samples.push_back(std::make_unique<FilmCheck>(samples));
}

}  // namespace rpf
