// The methods with fixed weights (section 8): the neighbors of a pixel are all samples in its box.
#pragma once

#include "cpu/neighborhood.h"
#include "cpu/weighting.h"

namespace rpf {

/// Fills n.neighbors for a pixel: its own samples, then the others of the box row by row.
void gather_box(const Frame& frame, const Plan& plan, int pass, std::uint32_t pixel, Neighborhood& n);

/// Filters the own samples of that pixel; arguments as of filter_samples().
void filter_box(const Frame& frame, const Plan& plan, int pass, const Neighborhood& n, std::uint32_t own,
                const std::vector<float>& colors, FilterScratch& scratch, float* out, std::vector<float>* weights_out);

}  // namespace rpf
