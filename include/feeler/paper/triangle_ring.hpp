// The triangles around one, the planes that they lie in, and how these planes meet.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"

namespace feeler {

/// A triangle and those that share a corner with it, seen from the side that a tool is on. World axes [m].
///
/// The inside of a set of planes that meet in valleys and pits alone is convex: such sets are the pieces of the free space (paper, eq. 8).
template <RealScalar Scalar, RealScalar MeshScalar>
class TriangleRing {
 public:
  using Vector = Vector3<Scalar>;
  static constexpr int capacity = 48, plane_capacity = 24;

  /// The plane of some triangles of the ring.
  struct Plane {
    int triangle = -1;
    Vector normal = Vector::Zero();  // towards the tool's side
    Vector point = Vector::Zero();
    std::uint64_t members = 0;  // which triangles of the ring lie in it
  };

  explicit TriangleRing(const TriangleMesh<MeshScalar>& mesh) noexcept : mesh_(mesh) {}

  /// The triangles that share a corner with one, itself first.
  static FixedVector<int, capacity> around(const TriangleMesh<MeshScalar>& mesh, int triangle) noexcept {
    FixedVector<int, capacity> result;
    result.push_back(triangle);
    const auto& corners = mesh.triangle(triangle);
    for (int i = 0; i < result.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const int other = mesh.topology().neighbour(result[i], k);
        if (other < 0 || std::find(result.begin(), result.end(), other) != result.end()) continue;
        const auto& theirs = mesh.triangle(other);
        const bool shares =
            std::any_of(theirs.begin(), theirs.end(), [&](int v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); });
        if (shares && !result.push_back(other)) return result;
      }
    }
    return result;
  }

  /// Finds the ring and its planes; how many triangles there was no room for, at least.
  /// @param is_behind  the tool is on the side that normals point away from: meshes may be open
  int find(int triangle, bool is_behind) noexcept {
    is_behind_ = is_behind;
    triangles_ = around(mesh_, triangle);
    return (triangles_.full() ? 1 : 0) + gather_planes();
  }

  const FixedVector<int, capacity>& triangles() const noexcept { return triangles_; }
  const FixedVector<Plane, plane_capacity>& planes() const noexcept { return planes_; }
  bool contains(int triangle) const noexcept { return std::find(triangles_.begin(), triangles_.end(), triangle) != triangles_.end(); }

  Vector corner(int triangle, int k) const noexcept { return mesh_.vertex(mesh_.triangle(triangle)[as_index(k)]).template cast<Scalar>(); }
  /// Seen from the tool; rims are convex.
  Convexity convexity(Convexity given) const noexcept {
    if (given == Convexity::boundary || given == Convexity::non_manifold) return Convexity::convex;
    if (!is_behind_ || given == Convexity::flat || given == Convexity::mixed) return given;
    return given == Convexity::convex ? Convexity::concave : Convexity::convex;
  }
  Convexity edge_convexity(int triangle, int k) const noexcept { return convexity(mesh_.topology().edge_convexity(triangle, k)); }

  /// A plane and, one after the other, those that join the set in valleys and meet none of it on a ridge, as a bit for each.
  /// @param may_join  of a plane
  template <class MayJoin>
  std::uint64_t convex_piece(int seed, const MayJoin& may_join) const noexcept {
    std::uint64_t set = std::uint64_t(1) << seed;
    for (bool grows = true; grows;) {
      grows = false;
      for (int j = 0; j < planes_.size(); ++j) {
        if ((set >> j & 1u) != 0 || !may_join(planes_[j])) continue;
        bool joins = false, is_apart = false;
        for (int i = 0; i < planes_.size(); ++i) {
          if ((set >> i & 1u) == 0) continue;
          joins = joins || meet(planes_[i], planes_[j], Convexity::concave);
          is_apart = is_apart || meet(planes_[i], planes_[j], Convexity::convex);
        }
        if (!joins || is_apart) continue;
        set |= std::uint64_t(1) << j;
        grows = true;
      }
    }
    return set;
  }

  /// Whether a point is past a ridge where a plane ends, by more than a distance [m].
  bool is_past_ridge(const Plane& plane, const Vector& point, Scalar distance) const noexcept {
    for (int i = 0; i < triangles_.size(); ++i) {
      if (!has_member(plane, i)) continue;
      const Vector normal = mesh_.normal(triangles_[i]).template cast<Scalar>();
      for (int k = 0; k < 3; ++k) {
        if (edge_convexity(triangles_[i], k) != Convexity::convex) continue;
        const Vector start = corner(triangles_[i], k);
        const Vector outside = (corner(triangles_[i], (k + 1) % 3) - start).cross(normal).normalized();
        if (outside.dot(point - start) > distance) return true;
      }
    }
    return false;
  }

 private:
  static bool has_member(const Plane& plane, int i) noexcept { return (plane.members >> i & 1u) != 0; }

  Vector outward(int triangle) const noexcept {
    const Vector normal = mesh_.normal(triangle).template cast<Scalar>();
    return is_behind_ ? Vector(-normal) : normal;
  }

  /// How many triangles there was no room for.
  int gather_planes() noexcept {
    using std::abs;
    planes_.clear();
    int dropped = 0;
    constexpr Scalar parallel = Scalar(1e-9);
    for (int i = 0; i < triangles_.size(); ++i) {
      const Vector normal = outward(triangles_[i]);
      if (normal.isZero()) continue;
      const Vector point = corner(triangles_[i], 0);
      auto same = std::find_if(planes_.begin(), planes_.end(), [&](const Plane& plane) {
        const Vector between = point - plane.point;
        return (plane.normal - normal).squaredNorm() < parallel * parallel && abs(plane.normal.dot(between)) <= parallel * between.norm();
      });
      if (same == planes_.end()) {
        if (!planes_.push_back({triangles_[i], normal, point, 0})) {
          ++dropped;
          continue;
        }
        same = planes_.end() - 1;
      }
      same->members |= std::uint64_t(1) << i;
    }
    return dropped;
  }

  /// Whether two planes meet in a valley or a pit, or on a ridge or a tip.
  bool meet(const Plane& a, const Plane& b, Convexity shape) const noexcept {
    for (int i = 0; i < triangles_.size(); ++i) {
      if (!has_member(a, i)) continue;
      for (int k = 0; k < 3; ++k) {
        const int other = mesh_.topology().neighbour(triangles_[i], k);
        if (other >= 0 && edge_convexity(triangles_[i], k) == shape && has_triangle(b, other)) return true;
        const int vertex = mesh_.triangle(triangles_[i])[as_index(k)];
        const Convexity at_vertex = mesh_.topology().vertex_convexity(vertex);
        if (at_vertex != Convexity::boundary && convexity(at_vertex) == shape && has_vertex(b, vertex)) return true;
      }
    }
    return false;
  }
  bool has_triangle(const Plane& plane, int triangle) const noexcept {
    const auto place = std::find(triangles_.begin(), triangles_.end(), triangle);
    return place != triangles_.end() && has_member(plane, int(place - triangles_.begin()));
  }
  bool has_vertex(const Plane& plane, int vertex) const noexcept {
    for (int i = 0; i < triangles_.size(); ++i) {
      if (!has_member(plane, i)) continue;
      const auto& corners = mesh_.triangle(triangles_[i]);
      if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) return true;
    }
    return false;
  }

  const TriangleMesh<MeshScalar>& mesh_;
  bool is_behind_ = false;
  FixedVector<int, capacity> triangles_;
  FixedVector<Plane, plane_capacity> planes_;
};

}  // namespace feeler
