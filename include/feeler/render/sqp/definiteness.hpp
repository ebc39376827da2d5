// Whether a symmetric matrix of six rows is positive definite, without a division.
#pragma once

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler {

namespace detail {

/// A symmetric matrix of three rows, by its lower triangle.
template <class Scalar>
struct SymmetricThree {
  Scalar xx, yx, zx, yy, zy, zz;

  SymmetricThree adjugate() const noexcept {
    return {yy * zz - zy * zy, zx * zy - yx * zz, yx * zy - zx * yy, xx * zz - zx * zx, yx * zx - xx * zy, xx * yy - yx * yx};
  }
  Scalar determinant(const SymmetricThree& adjugate) const noexcept { return xx * adjugate.xx + yx * adjugate.yx + zx * adjugate.zx; }
  Vector3<Scalar> operator*(const Vector3<Scalar>& v) const noexcept {
    return {xx * v[0] + yx * v[1] + zx * v[2], yx * v[0] + yy * v[1] + zy * v[2], zx * v[0] + zy * v[1] + zz * v[2]};
  }
};

}  // namespace detail

/// Whether a symmetric matrix, less a diagonal, is positive definite, and its minors are finite; reads the lower triangle.
///
/// By the signs of the leading minors (Sylvester's criterion), all at once: the pivots of a factor wait for each other, and for a division
/// each. With H = [A Bᵀ; B R] in blocks of three rows, those of the last three are minors of det(A)·R − B adj(A) Bᵀ, which is
/// det(A) times the Schur complement of A. Entries whose products of twelve overflow are not definite.
/// Source: R. A. Horn, C. R. Johnson, "Matrix Analysis" (2013), theorems 7.2.5 and 7.7.7. Cost: 90 multiplications.
template <RealScalar Scalar>
FEELER_FLATTEN bool is_positive_definite(const Matrix6<Scalar>& h, const Vector6<Scalar>& less) noexcept {
  using Three = detail::SymmetricThree<Scalar>;
  const Three head{h(0, 0) - less[0], h(1, 0), h(2, 0), h(1, 1) - less[1], h(2, 1), h(2, 2) - less[2]};
  const Three adjugate = head.adjugate();
  const Scalar size = head.determinant(adjugate);
  const Vector3<Scalar> beside[3] = {{h(3, 0), h(3, 1), h(3, 2)}, {h(4, 0), h(4, 1), h(4, 2)}, {h(5, 0), h(5, 1), h(5, 2)}};
  const Vector3<Scalar> pull[3] = {adjugate * beside[0], adjugate * beside[1], adjugate * beside[2]};
  const auto left = [&](int i, int j, const Scalar& entry) { return size * entry - pull[i].dot(beside[j]); };
  const Three rest{left(0, 0, h(3, 3) - less[3]), left(1, 0, h(4, 3)), left(2, 0, h(5, 3)),
                   left(1, 1, h(4, 4) - less[4]), left(2, 1, h(5, 4)), left(2, 2, h(5, 5) - less[5])};
  const Three last = rest.adjugate();
  const Scalar whole = rest.determinant(last);
  const bool has_positive_minors = (head.xx > Scalar(0)) & (adjugate.zz > Scalar(0)) & (size > Scalar(0)) &  //
                                   (rest.xx > Scalar(0)) & (last.zz > Scalar(0)) & (whole > Scalar(0));
  return has_positive_minors & (whole - whole == Scalar(0));
}

}  // namespace feeler
