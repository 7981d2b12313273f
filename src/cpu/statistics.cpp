#include "cpu/statistics.h"

#include <algorithm>

#include "parallel/workers.h"
#include "rpf_math.h"

namespace rpf {
namespace {

/// Adds all rows to the sums; missing values count as nothing. Also the largest magnitudes.
void sum_rows(const Neighborhood& n, Normalization& out) {
  const std::size_t variables = n.shift.size();
  out.sums.clear(variables);
  out.count.assign(variables, 0);
  out.largest.assign(variables, 0.0F);
  for (std::uint32_t j = 0; j < n.size(); ++j) {
    const float* row = n.rows.data() + j * variables;
    float* lane = out.sums.lane(j);
    for (std::size_t v = 0; v < variables; ++v) {
      const bool missing = kernel::rpf_is_missing(row[v]);
      lane[v] += missing ? 0.0F : row[v];
      out.count[v] += missing ? 0 : 1;
      const float magnitude = kernel::fabs(row[v] + n.shift[v]);
      out.largest[v] = magnitude > out.largest[v] ? magnitude : out.largest[v];
    }
  }
}

void sum_squares(const Neighborhood& n, Normalization& out) {
  const std::size_t variables = n.shift.size();
  out.sums.clear(variables);
  for (std::uint32_t j = 0; j < n.size(); ++j) {
    const float* row = n.rows.data() + j * variables;
    float* lane = out.sums.lane(j);
    for (std::size_t v = 0; v < variables; ++v) {
      const float off = row[v] - out.mean[v];
      lane[v] += kernel::rpf_is_missing(off) ? 0.0F : off * off;
    }
  }
}

/// The pairs' order in one place: calls body(x, y_begin, y_end) for every variable x and the range of its partners.
template <typename Body>
void for_each_partner_range(const Variables& variables, Body body) {
  for (std::size_t x = Variables::color; x < Variables::position; ++x) body(x, Variables::position, variables.count());
  for (std::size_t x = variables.features(); x < variables.count(); ++x)
    body(x, Variables::position, variables.features());
}

void fill_bins(const Plan& plan, const Neighborhood& n, Dependencies& out) {
  const std::size_t variables = plan.variables.count(), bins = 2 * static_cast<std::size_t>(plan.half_bins) + 1;
  out.bins.resize(n.size() * variables);
  out.marginals.assign(variables * bins, 0);
  for (std::uint32_t j = 0; j < n.size(); ++j)
    for (std::size_t v = 0; v < variables; ++v) {
      const int bin = kernel::rpf_bin(n.rows[j * variables + v], plan.half_bins);
      out.bins[j * variables + v] = static_cast<std::uint8_t>(bin);
      ++out.marginals[v * bins + static_cast<std::size_t>(bin)];
    }
}

/// Row by row: all pairs of one neighbor before the next.
void fill_histograms(const Plan& plan, std::uint32_t neighbors, Dependencies& out) {
  const std::size_t variables = plan.variables.count(), bins = 2 * static_cast<std::size_t>(plan.half_bins) + 1;
  out.histograms.assign(pair_count(plan.variables) * bins * bins, 0);
  constexpr std::uint32_t rows_at_once = 4096;
  for (std::uint32_t j = 0; j < neighbors && (j % rows_at_once != 0 || !must_stop()); ++j) {
    const std::uint8_t* row = out.bins.data() + j * variables;
    std::uint32_t* histogram = out.histograms.data();
    for_each_partner_range(plan.variables, [&](std::size_t x, std::size_t y_begin, std::size_t y_end) {
      const std::size_t line = row[x] * bins;
      for (std::size_t y = y_begin; y < y_end; ++y, histogram += bins * bins) ++histogram[line + row[y]];
    });
  }
}

/// Sum of S h log2 h over `cells` counts, modulo 2^32.
std::uint32_t entropy_units(const EntropyTable& table, const std::uint32_t* counts, std::size_t cells) {
  std::uint32_t units = 0;
  for (std::size_t i = 0; i < cells; ++i) units += static_cast<std::uint32_t>(table.units[counts[i]]);
  return units;
}

}  // namespace

void normalize(Neighborhood& n, Normalization& out) {
  const std::size_t variables = n.shift.size();
  out.mean.assign(variables, 0.0F);
  out.inverse_deviation.assign(variables, 0.0F);
  sum_rows(n, out);
  for (std::size_t v = 0; v < variables; ++v)
    if (out.count[v] > 0) out.mean[v] = out.sums.total(v) / static_cast<float>(out.count[v]);
  sum_squares(n, out);
  for (std::size_t v = 0; v < variables; ++v)
    if (out.count[v] > 0)
      out.inverse_deviation[v] =
          kernel::rpf_inverse_deviation(out.sums.total(v) / static_cast<float>(out.count[v]), out.largest[v]);
  for (std::uint32_t j = 0; j < n.size(); ++j) {
    float* row = n.rows.data() + j * variables;
    for (std::size_t v = 0; v < variables; ++v)
      row[v] = kernel::rpf_or_zero(kernel::rpf_normalize(row[v], out.mean[v], out.inverse_deviation[v]));
  }
}

void measure_dependencies(const Plan& plan, int pass, const Neighborhood& n, Dependencies& out) {
  const PassPlan& p = plan.passes[static_cast<std::size_t>(pass)];
  const std::size_t variables = plan.variables.count(), bins = 2 * static_cast<std::size_t>(plan.half_bins) + 1;
  fill_bins(plan, n, out);
  fill_histograms(plan, n.size(), out);
  std::vector<std::uint32_t> marginal_units(variables);
  for (std::size_t v = 0; v < variables; ++v)
    marginal_units[v] = entropy_units(p.entropy, &out.marginals[v * bins], bins);
  const auto all = static_cast<std::uint32_t>(p.entropy.units[n.size()]);
  const auto neighbors = static_cast<float>(n.size());
  out.information.clear();
  const std::uint32_t* histogram = out.histograms.data();
  for_each_partner_range(plan.variables, [&](std::size_t x, std::size_t y_begin, std::size_t y_end) {
    for (std::size_t y = y_begin; y < y_end; ++y, histogram += bins * bins) {
      const auto units = static_cast<int>(entropy_units(p.entropy, histogram, bins * bins) - marginal_units[x] -
                                          marginal_units[y] + all);
      out.information.push_back(
          kernel::rpf_mutual_information(units, plan.entropy_slack, p.nats_per_unit, plan.information_bias, neighbors));
    }
  });
}

void compute_weights(const Plan& plan, int pass, const Dependencies& dependencies, FilterWeights& out) {
  const std::size_t random = plan.variables.random_names.size(), features = plan.variables.feature_names.size();
  out.feature_fraction_random.resize(features);
  out.fraction_feature.resize(features);
  out.beta.resize(features);
  kernel::rpf_weigh_dependencies(dependencies.information.data(), static_cast<kernel::uint>(random),
                                 static_cast<kernel::uint>(features), plan.alpha_factor,
                                 plan.passes[static_cast<std::size_t>(pass)].growth, &out.color,
                                 {out.feature_fraction_random.data(), out.fraction_feature.data(), out.beta.data()});
}

}  // namespace rpf
