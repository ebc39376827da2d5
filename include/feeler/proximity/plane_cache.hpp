// A few planes that kept parting the tool from its surroundings, tried before anything is measured.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "feeler/core/scalar.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/motion.hpp"

namespace feeler {

/// World normals of separating planes, from tick to tick, and their limits over the motion at hand.
///
/// A plane with normal n parts the tool from every y with n·y ≤ limit over the whole motion: with heights A, B of the tool's lowest
/// point at the ends and a sagitta g, a slack s above the limit holds where √s + √(s + |A − B|) ≥ 2√g.
/// Against a wall that the tool touches no plane keeps that distance; there `parts_closely` asks for no more than there was at the start.
template <class ScalarType>
class PlaneCache {
 public:
  using Scalar = ScalarType;
  static constexpr int capacity = 16;

  int size() const noexcept { return size_; }
  const Vector3<Scalar>& normal(int i) const noexcept { return planes_[index(i)].normal; }
  Scalar limit(int i) const noexcept { return planes_[index(i)].limit; }
  void count_hit(int i) noexcept { ++planes_[index(i)].hits; }
  void clear() noexcept { size_ = 0; }

  /// Adds a plane in place of the least useful one and finds its limit; returns its position.
  template <class Moving>
  int add(const Vector3<Scalar>& normal, const Moving& moving, const MotionFrame<Scalar>& start,
          const MotionFrame<Scalar>& end, Scalar kept) noexcept {
    int place = size_ < capacity ? size_++ : 0;
    if (size_ == capacity && place == 0) {
      for (int i = 1; i < capacity; ++i) {
        if (planes_[index(i)].hits < planes_[index(place)].hits) place = i;
      }
    }
    Plane& plane = planes_[index(place)];
    plane.normal = normal;
    plane.hits = 4;
    plane.measure(moving, start, end, kept);
    return place;
  }

  /// Whether a plane parts the tool over the whole motion from what is up to `height` high along it, though it may not be `kept` away.
  bool parts_closely(int i, Scalar height, const Clearance<Scalar>& clearance) const noexcept {
    const Plane& plane = planes_[index(i)];
    const Scalar slack = plane.least - height;
    return slack >= -2 * clearance.allowance && slack >= clearance.required(plane.start - height);
  }

  /// Finds the limits for a motion.
  template <class Moving>
  void prepare(const Moving& moving, const MotionFrame<Scalar>& start, const MotionFrame<Scalar>& end,
               Scalar kept) noexcept {
    for (int i = 0; i < size_; ++i) planes_[index(i)].measure(moving, start, end, kept);
  }
  /// Halves the hits and brings the most useful planes to the front.
  void age() noexcept {
    for (int i = 0; i < size_; ++i) planes_[index(i)].hits /= 2;
    for (int i = 1; i < size_; ++i) {
      for (int k = i; k > 0 && planes_[index(k)].hits > planes_[index(k - 1)].hits; --k) std::swap(planes_[index(k)], planes_[index(k - 1)]);
    }
    while (size_ > 0 && planes_[index(size_ - 1)].hits == 0) --size_;
  }

  template <class Moving>
  static Scalar limit_of(const Vector3<Scalar>& normal, const Moving& moving, const MotionFrame<Scalar>& start,
                         const MotionFrame<Scalar>& end, Scalar kept) noexcept {
    return least_height(moving.lowest(normal, start), moving.lowest(normal, end), moving.sagitta(normal, end.time - start.time)) - kept;
  }

 private:
  static std::size_t index(int i) noexcept { return std::size_t(i); }

  struct Plane {
    Vector3<Scalar> normal;
    Scalar start;  // height of the tool's lowest point at the start
    Scalar least;  // below which it does not come
    Scalar limit;
    int hits = 0;

    template <class Moving>
    void measure(const Moving& moving, const MotionFrame<Scalar>& from, const MotionFrame<Scalar>& to, Scalar kept) noexcept {
      start = moving.lowest(normal, from);
      least = least_height(start, moving.lowest(normal, to), moving.sagitta(normal, to.time - from.time));
      limit = least - kept;
    }
  };

  /// Below which the tool certainly does not come.
  static Scalar least_height(Scalar at_start, Scalar at_end, Scalar sagitta) noexcept {
    using std::sqrt;
    const Scalar difference = at_start < at_end ? at_end - at_start : at_start - at_end;
    Scalar slack(0);
    if (difference < 4 * sagitta) {
      const Scalar root = sqrt(sagitta) - difference / (4 * sqrt(sagitta));
      slack = root * root;
    }
    return (at_start < at_end ? at_start : at_end) - slack;
  }

  int size_ = 0;
  std::array<Plane, capacity> planes_;
};

}  // namespace feeler
