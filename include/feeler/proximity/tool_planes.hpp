// Planes fixed to the tool that kept parting it from triangles, tried before such a triangle is measured.
#pragma once

#include <array>
#include <utility>

#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/age_planes.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// A few planes that turn with the tool, its faces above all: just below them lies what is near a contact, and a plane fixed to the world does not
/// follow a turning face so closely.
///
/// In the axes of the tool a plane stands and a point y of the object moves along an arc, Z(t) = R(t)ᵀ(y − c(t)). The tool reaches only points that
/// are within its radius ρ of its reference point c at some time, so |Z| ≤ ρ + |dp| all the while. That bounds how far the height of such a point
/// strays from its chord (`MovingTool::sagitta_of_object`): what is below the plane by as much at both ends stays below it. How high the tool is
/// above such a plane never changes: they belong to one tool.
template <class ScalarType>
class ToolPlanes {
 public:
  using Scalar = ScalarType;
  static constexpr int capacity = 8;

  void clear() noexcept { size_ = 0; }
  int size() const noexcept { return size_; }

  /// Finds the limits for a motion between two frames.
  /// @param kept  separation that every point is to keep [m]
  template <class Moving>
  void set_motion(const Moving& moving, const MotionFrame<Scalar>& start, const MotionFrame<Scalar>& end, Scalar kept) noexcept {
    for (int i = 0; i < size_; ++i) planes_[as_index(i)].set_motion(moving, start, end, kept);
  }
  /// Adds a plane in place of the least useful one, for the motion at hand.
  /// @param normal  unit, in the tool frame, from the object to the tool
  template <class Moving>
  void add(const Vector3<Scalar>& normal, const Moving& moving, const MotionFrame<Scalar>& start, const MotionFrame<Scalar>& end,
           Scalar kept) noexcept {
    const int place = size_ < capacity ? size_++ : capacity - 1;
    Plane& plane = planes_[as_index(place)];
    plane.normal = normal;
    plane.height = moving.lowest_in_tool(normal) - swept_radius(moving.tool());
    plane.hits = 2;
    plane.is_lent = true;  // a sweep has it from where this one comes from
    plane.set_motion(moving, start, end, kept);
  }
  /// A plane that parts the tool from a triangle over the whole motion, or −1.
  /// @param corners  relative to `MovingTool::origin()` [m]
  int parting(const Matrix3<Scalar>& corners) noexcept {
    for (int i = 0; i < size_; ++i) {
      Plane& plane = planes_[as_index(i)];
      if (!plane.at_start.is_above(corners) || !plane.at_end.is_above(corners)) continue;
      ++plane.hits;
      return i;
    }
    return -1;
  }
  /// Whether a plane is lent for the first time in this motion: as it is in the world at the end, it parts much of what is around for as long
  /// as the tool does not turn far.
  bool lend(int i) noexcept { return !std::exchange(planes_[as_index(i)].is_lent, true); }
  const Vector3<Scalar>& normal_at_end(int i) const noexcept { return planes_[as_index(i)].at_end.normal; }
  /// Before a motion: halves the hits and brings the most useful planes to the front.
  void age() noexcept {
    for (int i = 0; i < size_; ++i) planes_[as_index(i)].is_lent = false;
    detail::age_planes(planes_, size_);
  }

 private:
  /// Where a plane is at one end of the motion; axes of the world, relative to the motion's origin.
  struct HalfSpace {
    Vector3<Scalar> normal;
    Scalar limit;

    bool is_above(const Matrix3<Scalar>& corners) const noexcept { return highest_corner(corners, normal) <= limit; }
  };

  struct Plane {
    Vector3<Scalar> normal;
    Scalar height;  // of the tool's lowest point along it, above the reference point
    HalfSpace at_start, at_end;
    int hits = 0;
    bool is_lent = false;

    template <class Moving>
    void set_motion(const Moving& moving, const MotionFrame<Scalar>& start, const MotionFrame<Scalar>& end, Scalar kept) noexcept {
      at_start.normal = start.rotation * normal;
      at_end.normal = end.rotation * normal;
      const Scalar reach = moving.radius() + swept_radius(moving.tool()) + kept + moving.length();
      const Scalar least = height - kept - moving.sagitta_of_object(at_start.normal, end.time, reach);
      at_start.limit = least + at_start.normal.dot(start.shift);
      at_end.limit = least + at_end.normal.dot(end.shift);
    }
  };

  int size_ = 0;
  std::array<Plane, capacity> planes_;
};

}  // namespace feeler
