// Guesses at another convention: what all values that contradict ours agree with.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rpf/filter.h"
#include "rpf/samples.h"

namespace rpf {

/// A convention that values may follow in place of ours, and what to do about it.
struct Guess {
  std::string advice;
  std::uint64_t agreeing = 0;  ///< of the values that contradict ours
};

/// The advice of the first guess that nearly all of `count` values agree with, else `otherwise`.
std::string advice_of(const std::vector<Guess>& guesses, std::uint64_t count, const std::string& otherwise);

/// The columns of a slot's components, such as {"feature.N.X", "feature.N.Y", "feature.N.Z"}; empty where one is
/// missing.
std::vector<std::size_t> columns_of(const SampleLayout& layout, const std::string& prefix, const char* components);

/// Film positions outside their pixel.
void check_film(const SampleBuffer& samples, std::vector<InputNote>& notes);
/// Normals, reflectances, and whether positions lie on surfaces with these normals.
void check_surfaces(const SampleBuffer& samples, std::vector<InputNote>& notes);

}  // namespace rpf
