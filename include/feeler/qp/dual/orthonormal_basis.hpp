// Orthonormal vectors of six numbers, made one after the other: the factor Q of a matrix, and its complement.
#pragma once

#include <cmath>
#include <cstddef>

#include "feeler/core/scalar.hpp"
#include "feeler/qp/dual/six.hpp"

namespace feeler::detail {

/// A basis that grows by the method of Gram and Schmidt.
///
/// Vectors are made orthogonal twice (W. Kahan, in B. Parlett, "The Symmetric Eigenvalue Problem", section 6-9): a third time would change nothing.
template <RealScalar Scalar>
class OrthonormalBasis {
 public:
  bool is_complete() const noexcept { return size_ == 6; }
  const Six<Scalar>& operator[](std::size_t i) const noexcept { return vectors_[i]; }
  const Six<Scalar>& last() const noexcept { return vectors_[size_ - 1]; }

  /// Takes from a vector what it has along the basis, and returns the length of the rest.
  /// @param coefficients  grow by what is taken, one number for each vector of the basis
  Scalar orthogonalise(Six<Scalar>& v, Six<Scalar>& coefficients) const noexcept {
    using std::sqrt;
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t i = 0; i < size_; ++i) {
        const Scalar part = dot(vectors_[i], v);
        coefficients[i] += part;
        subtract(vectors_[i], part, v);
      }
    }
    return Scalar(sqrt(dot(v, v)));
  }

  /// Appends a vector that `orthogonalise` left, divided by its length; zeros where that is 0.
  void append(const Six<Scalar>& v, const Scalar& length) noexcept {
    for (std::size_t j = 0; j < 6; ++j) vectors_[size_][j] = length > Scalar(0) ? Scalar(v[j] / length) : Scalar(0);
    ++size_;
  }

  /// Appends what is left of that axis of which most is left.
  void append_farthest_axis() noexcept {
    Six<Scalar> longest{};
    Scalar length(0);
    for (std::size_t axis = 0; axis < 6; ++axis) {
      Six<Scalar> v{}, unused{};
      v[axis] = Scalar(1);
      const Scalar left = orthogonalise(v, unused);
      if (left > length) length = left, longest = v;
    }
    append(longest, length);
  }

 private:
  SixBySix<Scalar> vectors_{};
  std::size_t size_ = 0;
};

}  // namespace feeler::detail
