#include "scene/sampler.h"

#include <algorithm>
#include <cmath>

#include "scene/random.h"

namespace rpf::scene {
namespace {

enum Dimension : std::uint32_t { film, lens, time, light, bsdf, further };

std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16U) | (x >> 16U);
  x = ((x & 0x00ff00ffU) << 8U) | ((x & 0xff00ff00U) >> 8U);
  x = ((x & 0x0f0f0f0fU) << 4U) | ((x & 0xf0f0f0f0U) >> 4U);
  x = ((x & 0x33333333U) << 2U) | ((x & 0xccccccccU) >> 2U);
  return ((x & 0x55555555U) << 1U) | ((x & 0xaaaaaaaaU) >> 1U);
}

/// Owen scrambling of the binary digits (Laine and Karras; constants of Burley, JCGT 9(4), 2020).
std::uint32_t scramble(std::uint32_t x, std::uint32_t key) {
  x = reverse_bits(x);
  x += key;
  x ^= x * 0x6c50b47cU;
  x ^= x * 0xb82f1e52U;
  x ^= x * 0xc7afe638U;
  x ^= x * 0x8d22f6e6U;
  return reverse_bits(x);
}

/// The second dimension of Sobol's sequence; the first is reverse_bits. Its generator matrix is Pascal's triangle
/// mod 2.
std::uint32_t sobol_second(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t column = 1U << 31U; index != 0; index >>= 1U, column ^= column >> 1U)
    if ((index & 1U) != 0) result ^= column;
  return result;
}

/// Places a sample in the coarse column * fine row of one axis, with jitter; never 1.
float place(std::uint32_t coarse, std::uint32_t fine, float jitter, std::uint32_t coarse_count,
            std::uint32_t fine_count) {
  const float position = (static_cast<float>(fine) + jitter) / static_cast<float>(fine_count);
  return std::min((static_cast<float>(coarse) + position) / static_cast<float>(coarse_count), below_one);
}

/// Jittered cells of a columns x rows grid whose projections on either axis are stratified too.
Pair multi_jittered(std::uint32_t sample, std::uint32_t count, std::uint32_t key) {
  auto columns = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(count)));
  while (count % columns != 0) --columns;
  const std::uint32_t rows = count / columns, x = sample % columns, y = sample / columns;
  Stream jitter(hash(key, sample + 3));
  const float jitter_u = jitter.next(), jitter_v = jitter.next();
  return {place(x, permute(y, rows, hash(hash(key, 1), x)), jitter_u, columns, rows),
          place(y, permute(x, columns, hash(hash(key, 2), y)), jitter_v, rows, columns)};
}

}  // namespace

std::uint32_t permute(std::uint32_t i, std::uint32_t count, std::uint32_t key) {
  std::uint32_t mask = count - 1;
  for (const std::uint32_t shift : {1U, 2U, 4U, 8U, 16U}) mask |= mask >> shift;
  do {  // a bijection of 0 .. mask; walked until it lands inside
    i ^= key;
    i *= 0xe170893dU;
    i ^= key >> 16U;
    i ^= (i & mask) >> 4U;
    i ^= key >> 8U;
    i *= 0x0929eb3fU;
    i ^= key >> 23U;
    i ^= (i & mask) >> 1U;
    i *= 1 | key >> 27U;
    i *= 0x6935fa69U;
    i ^= (i & mask) >> 11U;
    i *= 0x74dcb303U;
    i ^= (i & mask) >> 2U;
    i *= 0x9e501cc3U;
    i ^= (i & mask) >> 2U;
    i *= 0xc860a3dfU;
    i &= mask;
    i ^= i >> 5U;
  } while (i >= count);
  return (i + key) % count;
}

Pair PixelSampler::pair(std::uint32_t sample, std::uint32_t dimension) const {
  const std::uint32_t key = hash(key_, dimension);
  if (kind_ == SceneSampler::random) {
    Stream numbers(hash(key, sample));
    const float u = numbers.next();
    return {u, numbers.next()};
  }
  // The place in the pattern says nothing about the place of the same sample in another dimension's pattern.
  const std::uint32_t shuffled = permute(sample, count_, hash(key, 0x5bd1e995U));
  if (kind_ == SceneSampler::stratified) return multi_jittered(shuffled, count_, key);
  return {to_unit(scramble(reverse_bits(shuffled), hash(key, 1))),
          to_unit(scramble(sobol_second(shuffled), hash(key, 2)))};
}

Draw PixelSampler::draw(std::uint32_t sample) const {
  return {pair(sample, film), pair(sample, lens),   pair(sample, light),
          pair(sample, bsdf), pair(sample, time).u, hash(hash(key_, further), sample)};
}

}  // namespace rpf::scene
