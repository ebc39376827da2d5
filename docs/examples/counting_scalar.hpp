// A double that counts its operations. Wider numbers work in the same way: give a type the operators and functions below, `std::numeric_limits` and
// `Eigen::NumTraits`. Boost.Multiprecision has all but the last.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

namespace counting {

/// A double that counts what is done to it.
class Counted {
 public:
  Counted() = default;
  Counted(double value) : value_(value) {}  // implicit, as numbers in formulas are
  Counted(int value) : value_(value) {}
  explicit Counted(long value) : value_(double(value)) {}
  explicit Counted(float value) : value_(value) {}
  explicit Counted(long double value) : value_(double(value)) {}
  explicit operator double() const { return value_; }
  explicit operator float() const { return float(value_); }
  explicit operator int() const { return int(value_); }
  explicit operator std::int64_t() const { return std::int64_t(value_); }
  explicit operator long double() const { return value_; }

  Counted operator-() const { return -value_; }
  Counted& operator+=(const Counted& b) { return ++sums, value_ += b.value_, *this; }
  Counted& operator-=(const Counted& b) { return ++sums, value_ -= b.value_, *this; }
  Counted& operator*=(const Counted& b) { return ++products, value_ *= b.value_, *this; }
  Counted& operator/=(const Counted& b) { return ++quotients, value_ /= b.value_, *this; }
  friend Counted operator+(Counted a, const Counted& b) { return a += b; }
  friend Counted operator-(Counted a, const Counted& b) { return a -= b; }
  friend Counted operator*(Counted a, const Counted& b) { return a *= b; }
  friend Counted operator/(Counted a, const Counted& b) { return a /= b; }
  friend bool operator==(const Counted& a, const Counted& b) { return a.value_ == b.value_; }
  friend auto operator<=>(const Counted& a, const Counted& b) { return a.value_ <=> b.value_; }

  // Found where the headers call `sqrt(x)` after `using std::sqrt`.
  friend Counted sqrt(const Counted& x) { return ++functions, std::sqrt(x.value_); }
  friend Counted sin(const Counted& x) { return ++functions, std::sin(x.value_); }
  friend Counted cos(const Counted& x) { return ++functions, std::cos(x.value_); }
  friend Counted tan(const Counted& x) { return ++functions, std::tan(x.value_); }
  friend Counted atan2(const Counted& y, const Counted& x) { return ++functions, std::atan2(y.value_, x.value_); }
  friend Counted acos(const Counted& x) { return ++functions, std::acos(x.value_); }
  friend Counted exp(const Counted& x) { return ++functions, std::exp(x.value_); }
  friend Counted log(const Counted& x) { return ++functions, std::log(x.value_); }
  friend Counted abs(const Counted& x) { return std::abs(x.value_); }
  friend Counted fabs(const Counted& x) { return std::abs(x.value_); }
  friend Counted ldexp(const Counted& x, int exponent) { return std::ldexp(x.value_, exponent); }
  friend Counted floor(const Counted& x) { return std::floor(x.value_); }
  friend Counted ceil(const Counted& x) { return std::ceil(x.value_); }
  friend bool isfinite(const Counted& x) { return std::isfinite(x.value_); }
  friend bool isnan(const Counted& x) { return std::isnan(x.value_); }

  inline static long sums = 0, products = 0, quotients = 0, functions = 0;
  static long operations() { return sums + products + quotients + functions; }

 private:
  double value_ = 0;
};

}  // namespace counting

template <>
struct std::numeric_limits<counting::Counted> : std::numeric_limits<double> {
  using Base = std::numeric_limits<double>;
  static counting::Counted epsilon() { return Base::epsilon(); }
  static counting::Counted min() { return (Base::min)(); }
  static counting::Counted max() { return (Base::max)(); }
  static counting::Counted lowest() { return Base::lowest(); }
  static counting::Counted infinity() { return Base::infinity(); }
  static counting::Counted quiet_NaN() { return Base::quiet_NaN(); }
};

template <>
struct Eigen::NumTraits<counting::Counted> : Eigen::GenericNumTraits<counting::Counted> {
  using Real = counting::Counted;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 1, AddCost = 1, MulCost = 1 };
  static Real epsilon() { return std::numeric_limits<Real>::epsilon(); }
  static Real dummy_precision() { return 1e-12; }
  static Real highest() { return (std::numeric_limits<Real>::max)(); }
  static Real lowest() { return std::numeric_limits<Real>::lowest(); }
  static Real infinity() { return std::numeric_limits<Real>::infinity(); }
  static Real quiet_NaN() { return std::numeric_limits<Real>::quiet_NaN(); }
  static int digits10() { return std::numeric_limits<double>::digits10; }
};
