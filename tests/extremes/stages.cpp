#include "stages.h"

#include <algorithm>
#include <cmath>

#include "run/driver.h"

namespace rpf::test {

std::vector<Stages> stages_of(const SampleBuffer& samples, const Settings& settings,
                              const std::vector<std::uint32_t>& pixels) {
  std::vector<Stages> result;
  const PreparedFrame prepared = prepare(samples, settings);
  run_filter(samples, settings, {}, [&](Backend& backend, const Plan& plan, int pass) {
    for (const std::uint32_t pixel : pixels) {
      if (pass > 0 || prepared.frame.samples(pixel) == 0) continue;
      Stages s{backend.trace(pass, pixel), plan, {}, prepared.facts.radiance_scale};
      s.values.resize(plan.variables.count());
      for (const std::uint32_t neighbor : s.trace.neighbors)
        for (std::size_t v = 0; v < s.values.size(); ++v) s.values[v].push_back(prepared.frame.record(neighbor)[v]);
      result.push_back(std::move(s));
    }
  });
  return result;
}

Moments moments_of(const std::vector<double>& values) {
  Moments m;
  double sum = 0, squares = 0, count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value - values.front();
    count += 1;
    m.largest = std::max(m.largest, std::fabs(value));
  }
  const double shifted = count > 0 ? sum / count : 0;
  for (const double value : values)
    if (!std::isnan(value)) squares += std::pow(value - values.front() - shifted, 2);
  m.mean = values.front() + shifted;
  m.deviation = count > 0 ? std::sqrt(squares / count) : 0;
  return m;
}

double information_of(const std::vector<std::uint32_t>& histogram, std::size_t first, std::size_t bins) {
  std::vector<double> row(bins), column(bins);
  double n = 0, information = 0;
  for (std::size_t i = 0; i < bins * bins; ++i) {
    row[i / bins] += histogram[first + i];
    column[i % bins] += histogram[first + i];
    n += histogram[first + i];
  }
  for (std::size_t i = 0; i < bins * bins; ++i) {
    const double h = histogram[first + i];
    if (h > 0) information += h / n * std::log(h * n / (row[i / bins] * column[i % bins]));
  }
  return std::max(information, 0.0);
}

}  // namespace rpf::test
