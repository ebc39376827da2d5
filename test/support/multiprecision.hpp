// Scalars of Boost.Multiprecision for tests, with the traits that Eigen asks for.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include <Eigen/Core>

namespace feeler_test {

/// 50 decimal digits.
using Float50 = boost::multiprecision::cpp_bin_float_50;
/// The 113 binary digits of IEEE's quad.
using Quad = boost::multiprecision::cpp_bin_float_quad;
/// Fractions without rounding.
using Rational = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

}  // namespace feeler_test

// Those of Boost 1.74 lack infinity and quiet_NaN, which Eigen 3.4 uses.
template <class Backend>
struct Eigen::NumTraits<boost::multiprecision::number<Backend, boost::multiprecision::et_off>>
    : Eigen::GenericNumTraits<boost::multiprecision::number<Backend, boost::multiprecision::et_off>> {
  using Real = boost::multiprecision::number<Backend, boost::multiprecision::et_off>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  using Limits = std::numeric_limits<Real>;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 10, AddCost = 100, MulCost = 200 };
  static Real epsilon() { return Limits::epsilon(); }
  static Real dummy_precision() { return 1000 * Limits::epsilon(); }
  static Real highest() { return Limits::max(); }
  static Real lowest() { return Limits::lowest(); }
  static Real infinity() { return Limits::infinity(); }
  static Real quiet_NaN() { return Limits::quiet_NaN(); }
  static int digits10() { return Limits::digits10; }
};

// Boost 1.74 asks whether a matrix holds bytes by an iterator that only vectors have.
template <class Scalar, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
struct boost::multiprecision::detail::is_byte_container<Eigen::Matrix<Scalar, Rows, Columns, Options, MaxRows, MaxColumns>> : boost::false_type {};
