// Derivatives of a function of a small motion by differences in long double, for rows that claim to know them.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

namespace feeler_test {

using WideNumber = long double;
using WidePoint = Eigen::Matrix<WideNumber, 3, 1>;
using WideStep = Eigen::Matrix<WideNumber, 6, 1>;  // translation, rotation vector

/// Rotation by a rotation vector, by Rodrigues' formula.
inline WidePoint turned(const WidePoint& w, const WidePoint& v) {
  const WideNumber angle = w.norm();
  if (angle == 0) return v;
  const WidePoint axis = w / angle;
  return std::cos(angle) * v + std::sin(angle) * axis.cross(v) + (1 - std::cos(angle)) * axis.dot(v) * axis;
}

/// The step that has the effect of one step and then another.
inline WideStep composed(const WideStep& first, const WideStep& second) {
  const auto rotation = [](const WidePoint& w) {
    return Eigen::Quaternion<WideNumber>(Eigen::AngleAxis<WideNumber>(w.norm(), w.norm() > 0 ? WidePoint(w.normalized()) : WidePoint::UnitX()));
  };
  const Eigen::AngleAxis<WideNumber> both(rotation(second.tail<3>()) * rotation(first.tail<3>()));
  WideStep result;
  result << first.head<3>() + second.head<3>(), both.angle() * both.axis();
  return result;
}

/// Where derivatives are of the order of 1, differences err by h² and by rounding / h², both about 1e-9.
constexpr WideNumber difference_step = 1e-5L;

/// The gradient at zero of a function of a step.
template <class Function>
WideStep gradient_by_differences(const Function& function) {
  constexpr WideNumber h = difference_step;
  WideStep gradient;
  for (int i = 0; i < 6; ++i) {
    const WideStep step = WideStep::Unit(i) * h;
    gradient[i] = (function(step) - function(-step)) / (2 * h);
  }
  return gradient;
}

/// The second derivatives at zero of a function of a step.
template <class Function>
Eigen::Matrix<WideNumber, 6, 6> curvature_by_differences(const Function& function) {
  constexpr WideNumber h = difference_step;
  Eigen::Matrix<WideNumber, 6, 6> curvature;
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k) {
      const WideStep a = WideStep::Unit(i) * h, b = WideStep::Unit(k) * h;
      curvature(i, k) = (function(a + b) - function(a - b) - function(b - a) + function(-a - b)) / (4 * h * h);
    }
  return curvature;
}

/// The largest difference of an element.
template <class A, class B>
WideNumber largest_difference(const Eigen::MatrixBase<A>& by_differences, const Eigen::MatrixBase<B>& claimed) {
  return (by_differences - claimed.template cast<WideNumber>()).template lpNorm<Eigen::Infinity>();
}

}  // namespace feeler_test
