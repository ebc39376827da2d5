// A box along the axes of the tool frame, centred at its origin.
#pragma once

#include <array>
#include <string>

#include "feeler/core/requirement.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// A box given by half of its sides [m]. Bit k of a vertex's index is set where its coordinate k is positive.
template <RealScalar Scalar_>
class Box {
 public:
  using Scalar = Scalar_;

  /// Refuses half extents that are not positive and finite.
  explicit Box(const Vector3<Scalar>& half_extents) : half_extents_(half_extents) { refuse_for(reason_against(half_extents)); }
  static std::string reason_against(const Vector3<Scalar>& half_extents) {
    if (!half_extents.allFinite()) return "Box: a half extent is a NaN or an infinity; give three finite lengths";
    if (!(half_extents.minCoeff() > Scalar(0))) return "Box: a half extent is zero or negative; give three positive lengths, or use a flatter tool";
    return {};
  }

  const Vector3<Scalar>& half_extents() const noexcept { return half_extents_; }

  int vertex_count() const noexcept { return 8; }
  Vector3<Scalar> vertex(int i) const noexcept {
    return {(i & 1) != 0 ? half_extents_.x() : -half_extents_.x(), (i & 2) != 0 ? half_extents_.y() : -half_extents_.y(),
            (i & 4) != 0 ? half_extents_.z() : -half_extents_.z()};
  }
  /// @cost constant: the signs of the direction
  int support(const Vector3<Scalar>& direction) const noexcept {
    return int(direction.x() > Scalar(0)) | int(direction.y() > Scalar(0)) << 1 | int(direction.z() > Scalar(0)) << 2;
  }

  int edge_count() const noexcept { return 12; }
  ToolEdge edge(int i) const noexcept { return edges_[std::size_t(i)]; }
  int face_count() const noexcept { return 6; }
  ToolFace<Scalar> face(int i) const noexcept { return {Vector3<Scalar>::Unit(i / 2) * Scalar(i % 2 == 0 ? -1 : 1), faces_[std::size_t(i)]}; }
  int edge_direction_count() const noexcept { return 3; }
  Vector3<Scalar> edge_direction(int i) const noexcept { return Vector3<Scalar>::Unit(i); }
  int face_axis_count() const noexcept { return 3; }
  Vector3<Scalar> face_axis(int i) const noexcept { return Vector3<Scalar>::Unit(i); }

  template <class Other>
  Box<Other> cast() const {
    return Box<Other>(half_extents_.template cast<Other>());
  }

 private:
  static constexpr std::array<ToolEdge, 12> edges_{{{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  static constexpr std::array<std::array<int, 4>, 6> faces_{{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

  Vector3<Scalar> half_extents_;
};

static_assert(ConvexTool<Box<double>>);

}  // namespace feeler
