// Separable convolution, for the metrics that look at neighborhoods.
#pragma once

#include "metrics/planes.h"

namespace rpf::metrics {

/// Weights of the offsets -radius ... +radius; an odd number of them.
using Weights = std::vector<double>;

/// exp(-x^2 / (2 sigma^2)) at whole offsets, not normalized.
Weights gaussian(double sigma, int radius);
double sum(const Weights& weights);
Weights scaled(Weights weights, double factor);

/// Sum over dx, dy of along_x[dx] * along_y[dy] * plane(x + dx, y + dy). Beyond its border a plane repeats its last
/// pixels.
Plane convolve(const Plane& plane, const Weights& along_x, const Weights& along_y);

}  // namespace rpf::metrics
