// The samples of a view by where they stand: so that who looks for those around a place asks few.
#pragma once

#include <cstdint>
#include <vector>

#include "views.h"

namespace rpf {

/// How many cells a frame has.
std::uint64_t cells_of(const kernel::rpf_light_field& field);

class ViewCells {
 public:
  explicit ViewCells(const kernel::rpf_light_field& field);

  /// Of places [sample][RPF_PLACE]; those behind the camera, and those outside the film and its margin, are left out.
  void sort(const std::vector<float>& places);

  const std::vector<std::uint32_t>& first() const { return first_; }      ///< [cell + 1], row by row
  const std::vector<float>& places() const { return places_; }            ///< [sample by cell][RPF_PLACE]
  const std::vector<std::uint32_t>& samples() const { return samples_; }  ///< [sample by cell] its number

 private:
  /// The number of cells where it stands in none.
  std::uint32_t cell_of(const float* place) const;

  int finer_, margin_, columns_, rows_;
  std::vector<std::uint32_t> cell_;  ///< [sample]
  std::vector<std::uint32_t> first_, samples_;
  std::vector<float> places_;
};

}  // namespace rpf
