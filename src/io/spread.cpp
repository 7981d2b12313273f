#include "io/spread.h"

#include <half.h>

#include <algorithm>
#include <cstring>

namespace rpf::io {
namespace {

float half_at(const std::uint8_t* b) { return imath_half_to_float(static_cast<std::uint16_t>(b[0] | b[1] << 8U)); }

}  // namespace

std::uint32_t word_at(const std::uint8_t* b) {
  return b[0] | b[1] << 8U | b[2] << 16U | static_cast<std::uint32_t>(b[3]) << 24U;
}

void spread(const std::uint8_t* values, const std::vector<SpreadTarget>& targets, std::size_t samples, float* records,
            std::size_t stride) {
  constexpr std::size_t block = 64;
  for (std::size_t first = 0; first < samples; first += block) {
    const std::size_t count = std::min(block, samples - first);
    for (const SpreadTarget& target : targets) {
      float* out = records + first * stride + target.column;
      const std::uint8_t* from = values + target.begin * samples + first * (target.half_float ? 2 : 4);
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t bits = target.half_float ? 0 : word_at(from + 4 * i);
        if (target.half_float)
          out[i * stride] = half_at(from + 2 * i);
        else
          std::memcpy(out + i * stride, &bits, sizeof bits);
      }
    }
  }
}

}  // namespace rpf::io
