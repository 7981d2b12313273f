#include "plan/sequence.h"

#include <cmath>

namespace rpf {

std::array<double, 5> place_in_sequence(int n) {
  constexpr double root = 1.1347241384015194;  // of x^6 = x + 1
  std::array<double, 5> place;
  double step = 1;
  for (double& value : place) {
    step /= root;
    value = 0.5 + (n + 1) * step;
    value -= std::floor(value);
  }
  return place;
}

}  // namespace rpf
