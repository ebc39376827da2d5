// What a shape must offer to be a tool: the vertices, edges and faces of a convex polyhedron, in the tool frame.
#pragma once

#include <concepts>
#include <span>
#include <utility>

#include "feeler/core/scalar.hpp"

namespace feeler {

/// An edge of a tool, as the indices of its two vertices.
struct ToolEdge {
  int start = 0;
  int end = 0;
};

/// A face of a tool: its outward unit normal in the tool frame, and its vertices counter-clockwise seen from outside.
template <class Scalar>
struct ToolFace {
  Vector3<Scalar> normal = Vector3<Scalar>::Zero();
  std::span<const int> vertices;
};

/// A convex polyhedron, possibly flat or thin, given by its features. All coordinates are in the tool frame [m].
///
/// `support(direction)` is the index of a vertex farthest along a direction that need not be unit; ties are free.
/// `edge_direction(i)`, i < `edge_direction_count()`, lists the directions of the edges without repeating parallel ones (any length, any sign),
/// `face_axis(i)`, i < `face_axis_count()`, the face normals without repeating opposite ones: separating axes need no more.
/// All calls are noexcept, allocate nothing, and cost O(vertex_count) at most.
template <class T>
concept ConvexTool = RealScalar<typename T::Scalar> && requires(const T& tool, const Vector3<typename T::Scalar>& direction, int i) {
  { tool.vertex_count() } noexcept -> std::same_as<int>;
  { tool.vertex(i) } noexcept -> std::convertible_to<Vector3<typename T::Scalar>>;
  { tool.support(direction) } noexcept -> std::same_as<int>;
  { tool.edge_count() } noexcept -> std::same_as<int>;
  { tool.edge(i) } noexcept -> std::convertible_to<ToolEdge>;
  { tool.face_count() } noexcept -> std::same_as<int>;
  { tool.face(i) } noexcept -> std::convertible_to<ToolFace<typename T::Scalar>>;
  { tool.edge_direction_count() } noexcept -> std::same_as<int>;
  { tool.edge_direction(i) } noexcept -> std::convertible_to<Vector3<typename T::Scalar>>;
  { tool.face_axis_count() } noexcept -> std::same_as<int>;
  { tool.face_axis(i) } noexcept -> std::convertible_to<Vector3<typename T::Scalar>>;
};

/// The support function of a tool, max direction · x over its points x, of a swept tool over its core [m]. A tool that finds it faster than the
/// vertex has a member `highest(direction)`.
template <ConvexTool Tool>
typename Tool::Scalar highest_along(const Tool& tool, const Vector3<typename Tool::Scalar>& direction) noexcept {
  if constexpr (requires { tool.highest(direction); }) {
    return tool.highest(direction);
  } else {
    return direction.dot(Vector3<typename Tool::Scalar>(tool.vertex(tool.support(direction))));
  }
}

/// The same, found from a vertex that may be near the one that answers, which takes its place: where directions change little from call to call, of
/// a tool with many vertices a few are looked at. A tool that can do so has a member `climb(direction, vertex)`.
template <ConvexTool Tool>
typename Tool::Scalar highest_along(const Tool& tool, const Vector3<typename Tool::Scalar>& direction, int& vertex) noexcept {
  if constexpr (requires { tool.climb(direction, vertex); }) {
    vertex = tool.climb(direction, vertex);
    return direction.dot(Vector3<typename Tool::Scalar>(tool.vertex(vertex)));
  } else {
    return highest_along(tool, direction);
  }
}

/// A point of a tool, away from its surface where it is not thin: the mean of its vertices, in the tool frame [m].
template <ConvexTool Tool>
Vector3<typename Tool::Scalar> middle_of(const Tool& tool) noexcept {
  Vector3<typename Tool::Scalar> sum = Vector3<typename Tool::Scalar>::Zero();
  for (int i = 0; i < tool.vertex_count(); ++i) sum += tool.vertex(i);
  return sum / typename Tool::Scalar(tool.vertex_count());
}

/// The same shape with another scalar: `tool.template cast<Other>()`.
template <class Tool, class Other>
using ToolCast = decltype(std::declval<const Tool&>().template cast<Other>());

}  // namespace feeler
