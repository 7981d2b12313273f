#include "plan/tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "frame/place_of.h"
#include "views.h"

namespace rpf {
namespace {

constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
constexpr const char* axes[] = {"X", "Y", "Z"};

/// Nearer to the ends of the shutter's time no bend can be told from rounding.
constexpr double least_time = 1.0 / 1024;

class Tracks {
 public:
  Tracks(const PreparedFrame& prepared, const std::array<double, 3>& origin) : frame_(prepared.frame), origin_(origin) {
    const Variables& variables = prepared.facts.variables;
    time_ = place_of("time", variables.random_names);
    // Without a time there is no opening either, and nobody reads its column.
    const auto column = [&](const char* group, std::size_t k) {
      const std::string name = std::string(group) + "." + axes[k];
      return variables.features() + place_of(name, variables.feature_names).value_or(0);
    };
    for (std::size_t k = 0; k < 3; ++k) {
      position_[k] = column("P", k);
      opening_[k] = column("opening", k);
      closing_[k] = column("closing", k);
    }
  }

  /// Fills RPF_TRACK floats.
  void track(std::size_t sample, float* to) const {
    std::fill(to, to + RPF_TRACK, 0.0F);
    if (!frame_.weights.empty() && !(frame_.weight(sample) > 0)) {
      to[0] = nowhere;
      return;
    }
    const float* record = frame_.record(sample);
    if (std::any_of(position_.begin(), position_.end(), [&](std::size_t c) { return std::isnan(record[c]); })) {
      std::copy_n(record + Variables::position, 2, to);
      to[9] = 1;
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) move(record, k, to + k);
  }

 private:
  /// (11.1), one coordinate: the parabola through three places, a line where it cannot be told.
  void move(const float* record, std::size_t k, float* to) const {
    const double place = record[position_[k]] - origin_[k];
    to[0] = static_cast<float>(place);
    if (!time_) return;
    const double opening = record[opening_[k]] - origin_[k], closing = record[closing_[k]] - origin_[k];
    const double time = record[Variables::random + *time_], travel = closing - opening;
    if (std::isnan(travel) || std::isnan(time)) return;
    const double around = time * (time - 1), off = place - opening - time * travel;
    const bool bends = -around >= least_time;
    to[0] = static_cast<float>(bends ? opening : place - time * travel);
    to[3] = static_cast<float>(travel);
    to[6] = static_cast<float>(bends ? off / around : 0);
  }

  const Frame& frame_;
  std::array<double, 3> origin_;
  std::array<std::size_t, 3> position_, opening_, closing_;
  std::optional<std::size_t> time_;  ///< among the random parameters
};

}  // namespace

std::array<double, 3> middle_of_positions(const FrameFacts& facts) {
  std::array<double, 3> middle = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::optional<std::size_t> feature = place_of(std::string("P.") + axes[k], facts.variables.feature_names);
    if (feature) middle[k] = facts.feature_spread[*feature].mean;
  }
  return middle;
}

std::vector<float> sample_tracks(const PreparedFrame& prepared, const std::array<double, 3>& origin) {
  const Tracks all(prepared, origin);
  std::vector<float> tracks(prepared.frame.sample_count() * RPF_TRACK);
  for (std::size_t i = 0; i < prepared.frame.sample_count(); ++i) all.track(i, tracks.data() + i * RPF_TRACK);
  return tracks;
}

}  // namespace rpf
