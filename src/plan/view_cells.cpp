#include "plan/view_cells.h"

#include <algorithm>

namespace rpf {

std::uint64_t cells_of(const kernel::rpf_light_field& field) {
  return std::uint64_t(kernel::rpf_cell_columns(&field)) * std::uint64_t(kernel::rpf_cell_rows(&field));
}

ViewCells::ViewCells(const kernel::rpf_light_field& field)
    : finer_(field.finer),
      margin_(field.margin),
      columns_(kernel::rpf_cell_columns(&field)),
      rows_(kernel::rpf_cell_rows(&field)) {}

std::uint32_t ViewCells::cell_of(const float* place) const {
  const auto finer = static_cast<float>(finer_);
  const float x = place[0] * finer, y = place[1] * finer, margin = static_cast<float>(margin_);
  const auto columns = static_cast<float>(columns_), rows = static_cast<float>(rows_);
  const bool is_inside = x >= -margin && y >= -margin && x < columns - margin && y < rows - margin && place[2] > 0;
  if (!is_inside) return static_cast<std::uint32_t>(columns_) * static_cast<std::uint32_t>(rows_);
  const int column = std::min(kernel::rpf_floor(x) + margin_, columns_ - 1);
  const int row = std::min(kernel::rpf_floor(y) + margin_, rows_ - 1);
  return static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns_) + static_cast<std::uint32_t>(column);
}

void ViewCells::sort(const std::vector<float>& places) {
  const std::size_t samples = places.size() / RPF_PLACE;
  cell_.resize(samples);
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 2, 0);
  for (std::size_t i = 0; i < samples; ++i) ++first_[(cell_[i] = cell_of(places.data() + RPF_PLACE * i)) + 1];
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  samples_.resize(samples);
  places_.resize(places.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < samples; ++i) {
    const std::uint32_t to = next[cell_[i]]++;
    samples_[to] = static_cast<std::uint32_t>(i);
    std::copy_n(places.begin() + static_cast<std::ptrdiff_t>(RPF_PLACE * i), RPF_PLACE,
                places_.begin() + static_cast<std::ptrdiff_t>(RPF_PLACE * std::size_t{to}));
  }
}

}  // namespace rpf
