#include "io/unpack.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace rpf::io {
namespace {

/// Run lengths: n >= 0 is n + 1 times the next byte, n < 0 is -n bytes as they are.
bool expand_runs(const std::vector<std::uint8_t>& packed, std::vector<std::uint8_t>& out) {
  std::size_t in = 0, done = 0;
  while (in < packed.size()) {
    const int code = static_cast<std::int8_t>(packed[in++]);
    const auto count = static_cast<std::size_t>(code < 0 ? -code : code + 1);
    const std::size_t taken = code < 0 ? count : 1;
    if (count > out.size() - done || taken > packed.size() - in) return false;
    if (code < 0)
      std::copy_n(packed.begin() + static_cast<std::ptrdiff_t>(in), count,
                  out.begin() + static_cast<std::ptrdiff_t>(done));
    else
      std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(done), count, packed[in]);
    in += taken;
    done += count;
  }
  return done == out.size();
}

/// Bytes that are added at once, by the extension that GCC and Clang share.
using Bytes = std::uint8_t __attribute__((vector_size(16)));
constexpr std::size_t at_once = sizeof(Bytes);

Bytes bytes_at(const std::uint8_t* from) {
  Bytes bytes;
  std::memcpy(&bytes, from, at_once);
  return bytes;
}

/// Each byte: the sum of all that was subtracted up to it, 128 a byte less.
Bytes running_sums(const std::uint8_t* differences) {
  constexpr Bytes none{};
  Bytes b = bytes_at(differences) + 128;
  b += __builtin_shufflevector(none, b, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
  b += __builtin_shufflevector(none, b, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29);
  b += __builtin_shufflevector(none, b, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27);
  return b + __builtin_shufflevector(none, b, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23);
}

std::uint8_t sum_of(const std::uint8_t* values, std::size_t count) {
  Bytes sums{};
  std::size_t i = 0;
  for (; i + at_once <= count; i += at_once) sums += bytes_at(values + i);
  std::uint8_t sum = 0;
  for (std::size_t k = 0; k < at_once; ++k) sum = static_cast<std::uint8_t>(sum + sums[k]);
  for (; i < count; ++i) sum = static_cast<std::uint8_t>(sum + values[i]);
  return sum;
}

/// Before compression the bytes at even places were put in front of those at odd places, and each byte but the first
/// was replaced by its difference from the one before, plus 128.
void undo_differences(const std::vector<std::uint8_t>& differences, std::vector<std::uint8_t>& out) {
  const std::size_t even = (out.size() + 1) / 2, odd = out.size() / 2;
  const std::uint8_t *evens = differences.data(), *odds = evens + even;
  const auto add = [](std::uint8_t value, unsigned difference) {
    return static_cast<std::uint8_t>(value + difference - 128U);
  };
  // Two chains of sums side by side. Where the second begins is a plain sum; the first so that its first byte is what
  // it is.
  std::uint8_t first = 128, second = static_cast<std::uint8_t>(128 + sum_of(evens, even) - 128 * even);
  std::size_t i = 0;
  for (; i + at_once <= odd; i += at_once) {
    const Bytes a = running_sums(evens + i), b = running_sums(odds + i), c = a + first, d = b + second;
    const Bytes low = __builtin_shufflevector(c, d, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23),
                high = __builtin_shufflevector(c, d, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
    std::memcpy(out.data() + 2 * i, &low, at_once);
    std::memcpy(out.data() + 2 * i + at_once, &high, at_once);
    first = static_cast<std::uint8_t>(first + a[at_once - 1]);  // not of c: the next sums need not wait for it
    second = static_cast<std::uint8_t>(second + b[at_once - 1]);
  }
  for (; i < odd; ++i) {
    out[2 * i] = first = add(first, evens[i]);
    out[2 * i + 1] = second = add(second, odds[i]);
  }
  if (even > odd) out[2 * odd] = add(first, evens[odd]);
}

}  // namespace

void Unpacker::FreeInflater::operator()(void* inflater) const {
  libdeflate_free_decompressor(static_cast<libdeflate_decompressor*>(inflater));
}

Unpacker::Unpacker(const std::string& compression)
    : compression_(compression), inflater_(libdeflate_alloc_decompressor()) {
  if (!inflater_) throw std::bad_alloc();
}

bool Unpacker::inflate(const std::vector<std::uint8_t>& packed) {
  // Without a place for the number of bytes, fewer than asked for are an error too.
  return libdeflate_zlib_decompress(static_cast<libdeflate_decompressor*>(inflater_.get()), packed.data(),
                                    packed.size(), differences_.data(), differences_.size(),
                                    nullptr) == LIBDEFLATE_SUCCESS;
}

bool Unpacker::unpack(const std::vector<std::uint8_t>& packed, std::vector<std::uint8_t>& out) {
  if (packed.size() == out.size()) {
    out = packed;
    return true;
  }
  if (packed.size() > out.size() || compression_ == "none") return false;
  differences_.resize(out.size());
  if (!(compression_ == "rle" ? expand_runs(packed, differences_) : inflate(packed))) return false;
  undo_differences(differences_, out);
  return true;
}

}  // namespace rpf::io
