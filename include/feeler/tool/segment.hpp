// The thinnest tool: a straight line between two points.
#pragma once

#include <string>

#include "feeler/core/requirement.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/symmetry.hpp"

namespace feeler {

/// A line tool: two vertices, one edge, no face. Coordinates are in the tool frame [m].
template <RealScalar Scalar_>
class Segment {
 public:
  using Scalar = Scalar_;
  static constexpr Symmetry symmetry = Symmetry::about_axis;

  /// Refuses ends that are equal or not finite.
  Segment(const Vector3<Scalar>& start, const Vector3<Scalar>& end) : start_(start), end_(end) { refuse_for(reason_against(start, end)); }
  static std::string reason_against(const Vector3<Scalar>& start, const Vector3<Scalar>& end) {
    if (!start.allFinite() || !end.allFinite()) return "Segment: an end has a NaN or an infinity; give two finite points";
    if (start == end) return "Segment: both ends are the same point; give two different points";
    return {};
  }

  int vertex_count() const noexcept { return 2; }
  const Vector3<Scalar>& vertex(int i) const noexcept { return i == 0 ? start_ : end_; }
  /// @cost two dot products; exact comparison, so nearly equal ends may go either way
  int support(const Vector3<Scalar>& direction) const noexcept { return direction.dot(end_) > direction.dot(start_) ? 1 : 0; }

  int edge_count() const noexcept { return 1; }
  ToolEdge edge(int) const noexcept { return {0, 1}; }
  int face_count() const noexcept { return 0; }
  ToolFace<Scalar> face(int) const noexcept { return {}; }
  int edge_direction_count() const noexcept { return 1; }
  Vector3<Scalar> edge_direction(int) const noexcept { return end_ - start_; }
  int face_axis_count() const noexcept { return 0; }
  Vector3<Scalar> face_axis(int) const noexcept { return Vector3<Scalar>::Zero(); }

  /// The same segment in another scalar; ends that become equal there are refused.
  template <class Other>
  Segment<Other> cast() const {
    return Segment<Other>(start_.template cast<Other>(), end_.template cast<Other>());
  }

 private:
  Vector3<Scalar> start_;
  Vector3<Scalar> end_;
};

static_assert(ConvexTool<Segment<double>>);

}  // namespace feeler
