#include "plan/tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "views.h"

namespace rpf {
namespace {

constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
constexpr const char* axes[] = {"X", "Y", "Z"};

/// Nearer to the ends of the shutter's time no bend can be told from rounding.
constexpr double least_time = 1.0 / 1024;

/// The variable of that name; the count of all where there is none.
std::size_t find(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

class Tracks {
 public:
  Tracks(const PreparedFrame& prepared, const std::array<double, 3>& origin) : frame_(prepared.frame), origin_(origin) {
    const Variables& variables = prepared.facts.variables;
    const auto column = [&](const std::string& name) {
      return variables.features() + find(variables.feature_names, name);
    };
    for (std::size_t k = 0; k < 3; ++k) {
      position_[k] = column(std::string("P.") + axes[k]);
      opening_[k] = column(std::string("opening.") + axes[k]);
      closing_[k] = column(std::string("closing.") + axes[k]);
    }
    time_ = find(variables.random_names, "time") + Variables::random;
    moves_ = time_ < variables.features();
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
    if (!moves_) return;
    const double opening = record[opening_[k]] - origin_[k], closing = record[closing_[k]] - origin_[k];
    const double time = record[time_], travel = closing - opening;
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
  std::size_t time_ = 0;
  bool moves_ = false;
};

}  // namespace

std::array<double, 3> middle_of_positions(const FrameFacts& facts) {
  std::array<double, 3> middle = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t feature = find(facts.variables.feature_names, std::string("P.") + axes[k]);
    if (feature < facts.feature_spread.size()) middle[k] = facts.feature_spread[feature].mean;
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
