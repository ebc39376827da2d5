// The planes of a sweep in single precision, held against the boxes and the triangles of a hierarchy, four and more at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "feeler/core/lane_reductions.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/object/bvh.hpp"

namespace feeler {

/// Planes with normals n and limits, and the sides of a box. A plane passes what is below it, n·y ≤ limit for every y of a box or a
/// triangle; the sides pass boxes that are beyond one of them. Rounding makes it pass less, never more.
/// @tparam lanes  how many are computed side by side: 4, 2 or 1; the answers are the same
template <class Scalar, int capacity, int lanes = (std::min)(BvhNode::width, detail::lanes_of<float>)>
class CoarsePlanes {
 public:
  static constexpr int width = BvhNode::width;
  /// Of the boxes of a node, or the triangles of a leaf: not 0 where one has passed.
  using Passed = std::array<std::int32_t, std::size_t(width)>;

  /// @param to_boxes  what limits and sides are relative to, from the origin of the hierarchy [m]
  /// @param extent    diagonal of the mesh [m]
  void begin(const Vector3<Scalar>& to_boxes, Scalar extent) noexcept {
    to_boxes_ = to_boxes;
    extent_ = float(extent);
  }

  void set_sides(int axis, Scalar lower, Scalar upper) noexcept {
    const auto k = std::size_t(axis);
    lower_[k] = detail::spread<Group>(rounded_down(lower + to_boxes_[axis]));
    upper_[k] = detail::spread<Group>(-rounded_down(-upper - to_boxes_[axis]));
  }
  /// @param normal  unit
  void set_plane(int i, const Vector3<Scalar>& normal, Scalar limit) noexcept {
    Plane& plane = planes_[std::size_t(i)];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto component = float(normal[int(k)]);
      plane.normal[k] = detail::spread<Group>(component);
      plane.farthest[k] = component > 0 ? &BvhNode::upper : &BvhNode::lower;
    }
    plane.limit = detail::spread<Group>(rounded_down(limit + normal.dot(to_boxes_)));
  }
  /// Calls `count_hits(i, hits)` for each of the first `count` planes: of what has not passed those before it, how much it has since this was last
  /// called. All planes held against boxes and triangles since then are among them.
  template <class CountHits>
  void take_hits(int count, const CountHits& count_hits) noexcept {
    int before = sum_of(beyond_);
    beyond_ = {};
    for (int i = 0; i < count; ++i) {
      Masks& passed = planes_[std::size_t(i)].passed;
      const int so_far = sum_of(passed);
      passed = {};
      count_hits(i, so_far - before);
      before = so_far;
    }
  }

  /// What has passed of some nodes; together they take less time than one after the other.
  /// @param count  of the planes that are held against them
  template <std::size_t n>
  std::array<Passed, n> passed(const std::array<const BvhNode*, n>& nodes, int count) noexcept {
    std::array<Masks, n> beyond{};
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t g = 0; g < groups; ++g) {
        for (std::size_t k = 0; k < 3; ++k)
          beyond[i][g] |= at_most(load(nodes[i]->upper[k], g), lower_[k]) | at_most(upper_[k], load(nodes[i]->lower[k], g));
        beyond_[g] -= beyond[i][g];
      }
    }
    return sift(beyond, count, [&nodes](const Plane& plane, std::size_t i, std::size_t g) {
      const auto farthest = [&](std::size_t k) { return load((nodes[i]->*plane.farthest[k])[k], g); };
      return height(plane.normal, farthest(0), farthest(1), farthest(2));
    });
  }
  /// The same of some leaves.
  template <std::size_t n>
  std::array<Passed, n> passed(const std::array<const BvhLeaf*, n>& leaves, int count) noexcept {
    return sift(std::array<Masks, n>{}, count, [&leaves](const Plane& plane, std::size_t i, std::size_t g) {
      const auto height_of = [&](const auto& corner) { return height(plane.normal, load(corner[0], g), load(corner[1], g), load(corner[2], g)); };
      const auto& corner = leaves[i]->corner;
      return detail::greater(detail::greater(height_of(corner[0]), height_of(corner[1])), height_of(corner[2]));
    });
  }

 private:
  static constexpr std::size_t groups = std::size_t(width / lanes);
  using Group = detail::Lanes<float, lanes>;
  using Mask = detail::Lanes<std::int32_t, lanes>;
  using Masks = std::array<Mask, groups>;

  struct Plane {
    std::array<Group, 3> normal;
    Group limit;
    Masks passed{};  // how many, in each lane, had passed after it was held against them
    std::array<float (BvhNode::*)[3][width], 3> farthest;  // which side of a box it is along the normal, by axis
  };

  static Group load(const float* from, std::size_t group) noexcept { return detail::load<Group>(from + group * std::size_t(lanes)); }
  static Mask at_most(const Group& a, const Group& b) noexcept { return detail::at_most<float, lanes>(a, b); }
  static Group height(const std::array<Group, 3>& normal, const Group& x, const Group& y, const Group& z) noexcept {
    return detail::product(normal[0], x) + detail::product(normal[1], y) + detail::product(normal[2], z);
  }

  /// @param height_along  along a plane's normal, of box or triangle i, in group g of its lanes
  template <std::size_t n, class HeightAlong>
  std::array<Passed, n> sift(std::array<Masks, n> passed, int count, const HeightAlong& height_along) noexcept {
    for (int k = 0; k < count; ++k) {
      Plane& plane = planes_[std::size_t(k)];
#pragma GCC unroll 4
      for (std::size_t g = 0; g < groups; ++g) {
        Mask so_far = plane.passed[g];
#pragma GCC unroll 4
        for (std::size_t i = 0; i < n; ++i) {
          passed[i][g] |= at_most(height_along(plane, i, g), plane.limit);
          so_far -= passed[i][g];
        }
        plane.passed[g] = so_far;
      }
    }
    std::array<Passed, n> answers;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t g = 0; g < groups; ++g)
        std::ranges::copy(detail::in_lanes<std::int32_t>(passed[i][g]), answers[i].begin() + std::ptrdiff_t(g) * lanes);
    }
    return answers;
  }
  static int sum_of(const Masks& counts) noexcept {
    int sum = 0;
    for (const Mask& group : counts) {
      for (const std::int32_t lane : detail::in_lanes<std::int32_t>(group)) sum += lane;
    }
    return sum;
  }

  /// Gives away what the rounding of normals, corners and heights could gain: with a unit of u, 5u times half the extent at most.
  float rounded_down(Scalar value) const noexcept {
    const auto rounded = float(value);
    return rounded - std::numeric_limits<float>::epsilon() * (std::abs(rounded) + 2 * extent_);
  }

  Vector3<Scalar> to_boxes_;
  float extent_;
  std::array<Group, 3> lower_, upper_;
  Masks beyond_{};  // how many have been beyond a side
  std::array<Plane, std::size_t(capacity)> planes_;
};

}  // namespace feeler
