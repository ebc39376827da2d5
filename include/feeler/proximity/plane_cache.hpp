// A few planes that kept parting the tool from its surroundings, tried before anything is measured.
#pragma once

#include <array>
#include <cmath>

#include "feeler/core/scalar.hpp"
#include "feeler/proximity/age_planes.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/feature_cache.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/tool_planes.hpp"

namespace feeler {

/// How low the tool comes along a world normal on a motion: the heights of its lowest point, relative to the motion's origin [m].
///
/// With heights A, B at the ends and a sagitta g, the tool stays above every height that is s below the lower of them where
/// √s + √(s + |A − B|) ≥ 2√g.
template <class Scalar>
struct PlaneOnMotion {
  Vector3<Scalar> normal;
  Scalar start = Scalar(0);  // height at the start, time 0
  Scalar least = Scalar(0);  // below which it does not come
  Scalar last = Scalar(0);   // height at the end

  template <class Moving>
  void begin(const Moving& moving, const MotionFrame<Scalar>& frame) noexcept {
    start = moving.lowest(normal, frame);
  }
  /// Begins a motion where the last one ended, a shift away from where that began.
  void go_on(const Vector3<Scalar>& shift) noexcept { start = last - normal.dot(shift); }
  template <class Moving>
  void end(const Moving& moving, const MotionFrame<Scalar>& frame) noexcept {
    using std::sqrt;
    last = moving.lowest(normal, frame);
    const Scalar sagitta = moving.sagitta(normal, frame.time);
    const Scalar difference = start < last ? last - start : start - last;
    Scalar slack(0);
    if (difference < 4 * sagitta) {
      const Scalar root = sqrt(sagitta) - difference / (4 * sqrt(sagitta));
      slack = root * root;
    }
    least = (start < last ? start : last) - slack;
  }
  /// Whether it parts the tool over the whole motion from what is up to `height` high along it, though it may not be `kept` away.
  bool parts_closely(Scalar height, const Clearance<Scalar>& clearance) const noexcept {
    const Scalar slack = least - height;
    return slack >= -2 * clearance.allowance && slack >= clearance.required(start - height);
  }
};

/// World normals of separating planes, from tick to tick, and their limits over the motion at hand; and where queries about triangles that
/// none of them passed may start.
///
/// A plane with normal n parts the tool from every y with n·y ≤ limit over the whole motion. A cache belongs to one tool and one mesh.
/// Against a wall that the tool touches no plane keeps that distance; there `parts_closely` asks for no more than there was at the start.
template <class ScalarType>
class PlaneCache {
 public:
  using Scalar = ScalarType;
  static constexpr int capacity = 12;

  int size() const noexcept { return size_; }
  const Vector3<Scalar>& normal(int i) const noexcept { return planes_[index(i)].normal; }
  Scalar limit(int i) const noexcept { return planes_[index(i)].limit; }
  void count_hits(int i, int hits) noexcept { planes_[index(i)].hits += hits; }
  void clear() noexcept {
    size_ = 0;
    knows_heights_ = false;
    features_.clear();
    with_tool_.clear();
  }
  /// Those fixed to the tool.
  ToolPlanes<Scalar>& with_tool() noexcept { return with_tool_; }
  /// Of the triangles that no plane passed.
  FeatureCache& features() noexcept { return features_; }

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
    plane.hits = 2;
    plane.begin(moving, start);
    plane.end(moving, end, kept);
    return place;
  }

  /// Whether a plane parts the tool over the whole motion from what is up to `height` high along it, though it may not be `kept` away.
  bool parts_closely(int i, Scalar height, const Clearance<Scalar>& clearance) const noexcept {
    return planes_[index(i)].parts_closely(height, clearance);
  }

  /// Finds the heights at the start of a motion; they are known where the last one ended.
  template <class Moving>
  void begin(const Moving& moving, const MotionFrame<Scalar>& start) noexcept {
    const Pose<Scalar>& pose = moving.pose();
    const bool goes_on = knows_heights_ && pose.translation == end_.translation && pose.rotation.coeffs() == end_.rotation.coeffs();
    const auto begin_plane = [&](PlaneOnMotion<Scalar>& plane) { goes_on ? plane.go_on(shift_) : plane.begin(moving, start); };
    for (int i = 0; i < size_; ++i) begin_plane(planes_[index(i)]);
    for (auto& side : sides_) begin_plane(side);
  }
  /// Finds the limits for a motion that ends at a frame, and may have ended later before.
  template <class Moving>
  void end(const Moving& moving, const MotionFrame<Scalar>& end, Scalar kept) noexcept {
    for (int i = 0; i < size_; ++i) planes_[index(i)].end(moving, end, kept);
    for (auto& side : sides_) side.end(moving, end);
    end_ = moving.pose_at(end.time);
    shift_ = end.shift;
    knows_heights_ = true;
  }
  /// The sides of a box along the world axes around the motion, −x x −y y −z z: their normals point into it.
  const std::array<PlaneOnMotion<Scalar>, 6>& sides() const noexcept { return sides_; }
  /// Halves the hits and brings the most useful planes to the front.
  void age() noexcept { detail::age_planes(planes_, size_); }

 private:
  static std::size_t index(int i) noexcept { return std::size_t(i); }

  struct Plane : PlaneOnMotion<Scalar> {
    Scalar limit;
    int hits = 0;

    template <class Moving>
    void end(const Moving& moving, const MotionFrame<Scalar>& frame, Scalar kept) noexcept {
      PlaneOnMotion<Scalar>::end(moving, frame);
      limit = this->least - kept;
    }
  };

  static std::array<PlaneOnMotion<Scalar>, 6> sides_of_box() noexcept {
    std::array<PlaneOnMotion<Scalar>, 6> sides;
    for (std::size_t i = 0; i < sides.size(); ++i) sides[i].normal = Vector3<Scalar>::Unit(int(i / 2)) * Scalar(i % 2 == 0 ? 1 : -1);
    return sides;
  }

  int size_ = 0;
  std::array<Plane, capacity> planes_;
  std::array<PlaneOnMotion<Scalar>, 6> sides_ = sides_of_box();
  bool knows_heights_ = false;  // of the tool at the end of the last motion
  Pose<Scalar> end_;            // there
  Vector3<Scalar> shift_;       // to there from where it began [m]
  FeatureCache features_;
  ToolPlanes<Scalar> with_tool_;
};

}  // namespace feeler
