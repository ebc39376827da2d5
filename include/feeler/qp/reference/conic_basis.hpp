// A few independent rows that carry the same force as many.
#pragma once

#include <array>
#include <limits>

#include "feeler/core/scalar.hpp"
#include "feeler/qp/reference/gram_schmidt.hpp"

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
  int index(int i) const noexcept { return rows_[at(i)].index; }
  const Scalar& weight(int i) const noexcept { return rows_[at(i)].weight; }

  /// @param weight  positive
  void add(int index, const Vector6<Scalar>& row, Scalar weight) noexcept {
    const auto e = basis_.expand(row, row);
    const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon();
    if (size_ < 6 && e.free_squared > rounding * rounding * e.squared) {
      rows_[at(size_++)] = {index, weight, row};
      basis_.add(e);
      return;
    }
    Scalar given = weight;  // to the rows kept
    int leaving = -1;
    for (int i = 0; i < size_; ++i) {
      const Scalar& share = e.coefficients[at(i)];
      if (share < Scalar(0) && rows_[at(i)].weight < -share * given) {
        given = rows_[at(i)].weight / -share;
        leaving = i;
      }
    }
    for (int i = 0; i < size_; ++i) rows_[at(i)].weight += given * e.coefficients[at(i)];
    if (leaving < 0) return;
    rows_[at(leaving)] = {index, weight - given, row};
    drop_empty();
  }

 private:
  struct Row {
    int index = -1;
    Scalar weight = Scalar(0);
    Vector6<Scalar> row;
  };
  static std::size_t at(int i) noexcept { return std::size_t(i); }

  /// Drops what has no weight left, and orthogonalises anew.
  void drop_empty() noexcept {
    int kept = 0;
    basis_.clear();
    for (int i = 0; i < size_; ++i) {
      if (!(rows_[at(i)].weight > Scalar(0))) continue;
      rows_[at(kept)] = rows_[at(i)];
      basis_.add(basis_.expand(rows_[at(kept)].row, rows_[at(kept)].row));
      ++kept;
    }
    size_ = kept;
  }

  int size_ = 0;
  std::array<Row, 6> rows_;
  GramSchmidt<Scalar> basis_;
};

}  // namespace feeler
