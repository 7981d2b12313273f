#include "io/unpack.h"

#include <libdeflate.h>

#include <algorithm>
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

/// Before compression the bytes at even places were put in front of those at odd places, and each byte but the first
/// was replaced by its difference from the one before, plus 128.
void undo_differences(const std::vector<std::uint8_t>& differences, std::vector<std::uint8_t>& out) {
  const std::size_t even = (out.size() + 1) / 2, odd = out.size() / 2;
  const auto add = [](std::uint8_t value, std::uint8_t difference) {
    return static_cast<std::uint8_t>(value + difference - 128);
  };
  // Two chains of sums side by side take half the time of one: where the second begins is a plain sum.
  std::uint8_t first = 128, second = 128;  // so that the first byte is what it is
  for (std::size_t i = 0; i < even; ++i) second = add(second, differences[i]);
  for (std::size_t i = 0; i < odd; ++i) {
    out[2 * i] = first = add(first, differences[i]);
    out[2 * i + 1] = second = add(second, differences[even + i]);
  }
  if (even > odd) out[2 * odd] = add(first, differences[odd]);
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
