// The surface of an object around a triangle that a tool is close to: what tells a contact from a ghost.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/normal_cone.hpp"
#include "feeler/object/surface_walk.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/gjk.hpp"

namespace feeler {

/// Where on a triangle the closest point to a tool is.
struct PlaceOnTriangle {
  int corners;  ///< that it is between; of overlapping shapes none
  int index;    ///< of the corner, if one, or the edge, if two
};
template <RealScalar Scalar>
PlaceOnTriangle place_on_triangle(const ClosestPoints<Scalar>& closest) noexcept {
  std::array<bool, 3> used{};
  for (std::size_t i = 0; i < std::size_t(closest.features.size); ++i) used[std::size_t(closest.features.corners[i])] = true;
  const int count = int(used[0]) + int(used[1]) + int(used[2]);
  if (count == 1) return {count, used[0] ? 0 : used[1] ? 1 : 2};
  return {count, !used[2] ? 0 : !used[0] ? 1 : 2};
}

/// The mesh around one of its triangles, asked in the frame of a tool.
///
/// A contact whose normal lies outside the normal cone of the mesh there is a ghost: a neighbour is nearer.
template <RealScalar Scalar, RealScalar MeshScalar>
class SurfaceAround {
 public:
  using Vector = Vector3<Scalar>;

  /// Sine by which a direction may leave a cone, or a plane another one.
  inline static const Scalar tolerance = Scalar(1e-6);

  /// @param world_from_tool  axes of the tool, kept by reference
  /// @param seam             a point so little beside a face counts as over it [m]
  SurfaceAround(const TriangleMesh<MeshScalar>& mesh, const Matrix3<Scalar>& world_from_tool, Scalar seam) noexcept
      : mesh_(mesh), world_from_tool_(world_from_tool), seam_(seam) {}

  void stand_on(int triangle) noexcept { triangle_ = triangle; }

  const TriangleMesh<MeshScalar>& mesh() const noexcept { return mesh_; }
  /// That the triangle belongs to, or -1.
  int wall() const noexcept { return mesh_.walls().of_triangle(triangle_); }
  /// @param point   in the tool frame [m]
  /// @param corner  there, the triangle's first [m]
  Vector in_world(const Vector& point, const Vector& corner) const noexcept {
    return world_from_tool_ * (point - corner) + mesh_.vertex(mesh_.triangle(triangle_)[0]).template cast<Scalar>();
  }
  /// Whether the surface goes on in the same plane.
  bool is_flat_across(int edge) const noexcept {
    return mesh_.topology().edge_convexity(triangle_, edge) == Convexity::flat ||
           (wall() >= 0 && neighbour(edge) >= 0 && mesh_.walls().of_triangle(neighbour(edge)) == wall());
  }
  /// Whether a corner of the triangle lies inside of its wall, where it is no corner of the surface.
  bool is_inside_wall(int corner) const noexcept { return mesh_.walls().is_inside(mesh_.triangle(triangle_)[std::size_t(corner)]); }
  /// Whether all of them do: then only tool vertices over the wall touch it here.
  bool is_inside_wall() const noexcept { return is_inside_wall(0) && is_inside_wall(1) && is_inside_wall(2); }
  /// Across an edge; negative where there is not exactly one.
  int neighbour(int edge) const noexcept { return mesh_.topology().neighbour(triangle_, edge); }

  /// Whether a normal is in the normal cone of the mesh at a corner, or an edge.
  bool is_in_vertex_cone(int corner, const Vector& normal) const noexcept {
    return vertex_cone_contains(mesh_, mesh_.triangle(triangle_)[std::size_t(corner)], direction_of(normal), MeshScalar(tolerance));
  }
  bool is_in_edge_cone(int edge, const Vector& normal) const noexcept {
    return edge_cone_contains(mesh_, triangle_, edge, direction_of(normal), MeshScalar(tolerance));
  }
  // In a patch the triangle itself may rise a little from one of its features to the next; both hold the tool. Its neighbours may not.
  bool is_clear_of_neighbours_at_corner(int corner, const Vector& normal) const noexcept {
    return neighbours_point_away(mesh_, triangle_, corner, direction_of(normal), MeshScalar(tolerance));
  }
  bool is_clear_of_neighbour_across(int edge, const Vector& normal) const noexcept {
    return neighbour_points_away(mesh_, triangle_, edge, direction_of(normal), MeshScalar(tolerance));
  }
  /// A neighbour that is nearer to a tool in the direction of a normal outside the cone, or -1.
  int nearer_neighbour(const PlaceOnTriangle& place, const Vector& normal) const noexcept {
    if (place.corners == 1) return triangle_along(mesh_, triangle_, place.index, direction_of(normal));
    if (place.corners == 2) return (std::max)(neighbour(place.index), -1);
    return -1;
  }

  /// Whether a point that may lie beside the triangle is over the wall that it belongs to; past its rim nothing holds.
  /// @param corner  the triangle's first [m]
  FEELER_FLATTEN bool is_under(const Vector& point, const Vector& corner) const noexcept { return find_under(point, corner) >= 0; }

  /// The other triangle of the wall that a point is over, or for one beside the wall that at the rim where a walk to it ends; -1 if that ends at
  /// once.
  /// @param corner  the triangle's first [m]
  int triangle_under(const Vector& point, const Vector& corner) const noexcept {
    int triangle = find_under(point, corner);
    if (triangle < 0) triangle = walk_towards(in_world(point, corner));
    return triangle != triangle_ ? triangle : -1;
  }

  /// Whether the mesh rises from the plane of the triangle, on the side of a normal, across an edge.
  bool rises_across(int edge, const Vector& normal) const noexcept {
    const int other = neighbour(edge);
    if (other < 0) return false;
    const Vector normal_world = world_from_tool_ * normal;
    const Vector start_world = mesh_.vertex(mesh_.triangle(triangle_)[std::size_t(edge)]).template cast<Scalar>();
    const auto& corners = mesh_.triangle(other);
    return std::any_of(corners.begin(), corners.end(), [&](int corner) {
      const Vector along = mesh_.vertex(corner).template cast<Scalar>() - start_world;
      return normal_world.dot(along) > tolerance * along.norm();
    });
  }
  /// Whether a ray from a corner leads under another triangle there, in a view along a line; the arguments as there.
  bool leads_under_a_neighbour(int corner, const Vector& ray, const Vector& upward) const noexcept {
    return feeler::leads_under_a_neighbour(mesh_, triangle_, corner, direction_of(ray), direction_of(upward), MeshScalar(tolerance));
  }

 private:
  /// The triangle of the wall, or this one where it is in none, that a point is over, or -1.
  int find_under(const Vector& point, const Vector& corner) const noexcept {
    const Vector point_world = in_world(point, corner);
    if (edge_towards(mesh_, triangle_, point_world, seam_) < 0) return triangle_;
    return wall() >= 0 ? triangle_of_wall_under(mesh_, wall(), point_world, seam_) : -1;
  }

  /// Where a walk over the wall to a point ends: at the rim, or after some triangles.
  int walk_towards(const Vector& point_world) const noexcept {
    constexpr int longest_walk = 16;
    int triangle = triangle_;
    for (int step = 0; step < longest_walk; ++step) {
      const int edge = edge_towards(mesh_, triangle, point_world, seam_);
      const int next = edge >= 0 ? mesh_.topology().neighbour(triangle, edge) : -1;
      if (next < 0 || wall() < 0 || mesh_.walls().of_triangle(next) != wall()) break;
      triangle = next;
    }
    return triangle;
  }
  Vector3<MeshScalar> direction_of(const Vector& normal) const noexcept { return (world_from_tool_ * normal).template cast<MeshScalar>(); }

  const TriangleMesh<MeshScalar>& mesh_;
  const Matrix3<Scalar>& world_from_tool_;
  Scalar seam_;
  int triangle_ = -1;
};

}  // namespace feeler
