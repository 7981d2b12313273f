// The last step, not in the sources: non-local means over the finished pixels, guided by themselves and by features.
#pragma once

#include <functional>
#include <vector>

#include "frame/frame.h"
#include "plan/plan.h"

namespace rpf {

/// What polish() needs to know beside frame and plan.
struct PolishOptions {
  float floor = 0;  ///< polish_floor() of the frame
  int threads = 1;
  /// Called now and then, from the calling thread, with the number of pixels done since; may throw to stop.
  std::function<void(std::size_t)> done;
};

/// The radiance (in that of `pixels`) below which differences count less and less: 0.05 of the mean over all pixels
/// that have samples and over R, G and B. 0 for a frame that is black or worse. `pixels`: the plain means.
float polish_floor(const Frame& frame, const std::vector<float>& pixels, std::size_t carried);

/// Replaces the pixels of plan.polished by weighted means over the 7x7 pixels around them; all carried channels with
/// the same weights. The weight of pixels p, q is exp(-max(d_color, d_feature, 0)):
///  - d_color: mean of ((a_p - a_q) / ((|a_p| + |a_q|) / 2 + floor))^2 over R, G, B of the 3x3 patches around p and q,
///    over 2 H^2, H = plan.polish. Places where either patch leaves the image or has no samples are left out.
///  - d_feature: largest ((m_p - m_q)^2 - (v_p + v_q)) / (0.001 + v_p + v_q) over the modeled components of N and
///    albedo: m is the mean of the pixel's samples, v the variance of that mean (0 for one sample). A component that
///    all samples of p or of q miss is left out.
/// Pixels without samples take no part and stay. Without plan.polish, or with a floor of 0, nothing changes. The result
/// does not depend on the number of threads. `pixels`: [pixel][carried].
void polish(const Frame& frame, const Plan& plan, const PolishOptions& options, std::vector<float>& pixels);

/// Bytes of its scratch, the second image not counted.
std::uint64_t polish_bytes(const Plan& plan, int threads);

}  // namespace rpf
