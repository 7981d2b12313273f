#include "run/information.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "rpf_math.h"
#include "run/backends.h"
#include "seam/backend.h"

namespace rpf {
namespace {

/// The measured pixels lie on a grid of at most so many, this far apart at least: neighborhoods that share samples
/// would be no further evidence.
constexpr int grid_across = 20, grid_down = 14, grid_spacing = 8;
/// Dependence is local: a box of this width and M = 4 b^2, whatever the passes' are.
constexpr int measured_box = 11;
constexpr double measured_factor = 4;
/// Fewer different samples than this fill too few of the histogram's cells.
constexpr std::size_t least_samples = 40;
/// A trace has all weights of a pixel: of more own samples it would take gigabytes and minutes.
constexpr std::uint32_t most_own_samples = 4096;
constexpr int bins = 7, half_bins = 3;

// When excess is more than chance. Measured: independent numbers and channels of real frames, docs/deviations.md.
constexpr std::size_t least_pixels = 32;  ///< fewer prove nothing
constexpr double least_mean = 5;          ///< standard errors that the mean is above 0
constexpr double least_peak = 4;          ///< standard deviations that the mean of the largest is above 0
constexpr std::size_t peak_share = 20, least_in_peak = 4;  ///< the largest: one in 20, at least 4

/// The identity and two shuffles.
constexpr std::size_t orders = 3;

/// No rejection: a useless feature would leave too few neighbors to notice that it is useless.
Plan measuring_plan(const FrameFacts& facts) {
  Settings settings;
  settings.box_widths = {measured_box};
  settings.samples_factor = measured_factor;
  settings.bins = bins;
  Plan plan = make_plan(facts, settings);
  std::fill(plan.minimum_tolerance.begin(), plan.minimum_tolerance.end(), std::numeric_limits<float>::infinity());
  plan.rejecting = 0;
  return plan;
}

std::vector<std::uint32_t> grid(int width, int height) {
  const int across = std::clamp(width / grid_spacing, 1, grid_across);
  const int down = std::clamp(height / grid_spacing, 1, grid_down);
  std::vector<std::uint32_t> pixels;
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i) {
      const std::int64_t x = (std::int64_t{2} * i + 1) * width / (2 * across);
      const std::int64_t y = (std::int64_t{2} * j + 1) * height / (2 * down);
      pixels.push_back(static_cast<std::uint32_t>(y * width + x));
    }
  return pixels;
}

using Column = std::vector<std::uint8_t>;  ///< [sample] bin

/// The different samples around a pixel: draws repeat some, which says nothing new.
std::vector<Column> columns_of(const PixelTrace& trace, std::size_t variables) {
  std::vector<std::size_t> rows(trace.neighbors.size());
  std::iota(rows.begin(), rows.end(), 0);
  const auto sample = [&](std::size_t row) { return trace.neighbors[row]; };
  std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return sample(a) < sample(b); });
  const auto same = [&](std::size_t a, std::size_t b) { return sample(a) == sample(b); };
  rows.erase(std::unique(rows.begin(), rows.end(), same), rows.end());
  std::vector<Column> columns(variables);
  for (std::size_t v = 0; v < variables; ++v)
    for (const std::size_t row : rows)
      columns[v].push_back(
          static_cast<std::uint8_t>(kernel::rpf_bin(trace.normalized[row * variables + v], half_bins)));
  return columns;
}

/// Where each sample goes: nowhere in the first order, anywhere in the others.
std::array<std::vector<std::uint32_t>, orders> orders_of(std::size_t samples, std::uint32_t pixel) {
  std::array<std::vector<std::uint32_t>, orders> result;
  std::mt19937 random(pixel);
  for (std::size_t k = 0; k < orders; ++k) {
    result[k].resize(samples);
    std::iota(result[k].begin(), result[k].end(), 0);
    for (std::size_t i = samples; k > 0 && i > 1; --i) std::swap(result[k][i - 1], result[k][random() % i]);
  }
  return result;
}

/// n ln n, [n].
std::vector<double> entropy_terms(std::size_t samples) {
  std::vector<double> terms(samples + 1, 0.0);
  for (std::size_t n = 2; n <= samples; ++n) terms[n] = static_cast<double>(n) * std::log(static_cast<double>(n));
  return terms;
}

/// Readings of pairs at one pixel. What only depends on one of the two cancels out between orders and is left out.
class Readings {
 public:
  Readings(std::vector<Column> columns, std::uint32_t pixel, const std::vector<double>& terms)
      : columns_(std::move(columns)), orders_(orders_of(columns_[0].size(), pixel)), terms_(terms) {}

  /// Of a channel and the partners from `first` to before `last`.
  void add(std::size_t channel, std::size_t first, std::size_t last, Evidence& evidence) const {
    std::array<double, orders> reading{};
    Column shuffled(columns_[channel].size());
    for (std::size_t k = 0; k < orders; ++k) {
      for (std::size_t i = 0; i < shuffled.size(); ++i) shuffled[i] = columns_[channel][orders_[k][i]];
      for (std::size_t partner = first; partner < last; ++partner)
        reading[k] += 2 * joint_terms(shuffled, columns_[partner]);
    }
    if (reading[0] == reading[1] && reading[1] == reading[2]) return;  // one of the two does not vary here
    evidence.excess.push_back(reading[0] - reading[1]);
    evidence.chance.push_back(reading[2] - reading[1]);
  }

 private:
  double joint_terms(const Column& a, const Column& b) const {
    std::array<std::uint32_t, bins * bins> histogram{};
    for (std::size_t i = 0; i < a.size(); ++i) ++histogram[std::size_t{a[i]} * bins + b[i]];
    double sum = 0;
    for (const std::uint32_t count : histogram) sum += terms_[count];
    return sum;
  }

  std::vector<Column> columns_;
  std::array<std::vector<std::uint32_t>, orders> orders_;
  const std::vector<double>& terms_;
};

std::vector<ChannelEvidence> channels_of(const Variables& variables) {
  std::vector<ChannelEvidence> channels;
  for (const auto* names : {&variables.random_names, &variables.feature_names})
    for (const std::string& name : *names) channels.push_back({name, {}, {}});
  return channels;
}

/// Of every channel at one pixel.
void add_readings(const Variables& variables, const Readings& readings, std::vector<ChannelEvidence>& channels) {
  for (std::size_t v = Variables::random; v < variables.count(); ++v) {
    ChannelEvidence& channel = channels[v - Variables::random];
    readings.add(v, Variables::color, Variables::position, channel.color);
    if (v < variables.features()) readings.add(v, variables.features(), variables.count(), channel.features);
  }
}

}  // namespace

bool Evidence::is_enough() const { return excess.size() >= least_pixels; }

bool Evidence::is_information() const {
  if (!is_enough()) return false;
  const auto pixels = static_cast<double>(excess.size());
  const double deviation = std::sqrt(std::inner_product(chance.begin(), chance.end(), chance.begin(), 0.0) / pixels);
  const double mean = std::accumulate(excess.begin(), excess.end(), 0.0) / pixels;
  std::vector<double> largest = excess;
  std::sort(largest.begin(), largest.end(), std::greater<>());
  largest.resize(std::max(excess.size() / peak_share, least_in_peak));
  const double peak = std::accumulate(largest.begin(), largest.end(), 0.0) / static_cast<double>(largest.size());
  return mean > least_mean * deviation / std::sqrt(pixels) || peak > least_peak * deviation;
}

std::vector<ChannelEvidence> measure_information(PreparedFrame& prepared, const Settings& settings) {
  const Plan plan = measuring_plan(prepared.facts);
  std::vector<ChannelEvidence> channels = channels_of(plan.variables);
  Settings reference;
  reference.threads = settings.threads;
  const auto backend = make_backend(reference);
  backend->load(prepared.frame, std::move(prepared.colors), plan);
  const std::vector<double> terms = entropy_terms(plan.passes[0].max_neighbors);
  for (const std::uint32_t pixel : grid(plan.width, plan.height)) {
    if (prepared.frame.samples(pixel) > most_own_samples) continue;
    std::vector<Column> columns = columns_of(backend->trace(0, pixel), plan.variables.count());
    if (columns[0].size() >= least_samples)
      add_readings(plan.variables, Readings(std::move(columns), pixel, terms), channels);
  }
  prepared.colors = backend->take_colors();
  return channels;
}

}  // namespace rpf
