// How low a tool comes along a direction on a motion.
#pragma once

#include <array>
#include <cmath>

#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/motion.hpp"

namespace feeler {

/// The heights of a tool's lowest point along a world direction, relative to the motion's origin [m].
template <class Scalar>
struct HeightOnMotion {
  Scalar start = Scalar(0);  // at the start, time 0
  Scalar least = Scalar(0);  // below which it does not come
  Scalar last = Scalar(0);   // at the end

  /// Finds the least height, from those at the start and at the end.
  ///
  /// With heights A, B at the ends and a sagitta g, the tool stays above every height that is s below the lower of them where
  /// √s + √(s + |A − B|) ≥ 2√g.
  void end_at(Scalar height, Scalar sagitta) noexcept {
    using std::sqrt;
    last = height;
    const Scalar difference = start < last ? last - start : start - last;
    Scalar slack(0);
    if (difference < 4 * sagitta) {
      const Scalar root = sqrt(sagitta) - difference / (4 * sqrt(sagitta));
      slack = root * root;
    }
    least = (start < last ? start : last) - slack;
  }
};

/// The heights along the normal of a plane.
template <class Scalar>
struct PlaneOnMotion : HeightOnMotion<Scalar> {
  Vector3<Scalar> normal;

  explicit PlaneOnMotion(const Vector3<Scalar>& direction = Vector3<Scalar>::UnitZ()) noexcept : normal(direction) {}

  template <class Moving>
  void begin(const Moving& moving, const MotionFrame<Scalar>& frame) noexcept {
    this->start = moving.lowest(normal, frame);
  }
  /// Begins a motion where the last one ended, a shift away from where that began.
  void go_on(const Vector3<Scalar>& shift) noexcept { this->start = this->last - normal.dot(shift); }
  template <class Moving>
  void end(const Moving& moving, const MotionFrame<Scalar>& frame) noexcept {
    if (moving.is_still()) this->end_at(this->start, Scalar(0));
    else this->end_at(moving.lowest(normal, frame), moving.sagitta(normal, frame.time));
  }
  /// Whether it parts the tool over the whole motion from what is up to `height` high along it, though it may not be `kept` away.
  bool parts_closely(Scalar height, const Clearance<Scalar>& clearance) const noexcept {
    const Scalar slack = this->least - height;
    return slack >= -2 * clearance.allowance && slack >= clearance.required(this->start - height);
  }
};

/// The box along the world axes that a motion stays in, relative to its origin: six planes whose normals need no products.
template <class Scalar>
class BoxOnMotion {
 public:
  template <class Moving>
  void begin(const Moving& moving, const MotionFrame<Scalar>& frame) noexcept {
    for_each_side([&](int axis, Scalar sign, auto& side) { side.start = moving.lowest_along_axis(axis, sign, frame); });
  }
  /// Begins a motion where the last one ended, a shift away from where that began.
  void go_on(const Vector3<Scalar>& shift) noexcept {
    for_each_side([&](int axis, Scalar sign, auto& side) { side.start = side.last - sign * shift[axis]; });
  }
  template <class Moving>
  void end(const Moving& moving, const MotionFrame<Scalar>& frame) noexcept {
    if (moving.is_still()) return for_each_side([](int, Scalar, auto& side) { side.end_at(side.start, Scalar(0)); });
    std::array<Scalar, 3> sagittas;
    for (int axis = 0; axis < 3; ++axis) sagittas[as_index(axis)] = moving.sagitta_along_axis(axis, frame.time);
    for_each_side([&](int axis, Scalar sign, auto& side) { side.end_at(moving.lowest_along_axis(axis, sign, frame), sagittas[as_index(axis)]); });
  }
  /// The least coordinate that a point of the tool has along an axis, and the largest [m].
  Scalar lower(int axis) const noexcept { return sides_[as_index(axis)][0].least; }
  Scalar upper(int axis) const noexcept { return -sides_[as_index(axis)][1].least; }

 private:
  template <class Visit>
  void for_each_side(const Visit& visit) noexcept {
    for (int axis = 0; axis < 3; ++axis) {
      visit(axis, Scalar(1), sides_[as_index(axis)][0]);
      visit(axis, Scalar(-1), sides_[as_index(axis)][1]);
    }
  }

  std::array<std::array<HeightOnMotion<Scalar>, 2>, 3> sides_;
};

}  // namespace feeler
