// A few independent rows that carry the same force as many.
#pragma once

#include <array>
#include <limits>

#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/gram_schmidt.hpp"

namespace feeler {

/// At most six linearly independent rows with positive weights, whose weighted sum is that of all rows added.
///
/// Carathéodory's theorem for cones, one row at a time: a row that depends on those kept gives its weight to
/// them, until one of theirs is used up and makes room for it. Cost: about 300 multiplications a row;
/// noexcept, no allocation.
template <RealScalar Scalar>
class ConicBasis {
 public:
  int size() const noexcept { return size_; }
  /// The number that a row kept was added with.
  int number(int i) const noexcept { return rows_[as_index(i)].number; }
  const Scalar& weight(int i) const noexcept { return rows_[as_index(i)].weight; }

  /// @param weight  positive
  void add(int number, const Vector6<Scalar>& row, Scalar weight) noexcept {
    const auto e = basis_.expand(row, row);
    const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon();
    if (size_ < 6 && e.free_squared > rounding * rounding * e.squared) {
      rows_[as_index(size_++)] = {number, weight, row};
      basis_.add(e);
      return;
    }
    Scalar given = weight;  // to the rows kept
    int leaving = -1;
    for (int i = 0; i < size_; ++i) {
      const Scalar& share = e.coefficients[as_index(i)];
      if (share < Scalar(0) && rows_[as_index(i)].weight <= -share * given) {
        given = rows_[as_index(i)].weight / -share;
        leaving = i;
      }
    }
    for (int i = 0; i < size_; ++i) rows_[as_index(i)].weight += given * e.coefficients[as_index(i)];
    if (leaving < 0) return;
    rows_[as_index(leaving)] = {number, weight - given, row};
    drop_empty();
  }

 private:
  struct Row {
    int number = -1;
    Scalar weight = Scalar(0);
    Vector6<Scalar> row;
  };

  /// Drops what has no weight left, and orthogonalises anew.
  void drop_empty() noexcept {
    int kept = 0;
    basis_.clear();
    for (int i = 0; i < size_; ++i) {
      if (!(rows_[as_index(i)].weight > Scalar(0))) continue;
      rows_[as_index(kept)] = rows_[as_index(i)];
      basis_.add(basis_.expand(rows_[as_index(kept)].row, rows_[as_index(kept)].row));
      ++kept;
    }
    size_ = kept;
  }

  int size_ = 0;
  std::array<Row, 6> rows_;
  GramSchmidt<Scalar> basis_;
};

}  // namespace feeler
