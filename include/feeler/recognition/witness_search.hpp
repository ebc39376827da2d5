// Finds where a tool touches the features of a surface.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/closest_on_segment.hpp"
#include "feeler/recognition/contact_witness.hpp"
#include "feeler/recognition/surface_features.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// Looks for witnesses: tool vertices near the surface, corners of the surface near the tool, and edges that cross near each other.
///
/// Triangles only say where to look and whether a vertex is over a face; edges and corners are those of the surface. So flat edges and the
/// vertices on them, which another triangulation would have elsewhere, are nobody's witnesses.
/// Positions are in world axes, relative to the origin of the tool frame, where rounding is least.
template <ConvexTool Tool, RealScalar MeshScalar>
class WitnessSearch {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  using Witnesses = ContactWitnesses<Scalar>;
  /// Triangles within tolerance that are looked at; the others are counted.
  static constexpr int most_triangles = 4096;

  /// Copies the tool and refers to the object. Allocates one word for each feature.
  WitnessSearch(const Tool& tool, const TriangleMesh<MeshScalar>& mesh, const SurfaceFeatures<MeshScalar>& surface)
      : tool_(tool),
        mesh_(mesh),
        surface_(surface),
        edge_seen_(std::size_t(surface.edge_count()), 0),
        vertex_seen_(std::size_t(surface.vertex_count()), 0),
        vertices_(std::size_t(tool.vertex_count())),
        normals_(std::size_t(tool.face_count())) {
    // Outer planes of the tool prune the search. A tool without faces lends those along its edges.
    const std::size_t plane_count = tool.face_count() > 0 ? normals_.size() : 6 * std::size_t(tool.edge_count());
    planes_.reserve(plane_count);
  }

  /// Fills `witnesses` with all places within `tolerance` [m]. @cost  noexcept, no allocation
  void find(const Pose<Scalar>& world_from_tool, Scalar tolerance, Witnesses& witnesses) noexcept {
    witnesses.clear();
    dropped_triangles_ = 0;
    place(world_from_tool, tolerance);
    next_stamp();
    int count = 0;
    const Vector shift = mesh_.bvh().origin().template cast<Scalar>() - origin_;
    const auto is_apart = [&](const std::array<float, 3>& lower, const std::array<float, 3>& upper) { return !is_near(lower, upper, shift); };
    mesh_.bvh().visit(is_apart, [&](int triangle) {
      const Matrix3<Scalar> corners = corners_of(triangle);
      if (!may_touch(corners)) return true;
      if (count++ >= most_triangles) ++dropped_triangles_;
      else look_at(triangle, corners, witnesses);
      return true;
    });
  }

  const Tool& tool() const noexcept { return tool_; }
  int dropped_triangles() const noexcept { return dropped_triangles_; }
  /// Vertex of the tool at the last pose, in the axes of the witnesses.
  const Vector& vertex(int i) const noexcept { return vertices_[std::size_t(i)]; }
  const Vector& face_normal(int i) const noexcept { return normals_[std::size_t(i)]; }
  /// A world point in the axes of the witnesses.
  Vector local(const Vector3<MeshScalar>& point_world) const noexcept { return point_world.template cast<Scalar>() - origin_; }
  const Vector& origin() const noexcept { return origin_; }

 private:
  struct Plane {
    Vector normal;
    Scalar offset;  // greatest n·x of the tool
  };

  void place(const Pose<Scalar>& world_from_tool, Scalar tolerance) noexcept {
    origin_ = world_from_tool.translation;
    tolerance_ = tolerance;
    const Matrix3<Scalar> rotation = world_from_tool.rotation.normalized().toRotationMatrix();
    low_ = Vector::Constant(std::numeric_limits<Scalar>::infinity());
    high_ = -low_;
    for (int i = 0; i < tool_.vertex_count(); ++i) {
      vertices_[std::size_t(i)] = rotation * Vector(tool_.vertex(i));
      low_ = low_.cwiseMin(vertices_[std::size_t(i)]);
      high_ = high_.cwiseMax(vertices_[std::size_t(i)]);
    }
    low_.array() -= tolerance;
    high_.array() += tolerance;
    planes_.clear();
    for (int f = 0; f < tool_.face_count(); ++f) {
      const auto face = tool_.face(f);
      normals_[std::size_t(f)] = rotation * face.normal;
      planes_.push_back({normals_[std::size_t(f)], normals_[std::size_t(f)].dot(vertex(face.vertices[0]))});
    }
    if (tool_.face_count() == 0) add_planes_along_edges();
    last_plane_ = 0;
  }

  void add_planes_along_edges() noexcept {
    for (int e = 0; e < tool_.edge_count(); ++e) {
      const Vector along = vertex(tool_.edge(e).end) - vertex(tool_.edge(e).start);
      for (int k = 0; k < 3; ++k) {
        const Vector normal = along.cross(Vector::Unit(k)).normalized();
        for (const Scalar& sign : {Scalar(1), Scalar(-1)}) {
          Scalar offset = -std::numeric_limits<Scalar>::infinity();
          for (const Vector& v : vertices_) offset = (std::max)(offset, sign * normal.dot(v));
          planes_.push_back({sign * normal, offset});
        }
      }
    }
  }

  void next_stamp() noexcept {
    if (++stamp_ != 0) return;
    std::fill(edge_seen_.begin(), edge_seen_.end(), 0U);
    std::fill(vertex_seen_.begin(), vertex_seen_.end(), 0U);
    stamp_ = 1;
  }

  /// Of two boxes.
  static bool are_apart(const Vector& lower, const Vector& upper, const Vector& other_lower, const Vector& other_upper) noexcept {
    return (lower.array() > other_upper.array()).any() || (upper.array() < other_lower.array()).any();
  }
  bool is_near(const std::array<float, 3>& box_lower, const std::array<float, 3>& box_upper, const Vector& shift) noexcept {
    const Vector lower = Eigen::Map<const Vector3<float>>(box_lower.data()).template cast<Scalar>() + shift;
    const Vector upper = Eigen::Map<const Vector3<float>>(box_upper.data()).template cast<Scalar>() + shift;
    if (are_apart(lower, upper, low_, high_)) return false;
    const Vector centre = (lower + upper) / 2, half = (upper - lower) / 2;
    return !is_beyond([&](const Plane& plane) { return plane.normal.dot(centre) - plane.normal.cwiseAbs().dot(half); });
  }
  bool may_touch(const Matrix3<Scalar>& corners) noexcept {
    const Vector lower = corners.rowwise().minCoeff(), upper = corners.rowwise().maxCoeff();
    if (are_apart(lower, upper, low_, high_)) return false;
    if (is_beyond([&](const Plane& plane) { return (plane.normal.transpose() * corners).minCoeff(); })) return false;
    const Vector normal = triangle_normal<Scalar>(corners.col(0), corners.col(1), corners.col(2));
    Scalar least = std::numeric_limits<Scalar>::infinity(), most = -least;
    for (const Vector& v : vertices_) {
      const Scalar height = normal.dot(v - corners.col(0));
      least = (std::min)(least, height);
      most = (std::max)(most, height);
    }
    return least <= tolerance_ && most >= -tolerance_;
  }
  /// Whether something is outside of a plane of the tool, of which the one that helped last is asked first.
  template <class Lowest>
  bool is_beyond(const Lowest& lowest_along) noexcept {
    const std::size_t count = planes_.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t p = (last_plane_ + i) % count;
      if (lowest_along(planes_[p]) - planes_[p].offset <= tolerance_) continue;
      last_plane_ = p;
      return true;
    }
    return false;
  }

  Matrix3<Scalar> corners_of(int triangle) const noexcept {
    Matrix3<Scalar> corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = local(mesh_.vertex(mesh_.triangle(triangle)[std::size_t(k)]));
    return corners;
  }

  void look_at(int triangle, const Matrix3<Scalar>& corners, Witnesses& witnesses) noexcept {
    using std::abs;
    const Vector normal = triangle_normal<Scalar>(corners.col(0), corners.col(1), corners.col(2));
    const Feature face{FeatureKind::face, surface_.face_of_triangle(triangle)};
    for (int i = 0; i < tool_.vertex_count(); ++i) {
      const Vector& v = vertex(i);
      if (abs(normal.dot(v - corners.col(0))) > tolerance_) continue;
      const Vector closest = closest_on_triangle<Scalar>(v, corners, normal);
      if (is_within(v, closest)) witnesses.add({{FeatureKind::vertex, i}, face, v, closest});
    }
    for (int k = 0; k < 3; ++k) {
      const Feature edge = surface_.feature_of_edge(triangle, k);
      if (edge.kind == FeatureKind::edge && is_first(edge_seen_, edge.index)) look_at_edge(edge, witnesses);
      const Feature vertex = surface_.feature_of_vertex(mesh_.triangle(triangle)[std::size_t(k)]);
      if (vertex.kind == FeatureKind::vertex && is_first(vertex_seen_, vertex.index)) look_at_vertex(vertex, witnesses);
    }
  }

  bool is_first(std::vector<std::uint32_t>& seen, int index) noexcept {
    auto& last = seen[std::size_t(index)];
    if (last == stamp_) return false;
    last = stamp_;
    return true;
  }

  void look_at_vertex(const Feature& feature, Witnesses& witnesses) noexcept {
    using std::abs;
    const Vector point = local(surface_.vertex(feature.index).point);
    if (are_apart(point, point, low_, high_)) return;
    for (int i = 0; i < tool_.vertex_count(); ++i)
      if (is_within(vertex(i), point)) witnesses.add({{FeatureKind::vertex, i}, feature, vertex(i), point});
    for (int e = 0; e < tool_.edge_count(); ++e) {
      const Vector closest = closest_on_segment<Scalar>(point, vertex(tool_.edge(e).start), vertex(tool_.edge(e).end));
      if (is_within(closest, point)) witnesses.add({{FeatureKind::edge, e}, feature, closest, point});
    }
    for (int f = 0; f < tool_.face_count(); ++f) {
      const auto face = tool_.face(f);
      const auto& loop = face.vertices;
      const Vector& normal = face_normal(f);
      const Scalar height = normal.dot(point - vertex(loop[0]));
      if (abs(height) > tolerance_) continue;
      bool is_over = true;
      for (std::size_t i = 0; is_over && i < loop.size(); ++i) {
        const Vector& start = vertex(loop[i]);
        is_over = (vertex(loop[(i + 1) % loop.size()]) - start).cross(point - start).dot(normal) >= Scalar(0);
      }
      if (is_over) witnesses.add({{FeatureKind::face, f}, feature, point - height * normal, point});
    }
  }

  void look_at_edge(const Feature& feature, Witnesses& witnesses) noexcept {
    const SurfaceEdge<MeshScalar>& edge = surface_.edge(feature.index);
    const Vector start = local(edge.start), end = local(edge.end);
    const Vector lower = start.cwiseMin(end), upper = start.cwiseMax(end);
    if (are_apart(lower, upper, low_, high_)) return;
    for (int i = 0; i < tool_.vertex_count(); ++i) {
      const Vector closest = closest_on_segment<Scalar>(vertex(i), start, end);
      if (is_within(vertex(i), closest)) witnesses.add({{FeatureKind::vertex, i}, feature, vertex(i), closest});
    }
    for (int e = 0; e < tool_.edge_count(); ++e) {
      const Vector& tool_start = vertex(tool_.edge(e).start);
      const Vector& tool_end = vertex(tool_.edge(e).end);
      const Vector tool_low = tool_start.cwiseMin(tool_end).array() - tolerance_;
      const Vector tool_high = tool_start.cwiseMax(tool_end).array() + tolerance_;
      if (are_apart(lower, upper, tool_low, tool_high)) continue;
      const auto crossing = crossing_of_segments<Scalar>(tool_start, tool_end, start, end);
      if (!crossing.exists || !is_within(crossing.on_first, crossing.on_second)) continue;
      // Where an end takes part, it is the witness.
      if (is_within(tool_start, crossing.on_second) || is_within(tool_end, crossing.on_second)) continue;
      if (is_within(start, crossing.on_first) || is_within(end, crossing.on_first)) continue;
      witnesses.add({{FeatureKind::edge, e}, feature, crossing.on_first, crossing.on_second});
    }
  }

  bool is_within(const Vector& a, const Vector& b) const noexcept { return (a - b).squaredNorm() <= tolerance_ * tolerance_; }

  Tool tool_;
  const TriangleMesh<MeshScalar>& mesh_;
  const SurfaceFeatures<MeshScalar>& surface_;
  std::vector<std::uint32_t> edge_seen_, vertex_seen_;  // the search that last looked at a feature
  std::uint32_t stamp_ = 0;
  std::vector<Vector> vertices_, normals_;
  std::vector<Plane> planes_;
  std::size_t last_plane_ = 0;
  Vector origin_ = Vector::Zero(), low_ = Vector::Zero(), high_ = Vector::Zero();
  Scalar tolerance_ = Scalar(0);
  int dropped_triangles_ = 0;
};

}  // namespace feeler
