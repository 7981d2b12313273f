// The plan: settings and frame turned into plain data. Backends read it and decide nothing themselves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plan/tables.h"
#include "rpf/filter.h"
#include "rpf/settings.h"

namespace rpf {

/// The largest M and the largest number of samples a pixel: counters, tables and float counts stay exact below it.
constexpr std::uint32_t most_neighbors = 1U << 24;

/// How many samples a neighborhood asks for: M of algorithm.md, section 3.
struct NeighborhoodSize {
  std::uint32_t box_area = 1;       ///< b^2
  bool grows_with_samples = false;  ///< M = b^2 s / 2 (paper) instead of `fixed`
  std::uint32_t fixed = 0;          ///< M otherwise
  std::uint32_t limit = most_neighbors;

  std::uint32_t size(std::uint32_t samples) const;
  /// Candidates to draw for a pixel with so many samples of its own: M - s, not below 0.
  std::uint32_t draws(std::uint32_t samples) const;
};

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
  std::uint32_t max_neighbors = 0;        ///< no N of this pass is larger
  std::uint32_t enough = most_neighbors;  ///< drawing ends once there are so many neighbors, own samples included
  std::vector<std::int8_t> offsets;       ///< offset_table(box_width)
  EntropyTable entropy;
  float nats_per_unit = 0;  ///< ln 2 / entropy.units_per_bit
  // Of a method with fixed weights, which needs box_width and max_neighbors of the others.
  std::vector<Coordinate> coordinates;
  std::uint64_t fixed_weights = 0;  ///< of a pixel at most: own samples times neighbors
  Window region;  ///< pixels to filter in this pass, frame coordinates (the crop and what later passes need around it)
};

/// The variables of a record, in this order: color 3, position 2, random parameters, features.
struct Variables {
  static constexpr std::size_t color = 0, position = 3, random = 5;
  std::vector<std::string> random_names, feature_names;  ///< "lens.U", "N.X"

  std::size_t features() const { return random + random_names.size(); }
  std::size_t count() const { return features() + feature_names.size(); }
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
  float information_bias = 0;                         ///< times 1/N, subtracted from every mutual information
  int statistics_block = 1;                           ///< pixels of a square of this width share what section 5 finds
  std::uint32_t statistics_samples = most_neighbors;  ///< neighbors that section 5 looks at, at most
  float alpha_factor = 2;
  float noise = 0.02F;
  bool explain = false;  ///< backends keep explained(); not with shared statistics
  bool outlier_step = false;
  bool spread_spikes = false;
  float polish = 0;  ///< H; 0: no polish
  std::vector<PassPlan> passes;
  Window polished;  ///< pixels to polish, frame coordinates
};

/// Pairs of variables whose mutual information section 5 measures.
std::size_t pair_count(const Variables& variables);

/// "N" of the variable "N.X"; group_of() does it for slots, such as "feature.N.X".
std::string group_of_variable(const std::string& name);

/// Whether a group of features is of the second hit: its name ends in 2, as in "N2".
bool is_second_hit(const std::string& group);

/// Whether a group of features holds world positions: "P" or "P2".
bool is_world_position(const std::string& group);

/// Where the values of a feature lie, over all samples of a frame.
struct FeatureSpread {
  float mean = 0;
  double deviation = 0;  ///< of its group: root of the sum of its components' variances
};

/// What the plan needs to know of the prepared frame.
struct FrameFacts {
  int width = 0, height = 0;
  std::uint32_t max_samples_per_pixel = 0;
  Variables variables;
  float position_diagonal = 0;                ///< of the box of all first-hit world positions
  float radiance_scale = 1;                   ///< what the color was multiplied with
  std::vector<FeatureSpread> feature_spread;  ///< [feature], where the method asks for it
  std::size_t carried = 3;
  Window crop;  ///< frame coordinates; the pixels that are wanted in the end
};

/// Throws Error(usage) that names the first setting that cannot be, and what can.
void validate(const Settings& settings);

Plan make_plan(const FrameFacts& facts, const Settings& settings);

/// The neighborhood size of one pass.
NeighborhoodSize neighborhood_size(const Settings& settings, int box_width);

}  // namespace rpf
