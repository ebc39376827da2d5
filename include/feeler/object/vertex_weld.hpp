// Gives equal positions one number, so that triangles listed corner by corner share vertices.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "feeler/core/scalar.hpp"

namespace feeler::detail {

/// Numbers distinct positions in order of first appearance, by hashing. 0.0 and -0.0 are equal; nothing else
/// is rounded.
template <RealScalar Scalar>
class VertexWeld {
 public:
  /// @param expected_count  of positions to come
  explicit VertexWeld(std::size_t expected_count) : slots_(std::bit_ceil(expected_count * 2 + 2), -1), mask_(slots_.size() - 1) {}

  /// The number of a position. @cost constant, expected
  int number(const Vector3<Scalar>& position) {
    for (std::size_t slot = hash(position) & mask_;; slot = (slot + 1) & mask_) {
      std::int32_t& index = slots_[slot];
      if (index < 0) {
        index = std::int32_t(vertices_.size());
        vertices_.push_back(position);
        return index;
      }
      if (vertices_[std::size_t(index)] == position) return index;
    }
  }

  /// The distinct positions, by number.
  std::vector<Vector3<Scalar>>& vertices() noexcept { return vertices_; }

 private:
  static std::size_t hash(const Vector3<Scalar>& position) noexcept {
    std::uint64_t h = 0;
    for (int k = 0; k < 3; ++k) {
      const double x = static_cast<double>(position[k]) + 0.0;  // -0.0 becomes 0.0
      h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15U;
      h ^= h >> 32;
    }
    return std::size_t(h);
  }

  std::vector<std::int32_t> slots_;
  std::size_t mask_;
  std::vector<Vector3<Scalar>> vertices_;
};

}  // namespace feeler::detail
