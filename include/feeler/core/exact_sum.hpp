// The sign of a sum of products, without rounding.
#pragma once

#include <cmath>

#include "feeler/core/fixed_vector.hpp"

namespace feeler {

/// A sum of doubles as others that do not overlap, by increasing size: no digit is lost, as long as nothing
/// overflows or underflows. Source: J. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast
/// Robust Geometric Predicates", Discrete & Computational Geometry 18 (1997), theorem 10.
/// @tparam capacity  terms that can be added
template <int capacity>
class ExactSum {
 public:
  /// @cost  linear in the terms of the sum
  void add(double term) noexcept {
    FixedVector<double, capacity> sum;
    for (const double part : parts_) {
      const double both = term + part, of_part = both - term;
      const double lost = (term - (both - of_part)) + (part - of_part);
      if (lost != 0) sum.push_back(lost);
      term = both;
    }
    if (term != 0) sum.push_back(term);
    parts_ = sum;
  }
  int sign() const noexcept { return parts_.empty() ? 0 : parts_.back() > 0 ? 1 : -1; }

 private:
  FixedVector<double, capacity> parts_;
};

/// A number as the sum of two that do not overlap.
struct TwoParts {
  double high, low;

  static TwoParts difference(double a, double b) noexcept {
    const double high = a - b, of_b = a - high;
    return {high, (a - (high + of_b)) + (of_b - b)};
  }
  static TwoParts product(double a, double b) noexcept {
    const double high = a * b;
    return {high, std::fma(a, b, -high)};
  }
};

}  // namespace feeler
