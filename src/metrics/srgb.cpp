#include "rpf/srgb.h"

#include <cmath>

namespace rpf {

double srgb_encode(double linear) {
  if (linear < 0) return -srgb_encode(-linear);
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  if (encoded < 0) return -srgb_decode(-encoded);
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace rpf
