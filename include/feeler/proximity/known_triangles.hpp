// The triangles near a tool that are known before its sweep, and what is hidden behind the planes that part them from it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/height_on_motion.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/passage.hpp"
#include "feeler/proximity/work_meter.hpp"

namespace feeler {

/// A triangle that the sweep examines first, with what is known of it from before.
template <class Scalar>
struct KnownTriangle {
  int triangle = -1;
  PassedTriangle<Scalar> state;
};

/// A plane that parts a known triangle from the tool.
template <class Scalar>
struct HidingPlane {
  Vector3<Scalar> normal;
  Scalar height;  ///< of that triangle along it, relative to the motion's origin [m]
};

/// The known triangles of one sweep. What lies in or behind the plane that parts one of them is no nearer to the tool than that one, as seen along
/// the normal: of a wall that is cut into many triangles a few so tell all.
template <class ScalarType>
class KnownTriangles {
 public:
  using Scalar = ScalarType;
  using List = std::span<const KnownTriangle<Scalar>>;
  static constexpr int plane_capacity = 4;
  using Planes = FixedVector<HidingPlane<Scalar>, plane_capacity>;

  void set(List list) noexcept { list_ = list; }
  const List& list() const noexcept { return list_; }

  /// Tells by its number whether a triangle is known.
  auto by_number() const noexcept {
    const auto mark_of = [](int triangle) { return std::uint64_t(1) << (unsigned(triangle) % 64U); };
    std::uint64_t marks = 0;  // a bit for every 64th triangle: most are told from the known by it
    for (const KnownTriangle<Scalar>& known : list_) marks |= mark_of(known.triangle);
    return [this, marks, mark_of](int triangle) {
      return (marks & mark_of(triangle)) != 0 &&
             std::any_of(list_.begin(), list_.end(), [triangle](const auto& known) { return known.triangle == triangle; });
    };
  }

  /// The planes, no two alike, that part the tool from known triangles near it where it stands: they hide box by box.
  template <class Moving>
  Planes hiding_planes(const Moving& standing, const MotionFrame<Scalar>& start, const Clearance<Scalar>& clearance) const noexcept {
    Planes planes;
    for (const KnownTriangle<Scalar>& known : list_) {
      if (planes.full()) break;
      const Vector3<Scalar>& normal = known.state.normal;
      const auto is_alike = [&](const HidingPlane<Scalar>& other) { return other.normal.dot(normal) > Scalar(1) - Scalar(1e-12); };
      if (normal.isZero(Scalar(0)) || std::any_of(planes.begin(), planes.end(), is_alike)) continue;
      const Scalar height = highest_corner(known.state.corners, normal) + flat(clearance), slack = standing.lowest(normal, start) - height;
      if (slack > -2 * clearance.allowance && slack < 2 * clearance.kept) planes.push_back({normal, height});
    }
    return planes;
  }

  /// Whether a triangle is behind the plane of a known one, over the motion from `start` to `end`.
  /// @param corners  relative to the motion's origin [m]
  /// @param work     grows by the work done
  template <class Moving>
  FEELER_FLATTEN bool hide(const Matrix3<Scalar>& corners, const Moving& moving, const MotionFrame<Scalar>& start, const MotionFrame<Scalar>& end,
                           const Clearance<Scalar>& clearance, int& work) noexcept {
    triangles_.add(1, work);
    for (const KnownTriangle<Scalar>& known : list_) {
      PlaneOnMotion<Scalar> plane{known.state.normal};
      const Scalar height = highest_corner(corners, plane.normal);
      if (!(height <= highest_corner(known.state.corners, plane.normal) + flat(clearance)) || plane.normal.isZero(Scalar(0))) continue;
      plane.begin(moving, start);
      plane.end(moving, end);
      if (plane.parts_closely(height, clearance)) return true;
    }
    return false;
  }

 private:
  /// By how much a triangle may rise from a plane and lie in it still [m].
  static Scalar flat(const Clearance<Scalar>& clearance) noexcept { return clearance.kept / 1000; }

  List list_;
  WorkMeter<4> triangles_;  // that were asked for
};

}  // namespace feeler
