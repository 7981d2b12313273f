#include "scene/workforce.h"

#include <algorithm>
#include <chrono>

#include "parallel/thread_count.h"
#include "parallel/workers.h"
#include "rpf/error.h"

namespace rpf::scene {
namespace {

constexpr double samples_a_piece = 100000;  // of one thread: about a tenth of a second

class Meter {
 public:
  explicit Meter(const Control& control) : control_(control) {}

  void tell(double fraction) {
    if (!control_.progress) return;
    Progress progress;
    progress.passes = 1;
    progress.fraction = fraction;
    progress.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    progress.seconds_left = progress.seconds * (1 - fraction) / fraction;
    if (!control_.progress(progress)) throw Error(ErrorKind::cancelled, "rendering was cancelled");
  }

 private:
  const Control& control_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

void for_all_pixels(const Work& work, const Control& control, const std::function<void(std::size_t)>& render) {
  const int threads = thread_count(work.threads);
  const double pixels_a_piece = samples_a_piece * threads / std::max(work.samples_per_pixel, 1.0);
  const auto piece =
      std::max<std::size_t>(control.tile_pixels > 0 ? control.tile_pixels : static_cast<std::size_t>(pixels_a_piece),
                            static_cast<std::size_t>(threads));
  Workers workers(threads);
  Meter meter(control);
  for (std::size_t begin = 0; begin < work.pixels; begin += piece) {
    const std::size_t end = std::min(begin + piece, work.pixels);
    workers.for_all(begin, end, [&](std::size_t pixel, std::size_t /*worker*/) { render(pixel); });
    meter.tell(static_cast<double>(end) / static_cast<double>(work.pixels));
  }
}

}  // namespace rpf::scene
