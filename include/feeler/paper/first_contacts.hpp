// First principal contacts: where collision detection says that tool and object meet (paper, section III.C).
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/object/triangle_query.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// A first principal contact (FPC): a triangle, and the features of it and of the tool that meet.
///
/// `features` lists pairs of tool vertex and triangle corner; the tool's feature is a vertex, edge or face by the number of different
/// vertices in it, the triangle's likewise.
template <class Scalar>
struct FirstContact {
  int triangle = -1;
  Vector3<Scalar> normal_world = Vector3<Scalar>::Zero();  ///< from the triangle to the tool
  WitnessFeatures features;
};

/// Contact of one tool vertex with the inside of a triangle.
template <class Scalar>
FirstContact<Scalar> vertex_on_triangle(int tool_vertex, int triangle, const Vector3<Scalar>& normal_world) noexcept {
  using std::abs;
  FirstContact<Scalar> contact{triangle, normal_world, {}};
  contact.features.size = 3;
  contact.features.tool_vertices.fill(short(tool_vertex));
  contact.features.corners = {0, 1, 2};
  return contact;
}

/// The paper's simple continuous collision detection: the first triangle that a tool vertex crosses on its straight way between two poses.
///
/// Sees neither edges that cross edges nor corners of the object that enter a face of the tool. A vertex that comes through between two
/// triangles, to rounding, meets both.
/// @param from, to  poses of the tool frame
/// @return a contact with `triangle` −1 if no vertex crosses any
template <ConvexTool Tool, class MeshScalar>
FirstContact<typename Tool::Scalar> first_vertex_hit(const Tool& tool, const TriangleMesh<MeshScalar>& mesh, const Pose<typename Tool::Scalar>& from,
                                                     const Pose<typename Tool::Scalar>& to) noexcept {
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  constexpr Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();
  FirstContact<Scalar> first;
  Scalar earliest(1);
  for (int i = 0; i < tool.vertex_count(); ++i) {
    const Vector start = from * tool.vertex(i);
    const Vector way = to * tool.vertex(i) - start;
    Eigen::AlignedBox<Scalar, 3> box(start);
    box.extend(Vector(start + way));
    visit_triangles_in<Scalar>(mesh, box, [&](int triangle) {
      const Matrix3<Scalar> corners = mesh.corners(triangle).template cast<Scalar>().colwise() - start;
      const Vector normal = (corners.col(1) - corners.col(0)).cross(Vector(corners.col(2) - corners.col(0)));
      const Scalar speed = normal.dot(way), height = normal.dot(corners.col(0));
      const Scalar extent = corners.cwiseAbs().maxCoeff() + way.cwiseAbs().maxCoeff();
      const Scalar flat = rounding * extent * normal.norm();
      // From the side it starts on to the other; a start in the plane, to rounding, counts for both.
      const Scalar ahead = speed > Scalar(0) ? height : -height;
      if (speed == Scalar(0) || ahead < -flat || ahead > earliest * abs(speed) + flat) return true;
      const Scalar time = std::clamp(height / speed, Scalar(0), earliest);
      const Scalar outside = -extent * flat;
      for (int k = 0; k < 3; ++k) {
        const Vector a = corners.col(k) - time * way, b = corners.col((k + 1) % 3) - time * way;
        if (a.cross(b).dot(normal) < outside) return true;
      }
      if (time < earliest || first.triangle < 0) {
        earliest = time;
        first = vertex_on_triangle<Scalar>(i, triangle, Vector(speed > Scalar(0) ? -normal : normal));
      }
      return true;
    });
  }
  return first;
}

/// Triangles that a tool overlaps at one pose, as a collision query of two meshes gives them.
struct OverlappedTriangles {
  static constexpr int capacity = 96;

  FixedVector<int, capacity> triangles;
  bool is_complete = true;  ///< false when more were overlapped than there is room for
};

/// @param pose   of the tool frame
/// @param touching_distance  see `gjk` [m]
/// @cost noexcept, no allocation; a distance query for every triangle in the tool's bounding box
template <ConvexTool Tool, class MeshScalar>
OverlappedTriangles overlapped_triangles(const Tool& tool, const TriangleMesh<MeshScalar>& mesh, const Pose<typename Tool::Scalar>& pose,
                                         typename Tool::Scalar touching_distance) noexcept {
  using Scalar = typename Tool::Scalar;
  OverlappedTriangles found;
  Eigen::AlignedBox<Scalar, 3> box;
  for (int i = 0; i < tool.vertex_count(); ++i) box.extend(pose * tool.vertex(i));
  const Matrix3<Scalar> axes = pose.rotation.toRotationMatrix();
  visit_triangles_in<Scalar>(mesh, box, [&](int triangle) {
    const Matrix3<Scalar> corners = mesh.corners(triangle).template cast<Scalar>();
    const Matrix3<Scalar> in_tool = axes.transpose() * (corners.colwise() - pose.translation);
    if (!gjk(tool, in_tool, {}, touching_distance).is_touching) return true;
    found.is_complete = found.triangles.push_back(triangle);
    return found.is_complete;
  });
  return found;
}

}  // namespace feeler
