// Distance of a convex tool and a triangle by brute force over all pairs of features, in long double; shares
// nothing with the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "support/penetration_checker.hpp"

namespace feeler::test {

/// Triangle or sliver or point, a corner an element.
using WideTriangle = std::array<WideVector, 3>;

/// The features of a tool at some pose; of a swept one those of its core, and the radius.
struct WideTool {
  std::vector<WideVector> vertices;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> faces;
  WideReal radius = 0;

  template <class Tool>
  explicit WideTool(const Tool& tool) {
    if constexpr (requires { tool.swept_radius(); }) radius = WideReal(tool.swept_radius());
    for (int i = 0; i < tool.vertex_count(); ++i) vertices.push_back(WideVector(tool.vertex(i).template cast<WideReal>()));
    for (int i = 0; i < tool.edge_count(); ++i) edges.push_back({tool.edge(i).start, tool.edge(i).end});
    for (int i = 0; i < tool.face_count(); ++i) {
      const auto face = tool.face(i);
      faces.emplace_back(face.vertices.begin(), face.vertices.end());
    }
  }

  WideTool moved(const Eigen::Matrix<WideReal, 3, 3>& rotation, const WideVector& translation) const {
    WideTool result = *this;
    for (WideVector& v : result.vertices) v = rotation * v + translation;
    return result;
  }

  /// min n·x − max n·y for a unit normal.
  WideReal separation_along(const WideVector& normal, const WideTriangle& triangle) const {
    WideReal low = std::numeric_limits<WideReal>::infinity(), high = -low;
    for (const WideVector& v : vertices) low = std::min(low, normal.dot(v));
    for (const WideVector& y : triangle) high = std::max(high, normal.dot(y));
    return low - high - radius;
  }
};

/// Closest points of shapes that are apart, of a swept tool those of its core; for shapes that overlap the answer is that of their surfaces.
inline WidePair closest_features(const WideTool& tool, const WideTriangle& triangle) {
  WidePair best;
  const auto vertex = [&](int i) -> const WideVector& { return tool.vertices[std::size_t(i)]; };
  for (const WideVector& v : tool.vertices) best.take(v, closest_on_wide_triangle(v, triangle[0], triangle[1], triangle[2]));
  for (const auto& edge : tool.edges)
    for (std::size_t k = 0; k < 3; ++k) take_segments(vertex(edge[0]), vertex(edge[1]), triangle[k], triangle[(k + 1) % 3], best);
  for (const auto& face : tool.faces)
    for (std::size_t i = 2; i < face.size(); ++i)
      for (const WideVector& y : triangle) best.take(closest_on_wide_triangle(y, vertex(face[0]), vertex(face[i - 1]), vertex(face[i])), y);
  return best;
}

/// Whether the shapes, of a swept tool its core, have a point in common: an edge of one pierces the other, or one is inside the other.
inline bool intersect(const WideTool& tool, const WideTriangle& triangle) {
  const auto pierces = [](const WideVector& p, const WideVector& q, const WideVector& a, const WideVector& b, const WideVector& c) {
    const auto volume = [](const WideVector& u, const WideVector& v, const WideVector& w) { return u.cross(v).dot(w); };
    const WideReal sp = volume(b - a, c - a, p - a), sq = volume(b - a, c - a, q - a);
    if ((sp > 0) == (sq > 0)) return false;
    const WideReal x = volume(q - p, a - p, b - p), y = volume(q - p, b - p, c - p), z = volume(q - p, c - p, a - p);
    return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
  };
  const auto vertex = [&](int i) -> const WideVector& { return tool.vertices[std::size_t(i)]; };
  for (const auto& edge : tool.edges)
    if (pierces(vertex(edge[0]), vertex(edge[1]), triangle[0], triangle[1], triangle[2])) return true;
  bool is_inside = !tool.faces.empty();
  for (const auto& face : tool.faces) {
    for (std::size_t i = 2; i < face.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (pierces(triangle[k], triangle[(k + 1) % 3], vertex(face[0]), vertex(face[i - 1]), vertex(face[i]))) return true;
    const WideVector normal = (vertex(face[1]) - vertex(face[0])).cross(vertex(face[2]) - vertex(face[0]));
    is_inside = is_inside && normal.dot(triangle[0] - vertex(face[0])) < 0;
  }
  return is_inside;
}

/// A tool's motion: its reference point goes from `start` by t·linear, its axes turn by Exp(t·angular), in
/// long double.
struct WideMotion {
  WideVector reference_tool, start, linear, angular;
  Eigen::Quaternion<WideReal> rotation;

  Eigen::Quaternion<WideReal> rotation_at(WideReal t) const {
    const WideReal angle = angular.norm();
    if (!(angle > 0)) return rotation.normalized();
    return (Eigen::Quaternion<WideReal>(Eigen::AngleAxis<WideReal>(t * angle, angular / angle)) * rotation).normalized();
  }
  /// Pose of the tool frame.
  CheckedPose pose_at(WideReal t) const {
    const auto turned = rotation_at(t);
    return {WideVector(start + t * linear - turned * reference_tool), turned};
  }
  WideTool tool_at(const WideTool& tool, WideReal t) const {
    const CheckedPose pose = pose_at(t);
    return tool.moved(pose.rotation.toRotationMatrix(), pose.translation);
  }
};

}  // namespace feeler::test
