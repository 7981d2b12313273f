#include "plan/tables.h"

#include <algorithm>
#include <cmath>

#include "plan/box.h"

namespace rpf {
namespace {

constexpr int offset_entries = 1 << 16;
constexpr int finest_units_per_bit = 1 << 24;

/// Entries of the table that each offset 0 .. reach gets on either side. What rounding leaves over goes to offset 0.
std::vector<int> entries_per_offset(int box_width) {
  const int reach = box_reach(box_width);
  const double sigma = box_sigma(box_width);
  std::vector<double> density(static_cast<std::size_t>(reach) + 1);
  double total = 0;
  for (int d = 0; d <= reach; ++d) {
    density[d] = std::exp(-d * d / (2 * sigma * sigma));
    total += (d == 0 ? 1 : 2) * density[d];
  }
  std::vector<int> entries(density.size());
  int sides = 0;
  for (int d = 1; d <= reach; ++d)
    sides += 2 * (entries[d] = static_cast<int>(std::lround(offset_entries * density[d] / total)));
  entries[0] = offset_entries - sides;
  return entries;
}

}  // namespace

std::vector<std::int8_t> offset_table(int box_width) {
  const std::vector<int> entries = entries_per_offset(box_width);
  const int reach = static_cast<int>(entries.size()) - 1;
  std::vector<std::int8_t> table;
  table.reserve(offset_entries);
  for (int d = -reach; d <= reach; ++d) table.insert(table.end(), entries[std::abs(d)], static_cast<std::int8_t>(d));
  return table;
}

int entropy_slack(int bins) { return (bins * bins + 2 * bins + 2) / 2; }

EntropyTable entropy_table(std::uint32_t max_neighbors, int bins) {
  const double largest_sum = std::max(1.0, max_neighbors * std::log2(bins));
  EntropyTable table;
  table.units_per_bit = finest_units_per_bit;
  while (table.units_per_bit > 1 && table.units_per_bit * largest_sum + entropy_slack(bins) >= 2147483648.0)
    table.units_per_bit /= 2;
  table.units.resize(static_cast<std::size_t>(max_neighbors) + 1, 0);
  for (std::uint32_t n = 2; n <= max_neighbors; ++n) {
    const double units = std::round(table.units_per_bit * (n * std::log2(n)));
    table.units[n] = static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(units)));
  }
  return table;
}

}  // namespace rpf
