#include "rpf/rows.h"

namespace rpf {

std::uint64_t SampleRows::sample_count(int first, int end) const {
  std::uint64_t samples = 0;
  for (int row = first; row < end; ++row) samples += row_samples(row);
  return samples;
}

std::uint64_t SampleRows::sample_count() const { return sample_count(0, frame().data_window.height); }

std::uint64_t SampleRows::row_bytes(int row) const {
  return row_samples(row) * (frame().layout.size() + spare_columns) * sizeof(float);
}

int SampleRows::end_within(int first, std::uint64_t bytes) const {
  const int height = frame().data_window.height;
  std::uint64_t taken = row_bytes(first);
  int end = first + 1;
  while (end < height && taken + row_bytes(end) <= bytes) taken += row_bytes(end++);
  return end;
}

}  // namespace rpf
