// Objects and poses that touch in a known way: a floor, roofs, fans, and a tool set down on a feature.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "feeler/core/feature.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "scenes/rotation_between.hpp"
#include "support/random_geometry.hpp"

namespace feeler_test {

using feeler::Feature;
using feeler::FeatureKind;
using Pose = feeler::Pose<double>;

/// An object as a list of triangles, to be turned, scaled, shuffled and divided before it becomes a mesh.
struct Soup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;

  feeler::TriangleMesh<double> mesh() const {
    feeler::Points<double> points(Eigen::Index(vertices.size()), 3);
    for (std::size_t i = 0; i < vertices.size(); ++i) points.row(Eigen::Index(i)) = vertices[i].transpose();
    feeler::Triangles rows(Eigen::Index(triangles.size()), 3);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) rows(Eigen::Index(i), k) = triangles[i][std::size_t(k)];
    return feeler::TriangleMesh<double>(points, rows);
  }

  Soup moved(const Pose& pose, double scale) const {
    Soup result = *this;
    for (auto& v : result.vertices) v = pose * Eigen::Vector3d(scale * v);
    return result;
  }
  /// The triangles in another order, each starting at another corner.
  Soup shuffled(std::mt19937& bits) const {
    Soup result = *this;
    for (std::size_t i = result.triangles.size(); i > 1; --i) std::swap(result.triangles[i - 1], result.triangles[std::size_t(below(bits, int(i)))]);
    for (auto& t : result.triangles) std::rotate(t.begin(), t.begin() + below(bits, 3), t.end());
    return result;
  }
  /// Each triangle in four, by the middles of its edges. Equal middles are welded by the mesh.
  Soup divided() const {
    Soup result;
    result.vertices = vertices;
    for (const auto& t : triangles) {
      std::array<int, 3> middle{};
      for (std::size_t k = 0; k < 3; ++k) {
        middle[k] = int(result.vertices.size());
        const auto a = std::size_t(std::min(t[k], t[(k + 1) % 3])), b = std::size_t(std::max(t[k], t[(k + 1) % 3]));
        result.vertices.push_back((vertices[a] + vertices[b]) / 2);
      }
      for (std::size_t k = 0; k < 3; ++k) result.triangles.push_back({t[k], middle[k], middle[(k + 2) % 3]});
      result.triangles.push_back(middle);
    }
    return result;
  }
  Soup reversed() const {
    Soup result = *this;
    for (auto& t : result.triangles) std::swap(t[1], t[2]);
    return result;
  }
};

/// A square of the plane z = 0.
inline Soup floor_object(double half = 1.0) {
  return {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}
/// z = slope |x|: a valley for positive slopes, a ridge for negative ones, along y.
inline Soup roof(double slope) {
  return {{{-1, -1, slope}, {0, -1, 0}, {1, -1, slope}, {-1, 1, slope}, {0, 1, 0}, {1, 1, slope}}, {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
}
/// Triangles around the origin to corners at unit distance and a height: a pit for positive heights, a tip for negative ones.
inline Soup fan(int count, double height) {
  Soup result{{{0, 0, 0}}, {}};
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / count + 0.3;
    result.vertices.push_back({std::cos(angle), std::sin(angle), height});
    result.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return result;
}

/// The middle of a feature of a tool, and a direction in which it is the farthest one; tool frame.
struct ToolFeature {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  // of edges
  std::vector<int> vertices;
};

template <class Tool>
ToolFeature tool_feature(const Tool& tool, const Feature& feature) {
  ToolFeature result;
  const auto at = [&](int i) { return Eigen::Vector3d(tool.vertex(i)); };
  if (feature.kind == FeatureKind::vertex) result.vertices = {feature.index};
  if (feature.kind == FeatureKind::edge) {
    result.vertices = {tool.edge(feature.index).start, tool.edge(feature.index).end};
    result.along = (at(result.vertices[1]) - at(result.vertices[0])).normalized();
  }
  for (int f = 0; f < tool.face_count(); ++f) {
    const auto face = tool.face(f);
    std::vector<int> loop(face.vertices.begin(), face.vertices.end());
    if (feature.kind == FeatureKind::face && f == feature.index) result.vertices = loop;
    const bool holds = feature.kind == FeatureKind::face ? f == feature.index
                                                         : std::all_of(result.vertices.begin(), result.vertices.end(),
                                                                       [&](int v) { return std::find(loop.begin(), loop.end(), v) != loop.end(); });
    if (holds) result.outward += face.normal;
  }
  for (const int v : result.vertices) result.point += at(v) / double(result.vertices.size());
  if (tool.face_count() == 0)  // a segment
    result.outward = feature.kind == FeatureKind::vertex ? Eigen::Vector3d(at(feature.index) - at(1 - feature.index)) : result.along.unitOrthogonal();
  result.outward.normalize();
  return result;
}

/// Least slope, seen from a feature, at which the rest of the tool rises from the plane that the feature rests on.
template <class Tool>
double rise_of(const Tool& tool, const ToolFeature& feature) {
  double least = 100;
  for (int i = 0; i < tool.vertex_count(); ++i) {
    if (std::find(feature.vertices.begin(), feature.vertices.end(), i) != feature.vertices.end()) continue;
    Eigen::Vector3d away = Eigen::Vector3d(tool.vertex(i)) - feature.point;
    const double height = -feature.outward.dot(away);
    away += height * feature.outward;
    away -= feature.along.dot(away) * feature.along;
    least = std::min(least, height / (away.norm() + 1e-12));
  }
  return least;
}

/// The pose in which a feature rests at a height above a point, facing down the z axis, its edge at an angle to the y axis.
inline Pose set_down(const ToolFeature& feature, const Eigen::Vector3d& point, double height, double angle) {
  Eigen::Quaterniond rotation = feeler::scenes::rotation_between(feature.outward, -Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d along = rotation * feature.along;
  const double heading = feature.along.isZero() ? 0.0 : std::atan2(-along.x(), along.y());  // from the y axis
  rotation = Eigen::Quaterniond(Eigen::AngleAxisd(angle - heading, Eigen::Vector3d::UnitZ())) * rotation;
  return {point + height * Eigen::Vector3d::UnitZ() - rotation * feature.point, rotation};
}

}  // namespace feeler_test
