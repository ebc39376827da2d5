// The convex hull of lattice points as triangles: quickhull with exact visibility.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "feeler/tool/lattice.hpp"

namespace feeler::detail {

/// A triangle of a hull: corners counter-clockwise seen from outside; neighbour k is across the edge from
/// corner k to corner (k+1)%3.
struct HullTriangle {
  std::array<int, 3> corners{};
  std::array<int, 3> neighbours{};
  LatticePlane plane;
};

/// Quickhull (Barber, Dobkin and Huhdanpaa, 1996) over a lattice.
///
/// A point is added only if it is farther than `tolerance` above a face, the farthest first. Which faces it
/// sees is decided exactly, and faces it lies in are not seen: so the horizon is always one simple cycle, no
/// new triangle is degenerate, and the result is a closed, exactly convex surface whatever the input.
class Quickhull {
 public:
  /// @param points     at least the four of the simplex
  /// @param simplex    indices of four points that are not coplanar
  /// @param tolerance  in lattice units; points that are less above every face count as inside
  /// @cost  O(n log n) exact tests of about 10 ns in practice
  Quickhull(const std::vector<LatticePoint>& points, std::array<int, 4> simplex, long double tolerance)
      : points_(points), tolerance_(tolerance), face_from_(points.size(), -1) {
    start(simplex);
    do {
      while (!pending_.empty()) {
        const int face = pending_.back();
        pending_.pop_back();
        if (faces_[std::size_t(face)].is_alive && !faces_[std::size_t(face)].outside.empty()) extend(face);
      }
    } while (return_near_points());
  }

  /// The triangles of the hull.
  std::vector<HullTriangle> triangles() const {
    std::vector<int> number(faces_.size(), -1);
    std::vector<HullTriangle> result;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (!faces_[f].is_alive) continue;
      number[f] = int(result.size());
      result.push_back(faces_[f].triangle);
    }
    for (HullTriangle& triangle : result)
      for (int& neighbour : triangle.neighbours) neighbour = number[std::size_t(neighbour)];
    return result;
  }

 private:
  struct Face {
    HullTriangle triangle;
    std::vector<int> outside;  // the farthest is kept at the back
    long double farthest_height = 0;
    bool is_alive = true;
  };
  /// A directed edge of the visible region and the hidden face behind it.
  struct HorizonEdge {
    int start;
    int end;
    int hidden;
  };

  int add_face(int a, int b, int c) {
    Face face;
    face.triangle.corners = {a, b, c};
    face.triangle.plane = LatticePlane(points_[std::size_t(a)], points_[std::size_t(b)], points_[std::size_t(c)]);
    faces_.push_back(std::move(face));
    return int(faces_.size()) - 1;
  }

  void start(std::array<int, 4> simplex) {
    auto [a, b, c, d] = simplex;
    const LatticePlane base(points_[std::size_t(a)], points_[std::size_t(b)], points_[std::size_t(c)]);
    if (base.is_below(points_[std::size_t(d)])) std::swap(b, c);
    add_face(a, b, c);
    add_face(a, d, b);
    add_face(b, d, c);
    add_face(c, d, a);
    faces_[0].triangle.neighbours = {1, 2, 3};
    faces_[1].triangle.neighbours = {3, 2, 0};
    faces_[2].triangle.neighbours = {1, 3, 0};
    faces_[3].triangle.neighbours = {2, 1, 0};
    for (std::size_t i = 0; i < points_.size(); ++i) assign(int(i), 0);
    pending_ = {0, 1, 2, 3};
  }

  /// Gives a point to the face, among those from `first_face` on, that it is highest above.
  void assign(int point, int first_face) {
    long double best_height = 0;
    int best = -1;
    for (std::size_t f = std::size_t(first_face); f < faces_.size(); ++f) {
      if (!faces_[f].is_alive) continue;
      const long double height = faces_[f].triangle.plane.height(points_[std::size_t(point)]);
      if (height > best_height) {
        best_height = height;
        best = int(f);
      }
    }
    if (best < 0) return;
    if (!(best_height > tolerance_)) {
      near_.push_back(point);
      return;
    }
    Face& face = faces_[std::size_t(best)];
    face.outside.push_back(point);
    if (best_height > face.farthest_height) face.farthest_height = best_height;
    else std::swap(face.outside.back(), face.outside[face.outside.size() - 2]);
  }

  /// Extends the hull to the farthest point of a face.
  void extend(int face) {
    const int apex = faces_[std::size_t(face)].outside.back();
    faces_[std::size_t(face)].outside.pop_back();
    find_horizon(face, apex);

    const int first_new = int(faces_.size());
    for (const HorizonEdge& edge : horizon_) face_from_[std::size_t(edge.start)] = add_face(edge.start, edge.end, apex);
    for (const HorizonEdge& edge : horizon_) {
      const int current = face_from_[std::size_t(edge.start)];
      const int next = face_from_[std::size_t(edge.end)];
      faces_[std::size_t(current)].triangle.neighbours[0] = edge.hidden;
      faces_[std::size_t(current)].triangle.neighbours[1] = next;
      faces_[std::size_t(next)].triangle.neighbours[2] = current;
      HullTriangle& hidden = faces_[std::size_t(edge.hidden)].triangle;
      for (std::size_t k = 0; k < 3; ++k)
        if (hidden.corners[k] == edge.end) hidden.neighbours[k] = current;
    }
    for (const int dead : visible_) {
      const std::vector<int> orphans = std::move(faces_[std::size_t(dead)].outside);
      faces_[std::size_t(dead)].outside.clear();
      for (const int orphan : orphans) assign(orphan, first_new);
    }
    for (int f = first_new; f < int(faces_.size()); ++f) pending_.push_back(f);
  }

  /// Marks the faces that the apex sees as dead, and lists the edges around them.
  void find_horizon(int face, int apex) {
    visible_.assign(1, face);
    horizon_.clear();
    faces_[std::size_t(face)].is_alive = false;
    for (std::size_t i = 0; i < visible_.size(); ++i) {
      const HullTriangle triangle = faces_[std::size_t(visible_[i])].triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        Face& neighbour = faces_[std::size_t(triangle.neighbours[k])];
        if (!neighbour.is_alive) continue;
        if (neighbour.triangle.plane.is_below(points_[std::size_t(apex)])) {
          neighbour.is_alive = false;
          visible_.push_back(triangle.neighbours[k]);
        } else {
          horizon_.push_back({triangle.corners[k], triangle.corners[(k + 1) % 3], triangle.neighbours[k]});
        }
      }
    }
  }

  /// Looks again at the points that were left out for being near: at a sharp edge, a later face may have
  /// turned away from one.
  bool return_near_points() {
    const std::vector<int> nearby = std::move(near_);
    near_.clear();
    if (nearby.empty()) return false;
    std::vector<int> alive;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (faces_[f].is_alive) alive.push_back(int(f));
    for (const int point : nearby) {
      for (const int f : alive) {
        const LatticePlane& plane = faces_[std::size_t(f)].triangle.plane;
        if (!(plane.height(points_[std::size_t(point)]) > tolerance_)) continue;
        assign(point, 0);
        break;
      }
    }
    for (const int f : alive)
      if (!faces_[std::size_t(f)].outside.empty()) pending_.push_back(f);
    return !pending_.empty();
  }

  const std::vector<LatticePoint>& points_;
  long double tolerance_;
  std::vector<Face> faces_;
  std::vector<int> pending_;
  std::vector<int> near_;
  std::vector<int> visible_;
  std::vector<HorizonEdge> horizon_;
  std::vector<int> face_from_;  // the new face that starts at a vertex
};

}  // namespace feeler::detail
