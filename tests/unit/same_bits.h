// Equality bit for bit.
#pragma once

#include <cstring>
#include <vector>

namespace rpf::test {

/// So that NaN equals NaN and 0 is not -0.
inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

}  // namespace rpf::test
