// From samples to pixels: the last step of the filter.
#pragma once

#include <array>
#include <vector>

#include "frame/frame.h"
#include "rpf/image.h"

namespace rpf {

/// The mean of every pixel's samples, weighted where the frame has weights: [pixel][carried], 0 where there are no
/// samples. `colors`: [sample][carried], scaled radiance.
std::vector<float> resolve(const Frame& frame, const std::vector<float>& colors, std::size_t carried);

/// The same of the pixels of some rows.
std::vector<float> resolve_rows(const Frame& frame, const std::vector<float>& colors, std::size_t carried,
                                int first_row, int end_row);

/// What each sample counts in the mean of its pixel: its weight; 1 where the frame has none, or none in this pixel.
class PixelWeights {
 public:
  PixelWeights(const Frame& frame, std::size_t pixel);
  double of(std::size_t sample) const { return is_weighted_ ? frame_.weight(sample) : 1; }  ///< a sample of the frame
  double total() const { return total_; }
  /// So many samples of equal weight make a mean as noisy as that of these (Kish 1965).
  double effective_samples() const { return squares_ > 0 ? total_ * total_ / squares_ : 0; }

 private:
  const Frame& frame_;
  bool is_weighted_;
  double total_ = 0, squares_ = 0;  ///< sums of the weights and of their squares
};

/// The mean color of a pixel's samples, from the records, in double: for what is told, not for what is filtered.
std::array<double, 3> mean_color(const Frame& frame, std::size_t pixel);

/// The same of what is carried beside the color too, of a frame of the learned estimator. `mean`: [carried].
void mean_of_pixel(const Frame& frame, std::size_t pixel, std::size_t carried, double* mean);

/// Sum of the components of mean_color() over a region, row by row: the same bits where rows come by and by.
double energy_of_means(const Frame& frame, const Window& region);

}  // namespace rpf
