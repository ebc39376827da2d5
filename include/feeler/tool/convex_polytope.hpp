// The convex hull of any set of points as a tool.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "feeler/core/result.hpp"
#include "feeler/tool/convex_hull.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/hull_faces.hpp"
#include "feeler/tool/hull_lattice.hpp"
#include "feeler/tool/support_blocks.hpp"

namespace feeler {

/// A convex polyhedron. Coordinates are in the tool frame [m].
template <RealScalar Scalar_>
class ConvexPolytope {
 public:
  using Scalar = Scalar_;
  static constexpr int maximum_vertex_count = 32767;  // what a `WitnessFeatures` can name

  /// The convex hull of points, one a row [m]; any number of them, in any order, inside points and duplicates
  /// included.
  ///
  /// Vertices are bit-identical to points given. Points less than 4 eps × size outside a face are dropped,
  /// faces coplanar to that are merged; size is the diagonal of the bounding box plus the largest coordinate,
  /// where the rounding of the points comes from. Refuses fewer than 4 points, points not finite, all equal,
  /// on a line or in a plane to 64 eps × size, and hulls of more than `maximum_vertex_count` vertices.
  /// @cost  allocates; milliseconds for thousands of points
  static ConvexPolytope hull_of(const Points<Scalar>& points) { return try_hull_of(points).value(); }
  /// The same, or the reason against it.
  static Result<ConvexPolytope> try_hull_of(const Points<Scalar>& points) {
    detail::HullLattice<Scalar> lattice(points);
    if (!lattice.reason.empty()) return Result<ConvexPolytope>::refused(lattice.reason);
    std::vector<detail::LatticePoint> corners = lattice.points;
    std::vector<int> rows(corners.size());  // of the input
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = int(i);

    // Dropping the vertices that are no corners can make others droppable: repeat until none is. Two rounds
    // are the rule.
    for (std::array<int, 4> simplex = lattice.simplex(corners);; simplex = lattice.simplex(corners)) {
      if (!lattice.reason.empty()) return Result<ConvexPolytope>::refused(lattice.reason);
      const auto triangles = detail::Quickhull(corners, simplex, lattice.tolerance).triangles();
      const detail::HullFaces faces(corners, triangles, lattice.tolerance);
      const std::vector<int> kept = faces.corners();
      if (kept.size() == corners.size() || kept.size() < 4) {
        if (int(corners.size()) > maximum_vertex_count)
          return Result<ConvexPolytope>::refused("ConvexPolytope: the hull has " + std::to_string(corners.size()) + " vertices and may have " +
                                                 std::to_string(maximum_vertex_count) + "; simplify the shape, or split it into convex pieces");
        return ConvexPolytope(points, rows, faces.polygons());
      }
      for (std::size_t i = 0; i < kept.size(); ++i) {
        corners[i] = corners[std::size_t(kept[i])];
        rows[i] = rows[std::size_t(kept[i])];
      }
      corners.resize(kept.size());
      rows.resize(kept.size());
    }
  }

  int vertex_count() const noexcept { return vertices_.count(); }
  Vector3<Scalar> vertex(int i) const noexcept { return vertices_[i]; }
  /// @cost  tens of nanoseconds; of a thousand vertices some hundred
  int support(const Vector3<Scalar>& direction) const noexcept { return vertices_.support(direction); }
  /// @cost  no more than `support`
  Scalar highest(const Vector3<Scalar>& direction) const noexcept { return vertices_.highest(direction); }

  /// Index of a vertex farthest along a direction, by climbing over edges from a vertex: on a convex hull who has no higher neighbour is highest.
  /// @cost  some dot products for each edge on the way
  int climb(const Vector3<Scalar>& direction, int vertex) const noexcept {
    if (vertex_count() <= few_vertices || neighbours_.empty()) return vertices_.support(direction);
    Scalar highest = direction.dot(vertices_[vertex]);
    for (int steps = 0; steps < vertex_count(); ++steps) {
      int best = vertex;
      for (int i = neighbour_begin_[std::size_t(vertex)]; i < neighbour_begin_[std::size_t(vertex) + 1]; ++i) {
        const int next = neighbours_[std::size_t(i)];
        const Scalar height = direction.dot(vertices_[next]);
        const bool is_higher = height > highest;
        highest = is_higher ? height : highest;
        best = is_higher ? next : best;
      }
      if (best == vertex) break;
      vertex = best;
    }
    return vertex;
  }

  int edge_count() const noexcept { return int(edges_.size()); }
  ToolEdge edge(int i) const noexcept { return edges_[std::size_t(i)]; }
  int face_count() const noexcept { return int(normals_.size()); }
  ToolFace<Scalar> face(int i) const noexcept {
    const auto begin = std::size_t(face_begin_[std::size_t(i)]), end = std::size_t(face_begin_[std::size_t(i) + 1]);
    return {normals_[std::size_t(i)], std::span<const int>(face_corners_.data() + begin, end - begin)};
  }
  int edge_direction_count() const noexcept { return int(edge_directions_.size()); }
  const Vector3<Scalar>& edge_direction(int i) const noexcept { return edge_directions_[std::size_t(i)]; }
  int face_axis_count() const noexcept { return int(face_axes_.size()); }
  const Vector3<Scalar>& face_axis(int i) const noexcept { return face_axes_[std::size_t(i)]; }

  /// The same features in another scalar. In a narrower one, faces are planar to its rounding only.
  template <class Other>
  ConvexPolytope<Other> cast() const {
    ConvexPolytope<Other> result;
    Points<Other> points(vertex_count(), 3);
    for (int i = 0; i < vertex_count(); ++i) points.row(i) = vertex(i).template cast<Other>().transpose();
    result.vertices_ = SupportBlocks<Other>(points);
    result.edges_ = edges_;
    result.neighbour_begin_ = neighbour_begin_;
    result.neighbours_ = neighbours_;
    result.face_begin_ = face_begin_;
    result.face_corners_ = face_corners_;
    const auto cast_all = [](const std::vector<Vector3<Scalar>>& from, std::vector<Vector3<Other>>& to) {
      for (const Vector3<Scalar>& v : from) to.push_back(v.template cast<Other>());
    };
    cast_all(normals_, result.normals_);
    cast_all(edge_directions_, result.edge_directions_);
    cast_all(face_axes_, result.face_axes_);
    return result;
  }

 private:
  template <RealScalar>
  friend class ConvexPolytope;
  using Working = WorkingScalar<Scalar>;

  ConvexPolytope() = default;

  ConvexPolytope(const Points<Scalar>& points, const std::vector<int>& rows, const std::vector<detail::HullFace>& faces) {
    Points<Scalar> corners(Eigen::Index(rows.size()), 3);
    for (std::size_t i = 0; i < rows.size(); ++i) corners.row(Eigen::Index(i)) = points.row(rows[i]);
    vertices_ = SupportBlocks<Scalar>(corners);

    std::vector<std::pair<long double, Vector3<Working>>> axes, directions;  // size, unit direction
    face_begin_.push_back(0);
    for (const detail::HullFace& face : faces) {
      const long double length = std::sqrt(face.normal[0] * face.normal[0] + face.normal[1] * face.normal[1] + face.normal[2] * face.normal[2]);
      const Vector3<Working> normal(static_cast<Working>(face.normal[0] / length), static_cast<Working>(face.normal[1] / length),
                                    static_cast<Working>(face.normal[2] / length));
      normals_.push_back(normal.template cast<Scalar>());
      axes.emplace_back(length, normal);
      face_corners_.insert(face_corners_.end(), face.corners.begin(), face.corners.end());
      face_begin_.push_back(int(face_corners_.size()));
      for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const ToolEdge edge{face.corners[i], face.corners[(i + 1) % face.corners.size()]};
        if (edge.start > edge.end) continue;  // the other face lists it
        edges_.push_back(edge);
        const Vector3<Working> along = (vertex(edge.end).template cast<Working>() - vertex(edge.start).template cast<Working>());
        directions.emplace_back(static_cast<long double>(along.norm()), along.normalized());
      }
    }
    link_neighbours();
    face_axes_ = without_parallels(axes);
    edge_directions_ = without_parallels(directions);
  }

  /// One of each set of directions that are parallel to rounding: that of the largest feature, which is the
  /// most exact.
  static std::vector<Vector3<Scalar>> without_parallels(std::vector<std::pair<long double, Vector3<Working>>>& directions) {
    const Working tolerance = 32 * Working(std::numeric_limits<Scalar>::epsilon());
    std::stable_sort(directions.begin(), directions.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    // Parallel directions have the same height along any axis. This one is beside those of shapes that people draw.
    const Vector3<Working> axis(Working(0.4472), Working(0.6325), Working(0.6325));
    std::multimap<Working, Vector3<Working>> kept;
    std::vector<Vector3<Scalar>> result;
    for (const auto& [size, direction] : directions) {
      using std::abs;
      const Working height = abs(axis.dot(direction));
      const bool is_none = !(direction.squaredNorm() > Working(0.5));  // without a length: parallel to all
      const auto begin = is_none ? kept.begin() : kept.lower_bound(height - 2 * tolerance);
      const auto end = is_none ? kept.end() : kept.upper_bound(height + 2 * tolerance);
      const bool is_new =
          std::none_of(begin, end, [&d = direction, tolerance](const auto& k) { return k.second.cross(d).squaredNorm() <= tolerance * tolerance; });
      if (!is_new) continue;
      kept.emplace(height, direction);
      result.push_back(direction.template cast<Scalar>());
    }
    return result;
  }

  void link_neighbours() {
    std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(vertex_count()));
    for (const ToolEdge& edge : edges_) {
      neighbours[std::size_t(edge.start)].push_back(edge.end);
      neighbours[std::size_t(edge.end)].push_back(edge.start);
    }
    // Of shapes as fine as their rounding a face may have no outline, and edges are missing. Where edges are much shorter than the shape, rounding
    // hides on which side it is higher.
    const Scalar shortest = Scalar(1) / 300;  // edge, to the largest coordinate
    Scalar size(0);
    for (int i = 0; i < vertex_count(); ++i) size = (std::max)(size, vertex(i).cwiseAbs().maxCoeff());
    const auto is_too_short = [&](const ToolEdge& edge) { return !((vertex(edge.end) - vertex(edge.start)).norm() > shortest * size); };
    if (std::any_of(edges_.begin(), edges_.end(), is_too_short)) return;
    if (std::any_of(neighbours.begin(), neighbours.end(), [](const std::vector<int>& of_vertex) { return of_vertex.size() < 3; })) return;
    neighbour_begin_.push_back(0);
    for (const std::vector<int>& of_vertex : neighbours) {
      neighbours_.insert(neighbours_.end(), of_vertex.begin(), of_vertex.end());
      neighbour_begin_.push_back(int(neighbours_.size()));
    }
  }

  SupportBlocks<Scalar> vertices_;
  static constexpr int few_vertices = 24;  // that are looked at in less time than a climb takes

  std::vector<ToolEdge> edges_;
  std::vector<int> neighbour_begin_;  // by vertex
  std::vector<int> neighbours_;
  std::vector<int> face_begin_;
  std::vector<int> face_corners_;
  std::vector<Vector3<Scalar>> normals_;
  std::vector<Vector3<Scalar>> edge_directions_;
  std::vector<Vector3<Scalar>> face_axes_;
};

static_assert(ConvexTool<ConvexPolytope<double>>);

}  // namespace feeler
