// The rows of a quadratic program, stored by columns, so that solvers read many rows at a time.
#pragma once

#include <array>
#include <cstddef>

#include "feeler/core/scalar.hpp"

namespace feeler {

/// Room for `Capacity` rows of six numbers; `rows[k]` reads and writes row k as a vector.
template <RealScalar Scalar, int Capacity>
class RowList {
 public:
  // A little longer than a power of two, so that the columns of a row lie in different sets of the cache.
  static constexpr int stride = Capacity + 16;
  using Row = Eigen::Map<Vector6<Scalar>, 0, Eigen::InnerStride<stride>>;
  using ConstRow = Eigen::Map<const Vector6<Scalar>, 0, Eigen::InnerStride<stride>>;

  Row operator[](std::size_t k) noexcept { return Row(columns_.data() + k); }
  ConstRow operator[](std::size_t k) const noexcept { return ConstRow(columns_.data() + k); }
  /// Entry j of all rows, one after another; what lies behind the last row is some number.
  const Scalar* column(int j) const noexcept { return columns_.data() + std::size_t(j) * stride; }

 private:
  alignas(64) std::array<Scalar, std::size_t(6 * stride)> columns_{};
};

}  // namespace feeler
