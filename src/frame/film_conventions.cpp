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

class FilmCheck {
 public:
  explicit FilmCheck(const SampleBuffer& samples)
      : window_(samples.data_window), is_half_(samples.is_half("film.X") || samples.is_half("film.Y")) {}

  /// `at` in the pixel whose corner is `pixel`, in the coordinates of the data window.
  void add(std::size_t number, Place pixel, Place at) {
    if (is_in(pixel, at)) return;
    outside.add(number);
    const Place of_window{at.x * window_.width, at.y * window_.height};
    const Place inside{pixel.x - window_.x, pixel.y - window_.y};
    normalized_.agreeing += is_in(inside, of_window) || is_in(pixel, of_window);
    subpixel_.agreeing += is_in({0, 0}, at);
    centered_.agreeing += is_in({-0.5, -0.5}, at);
    flipped_.agreeing += is_in(pixel, {at.x, 2.0 * window_.y + window_.height - at.y});
    exchanged_.agreeing += is_in(pixel, {at.y, at.x});
    const Place move{std::floor(at.x) - pixel.x, std::floor(at.y) - pixel.y};
    if (outside.count == 1) move_ = move;
    moved_.agreeing += move.x == move_.x && move.y == move_.y;
  }

  std::string text() const {
    return "film positions outside their pixel" +
           advice_of({normalized_, subpixel_, centered_, flipped_, exchanged_, moved_}, outside.count,
                     "; write the pixel's x and y plus the place inside it, 0 to 1");
  }

  Tally outside;

 private:
  bool is_in(Place pixel, Place at) const {
    const double dx = slack(pixel.x, is_half_), dy = slack(pixel.y, is_half_);
    return at.x >= pixel.x - dx && at.x <= pixel.x + 1 + dx && at.y >= pixel.y - dy && at.y <= pixel.y + 1 + dy;
  }

  Window window_;
  bool is_half_;
  Place move_;
  Guess normalized_{"which look like parts of the frame, 0 to 1; multiply by its width and height"};
  Guess subpixel_{"which look like places inside the pixel, 0 to 1; add the pixel's x and y"};
  Guess centered_{"which look like distances from the pixel's center; add its x + 0.5 and y + 0.5"};
  Guess flipped_{"which look counted from the bottom; count y from the top"};
  Guess exchanged_{"which look as if X and Y were exchanged; exchange them"};
  Guess moved_{"which all lie equally far away; write them in the coordinates of the data window"};
};

}  // namespace

void check_film(const SampleBuffer& samples, std::vector<InputNote>& notes) {
  const std::size_t x = *samples.layout.find("film.X"), y = *samples.layout.find("film.Y");
  const Window& w = samples.data_window;
  FilmCheck check(samples);
  for (std::size_t pixel = 0; pixel < w.pixel_count(); ++pixel) {
    const Place corner{static_cast<double>(w.x + static_cast<int>(pixel % static_cast<std::size_t>(w.width))),
                       static_cast<double>(w.y + static_cast<int>(pixel / static_cast<std::size_t>(w.width)))};
    for (std::uint32_t i = samples.first_sample[pixel]; i < samples.first_sample[pixel + 1]; ++i) {
      const float* record = samples.record(i);
      if (std::isfinite(record[x]) && std::isfinite(record[y])) check.add(pixel, corner, {record[x], record[y]});
    }
  }
  check.outside.tell(check.text(), w, notes);
}

}  // namespace rpf
