// A few planes that kept parting the tool from its surroundings, tried before anything is measured.
#pragma once

#include <array>

#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/age_planes.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/feature_cache.hpp"
#include "feeler/proximity/height_on_motion.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/parted_leaves.hpp"
#include "feeler/proximity/tool_planes.hpp"

namespace feeler {

/// World normals of separating planes, from tick to tick, and their limits over the motion at hand; and where queries about triangles that
/// none of them passed may start.
///
/// A plane with normal n parts the tool from every y with n·y ≤ limit by `kept` over the whole motion. A cache belongs to one tool and one mesh.
/// Against a wall that the tool touches no plane keeps that distance; there `parts_closely` asks for no more than there was at the start.
template <class ScalarType>
class PlaneCache {
 public:
  using Scalar = ScalarType;
  static constexpr int capacity = 12;

  /// @param leaf_capacity  of the leaves that are remembered
  explicit PlaneCache(int leaf_capacity = 0) : leaves_(leaf_capacity) {}

  int size() const noexcept { return size_; }
  const Vector3<Scalar>& normal(int i) const noexcept { return planes_[as_index(i)].normal; }
  Scalar limit(int i) const noexcept { return planes_[as_index(i)].limit; }
  void count_hits(int i, int hits) noexcept { planes_[as_index(i)].hits += hits; }
  void clear() noexcept {
    size_ = 0;
    knows_heights_ = false;
    features_.clear();
    with_tool_.clear();
    leaves_.clear();
  }
  /// Those fixed to the tool.
  ToolPlanes<Scalar>& with_tool() noexcept { return with_tool_; }
  /// Leaves that planes of their own part from the tool.
  PartedLeaves<Scalar>& leaves() noexcept { return leaves_; }
  /// How far the tool is above the plane at the start of the motion, relative to its origin [m].
  Scalar height(int i) const noexcept { return planes_[as_index(i)].start; }
  /// Of the triangles that no plane passed.
  FeatureCache& features() noexcept { return features_; }

  /// Adds a plane in place of the least useful one and finds its limit; returns its position.
  template <class Moving>
  int add(const Vector3<Scalar>& normal, const Moving& moving, const MotionFrame<Scalar>& start, const MotionFrame<Scalar>& end,
          Scalar kept) noexcept {
    int place = size_ < capacity ? size_++ : 0;
    if (size_ == capacity && place == 0) {
      for (int i = 1; i < capacity; ++i) {
        if (planes_[as_index(i)].hits < planes_[as_index(place)].hits) place = i;
      }
    }
    Plane& plane = planes_[as_index(place)];
    plane.normal = normal;
    plane.hits = 2;
    plane.begin(moving, start);
    plane.end(moving, end, kept);
    return place;
  }

  /// Whether a plane parts the tool over the whole motion from what is up to `height` high along it, though it may not be `kept` away.
  bool parts_closely(int i, Scalar height, const Clearance<Scalar>& clearance) const noexcept {
    return planes_[as_index(i)].parts_closely(height, clearance);
  }

  /// Finds the heights at the start of a motion; they are relative to where the tool is, so known where it is turned as at the end of the last one.
  template <class Moving>
  void begin(const Moving& moving, const MotionFrame<Scalar>& start) noexcept {
    const bool keeps_axes = knows_heights_ && start.rotation == axes_at_end_;
    const auto begin = [&](auto& planes) { keeps_axes ? planes.go_on(shift_) : planes.begin(moving, start); };
    for (int i = 0; i < size_; ++i) begin(planes_[as_index(i)]);
    begin(box_);
  }
  /// Finds the limits for a motion that ends at a frame, and may have ended later before.
  template <class Moving>
  void end(const Moving& moving, const MotionFrame<Scalar>& end, Scalar kept) noexcept {
    for (int i = 0; i < size_; ++i) planes_[as_index(i)].end(moving, end, kept);
    box_.end(moving, end);
    axes_at_end_ = end.rotation;
    shift_ = end.shift;
    knows_heights_ = true;
  }
  /// Around the motion.
  const BoxOnMotion<Scalar>& box() const noexcept { return box_; }
  /// Halves the hits and brings the most useful planes to the front.
  void age() noexcept { detail::age_planes(planes_, size_); }

 private:
  struct Plane : PlaneOnMotion<Scalar> {
    Scalar limit;
    int hits = 0;

    template <class Moving>
    void end(const Moving& moving, const MotionFrame<Scalar>& frame, Scalar kept) noexcept {
      PlaneOnMotion<Scalar>::end(moving, frame);
      limit = this->least - kept;
    }
  };

  int size_ = 0;
  std::array<Plane, capacity> planes_;
  BoxOnMotion<Scalar> box_;
  bool knows_heights_ = false;  // of the tool at the end of the last motion
  Matrix3<Scalar> axes_at_end_;  // of the tool there
  Vector3<Scalar> shift_;  // to there from where it began [m]
  FeatureCache features_;
  ToolPlanes<Scalar> with_tool_;
  PartedLeaves<Scalar> leaves_;
};

}  // namespace feeler
