// The scalar a user may choose, and the type in which its geometry is decided.
#pragma once

#include <concepts>
#include <limits>

#include <Eigen/Core>

#include "feeler/core/no_fast_math.hpp"

namespace feeler {

/// A real number: built-in floating point, or a type that behaves like one and has an `Eigen::NumTraits`.
template <class T>
concept RealScalar = std::numeric_limits<T>::is_specialized && !std::numeric_limits<T>::is_integer && requires(T a, T b) {
  { a + b } -> std::convertible_to<T>;
  { a* b } -> std::convertible_to<T>;
  { a / b } -> std::convertible_to<T>;
  { a < b } -> std::convertible_to<bool>;
};

template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar>
using Vector6 = Eigen::Matrix<Scalar, 6, 1>;
template <class Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
template <class Scalar>
using Matrix6 = Eigen::Matrix<Scalar, 6, 6>;
/// A list of points, one a row: the `V` that libigl users have.
template <class Scalar>
using Points = Eigen::Matrix<Scalar, Eigen::Dynamic, 3>;
/// A list of triangles, one a row, as indices into `Points`: the `F` that libigl users have.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3>;

namespace detail {
template <class Scalar>
struct WorkingScalarOf {
  using type = Scalar;
};
// At a gap of 1 µm and coordinates of 0.1 m a float has 6 nm to tell the direction of a contact: too little.
template <>
struct WorkingScalarOf<float> {
  using type = double;
};
}  // namespace detail

/// The type in which distances are measured and collisions are decided: never narrower than `double`.
template <RealScalar Scalar>
using WorkingScalar = typename detail::WorkingScalarOf<Scalar>::type;

}  // namespace feeler
