// Counter-based random numbers: no state, so the order in which pixels are rendered cannot matter.
#pragma once

#include <cstdint>

namespace rpf::scene {

/// A hash of 32 bits (Wellons' triple32: every input bit flips every output bit with probability one half).
inline std::uint32_t hash(std::uint32_t x) {
  x ^= x >> 17U;
  x *= 0xed5ad4bbU;
  x ^= x >> 11U;
  x *= 0xac4c1b51U;
  x ^= x >> 15U;
  x *= 0x31848babU;
  x ^= x >> 14U;
  return x;
}

/// A hash of a sequence: hash(hash(a), b) differs from hash(hash(b), a).
inline std::uint32_t hash(std::uint32_t key, std::uint32_t x) { return hash(key ^ hash(x + 0x9e3779b9U)); }

/// The largest float below 1.
constexpr float below_one = 0x1.fffffep-1F;

/// The upper 24 bits as a float in [0, 1).
inline float to_unit(std::uint32_t bits) { return static_cast<float>(bits >> 8U) * 0x1p-24F; }

/// A stream of numbers in [0, 1) that only its key decides.
class Stream {
 public:
  explicit Stream(std::uint32_t key) : key_(key) {}
  float next() { return to_unit(hash(key_, counter_++)); }

 private:
  std::uint32_t key_, counter_ = 0;
};

}  // namespace rpf::scene
