// How planes that part nothing for some motions are forgotten.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace feeler::detail {

/// Halves the hits of planes, brings those with the most to the front and drops those with none.
/// @param size  of the planes in use, at the front
template <class Plane, std::size_t capacity>
void age_planes(std::array<Plane, capacity>& planes, int& size) noexcept {
  const auto in_use = std::size_t(size);
  for (std::size_t i = 0; i < in_use; ++i) planes[i].hits /= 2;
  for (std::size_t i = 1; i < in_use; ++i) {
    for (std::size_t k = i; k > 0 && planes[k].hits > planes[k - 1].hits; --k) std::swap(planes[k], planes[k - 1]);
  }
  while (size > 0 && planes[std::size_t(size - 1)].hits == 0) --size;
}

}  // namespace feeler::detail
