// A triangle of an object in the frame of a tool that is close to it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "feeler/core/scalar.hpp"
#include "feeler/object/surface_walk.hpp"

namespace feeler {

/// Corners, edges and face of a triangle, as the tool that is close to it measures its features against them. The face has the side on which the
/// tool is; a sliver has none.
///
/// All in the tool frame.
template <RealScalar Scalar>
class PatchTriangle {
 public:
  using Vector = Vector3<Scalar>;

  /// Features whose own normal differs more from the contact's belong to another part of the surface.
  inline static const Scalar least_cosine = Scalar(9) / 10;

  /// Face and side of a triangle; its edges are not known yet.
  /// @param corners  one corner in each column [m]
  /// @param normal   unit, of the plane that parts it and the tool, to the tool
  void set(const Matrix3<Scalar>& corners, const Vector& normal) noexcept {
    using std::sqrt;
    const Scalar least_sine = 64 * std::numeric_limits<Scalar>::epsilon();
    corners_ = corners;
    const Vector edge0 = corners_.col(1) - corners_.col(0);
    const Vector edge1 = corners_.col(2) - corners_.col(0);
    const Vector cross = edge0.cross(edge1);
    const Scalar squared_area = cross.squaredNorm();
    has_face_ = squared_area > least_sine * least_sine * edge0.squaredNorm() * edge1.squaredNorm();
    faces_tool_ = false;
    if (has_face_) {
      face_normal_ = cross / sqrt(squared_area);
      const Scalar cosine = face_normal_.dot(normal);
      side_ = cosine < Scalar(0) ? Scalar(-1) : Scalar(1);
      faces_tool_ = side_ * cosine >= least_cosine;
    }
  }
  void measure_edges() noexcept {
    for (int k = 0; k < 3; ++k) {
      edges_[std::size_t(k)] = corners_.col((k + 1) % 3) - corners_.col(k);
      edge_lengths_[std::size_t(k)] = edges_[std::size_t(k)].norm();
    }
  }

  const Matrix3<Scalar>& corners() const noexcept { return corners_; }
  Vector corner(int k) const noexcept { return corners_.col(k); }
  /// From a corner to the next, once edges are measured, and its length [m].
  const Vector& edge(int k) const noexcept { return edges_[std::size_t(k)]; }
  const Scalar& edge_length(int k) const noexcept { return edge_lengths_[std::size_t(k)]; }

  bool has_face() const noexcept { return has_face_; }
  /// Whether the normal of the contact is about that of the face.
  bool faces_tool() const noexcept { return faces_tool_; }
  /// Unit, by the order of the corners.
  const Vector& face_normal() const noexcept { return face_normal_; }
  /// The same to the side of the tool.
  Vector outward() const noexcept { return side_ * face_normal_; }
  /// Whether a plane that parts it and the tool is its own.
  bool has_plane(const Vector& normal, Scalar tolerance) const noexcept { return faces_tool_ && (side_ * face_normal_ - normal).norm() < tolerance; }

  /// Of a point above the face, on the side of the tool [m].
  Scalar height_of(const Vector& point) const noexcept { return side_ * face_normal_.dot(point - corners_.col(0)); }
  /// How far inside an edge a point is, seen along the normal of the face [m].
  Scalar room_inside(int k, const Vector& point) const noexcept {
    return area_inside<Scalar>(corners_.col(k), edge(k), point, face_normal_) / edge_length(k);
  }
  /// The squares of the sides that meet in its first corner, the longer one [m²].
  Scalar squared_size() const noexcept {
    return (std::max)((corners_.col(1) - corners_.col(0)).squaredNorm(), (corners_.col(2) - corners_.col(0)).squaredNorm());
  }

 private:
  Matrix3<Scalar> corners_;
  std::array<Vector, 3> edges_;
  std::array<Scalar, 3> edge_lengths_;
  bool has_face_ = false;
  bool faces_tool_ = false;
  Vector face_normal_ = Vector::Zero();
  Scalar side_ = Scalar(1);
};

}  // namespace feeler
