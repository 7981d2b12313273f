// What the numbers of Settings can be: one place for the library's checks and the command's.
#pragma once

#include <string>

namespace rpf {

/// The numbers that an option takes.
struct NumberRange {
  double least = 0, most = 0;
  const char* example = "";
  bool whole = false, odd = false;
  bool or_zero = false;  ///< 0 is possible beside the range

  /// False for NaN too.
  bool has(double value) const;
  /// "a whole number from 1 to 16 is expected, such as 4".
  std::string expected() const;
};

namespace ranges {
constexpr NumberRange factor{1e-9, 1e6, "2"};  ///< samples_factor
constexpr NumberRange box_width{1, 255, "17", true, true};
constexpr NumberRange noise{1e-12, 1e12, "0.02"};
constexpr NumberRange bins{3, 31, "7", true, true};
constexpr NumberRange alpha_factor{0, 1e6, "2"};
constexpr NumberRange position_scale{1e-6, 1e6, "20"};
constexpr NumberRange redraws{0, 15, "8", true};
constexpr NumberRange sigma_color{1e-30, 1e30, "30"};
constexpr NumberRange sigma_feature{1e-6, 1e6, "0.5"};
constexpr NumberRange damping{1e-3, 1e3, "0.45"};
constexpr NumberRange gamma{0.01, 0.5, "0.2"};
constexpr NumberRange views{1, 65536, "128", true};
constexpr NumberRange bandwidth{1e-3, 1e3, "2"};
constexpr NumberRange count{1, 4294967295.0, "1000", true};  ///< of samples: max_samples
constexpr NumberRange threads{1, 4096, "8", true};
}  // namespace ranges

}  // namespace rpf
