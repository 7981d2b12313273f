// What Python sees of the library's buffers: numpy arrays over their memory, and tuples for windows.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "rpf/image.h"

namespace rpf::python {

namespace nb = nanobind;

/// x, y, width, height in pixels.
using WindowTuple = std::tuple<int, int, int, int>;
using Origin = std::pair<int, int>;

inline WindowTuple tuple_of(const Window& w) { return {w.x, w.y, w.width, w.height}; }
inline Window window_of(const WindowTuple& w) {
  return {std::get<0>(w), std::get<1>(w), std::get<2>(w), std::get<3>(w)};
}
inline Window window_of(const Origin& origin, std::size_t height, std::size_t width) {
  return {origin.first, origin.second, static_cast<int>(width), static_cast<int>(height)};
}

template <class T>
using View = nb::ndarray<nb::numpy, const T>;

/// A read-only array over memory of `owner`, which lives as long as the array.
template <class T, class Owner>
View<T> view(const T* data, std::initializer_list<std::size_t> shape, const std::shared_ptr<Owner>& owner) {
  nb::capsule keeper(new std::shared_ptr<Owner>(owner),
                     [](void* p) noexcept { delete static_cast<std::shared_ptr<Owner>*>(p); });
  return View<T>(data, shape, keeper);
}

}  // namespace rpf::python
