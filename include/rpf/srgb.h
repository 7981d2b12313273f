// The sRGB transfer function (IEC 61966-2-1) in closed form.
#pragma once

namespace rpf {

/// Linear light to sRGB, 1 is white; not clamped, and odd in its argument, so that negative light stays defined.
double srgb_encode(double linear);
/// The inverse of srgb_encode.
double srgb_decode(double encoded);

}  // namespace rpf
