// The plan: settings and frame turned into plain data. Backends read it and decide nothing themselves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frame/facts.h"
#include "plan/neighborhood_size.h"
#include "plan/tables.h"
#include "rpf/image.h"
#include "rpf/settings.h"

namespace rpf {

/// One axis of the space in which a method with fixed weights measures distances: w = exp(-sum of (scale *
/// difference)^2).
struct Coordinate {
  std::uint32_t variable = 0;
  float scale = 0;  ///< 1 / (sqrt(2) sigma), sigma in the variable's unit (colors: scaled radiance)
};

struct PassPlan {
  int box_width = 1;
  float growth = 1;  ///< 1 + 0.1 t of (T 5.9)
  NeighborhoodSize neighborhood;
  std::uint32_t max_neighbors = 0;   ///< no N of this pass is larger
  std::vector<std::int8_t> offsets;  ///< offset_table(box_width)
  EntropyTable entropy;
  float nats_per_unit = 0;  ///< ln 2 / entropy.units_per_bit
  // Of a method with fixed weights, which needs box_width and max_neighbors of the others.
  std::vector<Coordinate> coordinates;
  std::uint64_t fixed_weights = 0;  ///< of a pixel at most: own samples of a group times neighbors
  Window region;  ///< pixels to filter in this pass, frame coordinates (the crop and what later passes need around it)
};

struct Plan {
  Method method = Method::rpf;
  int width = 0, height = 0;  ///< of the frame; pixel = y * width + x
  Variables variables;
  std::vector<float> centers;            ///< [variable] what a missing value counts as; empty: rpf
  std::vector<float> rejection_factor;   ///< [feature] H
  std::vector<float> minimum_tolerance;  ///< [feature] a; infinity: takes no part in the rejection test
  std::size_t rejecting = 0;             ///< features up to the last one that takes part in the rejection test
  std::uint32_t most_samples = 1;        ///< of a pixel
  std::size_t carried = 3;  ///< values a sample that are averaged: color, then alpha and features on request

  std::uint32_t seed = 1;
  std::uint32_t attempts = 9;  ///< of a draw: 1 + redraws
  int half_bins = 3;           ///< K
  int entropy_slack = 0;
  float information_bias = 0;  ///< times 1/N, subtracted from every mutual information
  float alpha_factor = 2;
  float noise = 0.02F;
  bool explain = false;  ///< backends keep explained()
  bool outlier_step = false;
  std::vector<PassPlan> passes;
};

/// Pairs of variables whose mutual information section 5 measures.
std::size_t pair_count(const Variables& variables);

/// Throws Error(usage) as validate() does, Error(input) for more samples in a pixel than most_neighbors.
Plan make_plan(const FrameFacts& facts, const Settings& settings);

}  // namespace rpf
