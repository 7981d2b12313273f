#include "io/deflate.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace rpf::io {
namespace {

constexpr int level = 6;  ///< of 12; the next ones take longer and save a hundredth

}  // namespace

std::string deflated(const std::string& bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
  return packed;
}

}  // namespace rpf::io
