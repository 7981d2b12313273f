// Where OpenEXR is told that a row of counts or pointers begins.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rpf::io {

/// The address of x = 0 in a row whose first entry stands for x = min_x: OpenEXR adds x * sizeof(T) to it. It lies
/// outside the row, so it is computed with integers; as a pointer it would be undefined.
template <class T>
char* row_base(T* first, int min_x) {
  const auto offset = static_cast<std::intptr_t>(min_x) * static_cast<std::intptr_t>(sizeof(T));
  return reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(first) - offset);  // NOLINT(performance-no-int-to-ptr)
}

}  // namespace rpf::io
