// The smallest tool: a point, and the core of a sphere.
#pragma once

#include <string>

#include "feeler/core/requirement.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/symmetry.hpp"

namespace feeler {

/// A tool of one vertex, without edges or faces: the god-object of three-degree-of-freedom rendering. In the tool frame [m].
template <RealScalar Scalar_>
class Point {
 public:
  using Scalar = Scalar_;
  static constexpr Symmetry symmetry = Symmetry::about_point;

  /// The origin of the tool frame.
  Point() = default;
  /// Refuses a position that is not finite.
  explicit Point(const Vector3<Scalar>& position) : position_(position) { refuse_for(reason_against(position)); }
  static std::string reason_against(const Vector3<Scalar>& position) {
    return position.allFinite() ? "" : "Point: the position has a NaN or an infinity; give a finite one";
  }

  int vertex_count() const noexcept { return 1; }
  const Vector3<Scalar>& vertex(int) const noexcept { return position_; }
  int support(const Vector3<Scalar>&) const noexcept { return 0; }

  int edge_count() const noexcept { return 0; }
  ToolEdge edge(int) const noexcept { return {}; }
  int face_count() const noexcept { return 0; }
  ToolFace<Scalar> face(int) const noexcept { return {}; }
  int edge_direction_count() const noexcept { return 0; }
  Vector3<Scalar> edge_direction(int) const noexcept { return Vector3<Scalar>::Zero(); }
  int face_axis_count() const noexcept { return 0; }
  Vector3<Scalar> face_axis(int) const noexcept { return Vector3<Scalar>::Zero(); }

  template <class Other>
  Point<Other> cast() const {
    return Point<Other>(position_.template cast<Other>());
  }

 private:
  Vector3<Scalar> position_ = Vector3<Scalar>::Zero();
};

static_assert(ConvexTool<Point<double>>);
static_assert(symmetry_of<Point<double>> == Symmetry::about_point);

}  // namespace feeler
