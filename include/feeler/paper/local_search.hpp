// Candidate principal contacts: what could hold the tool near a first contact, found by a search over neighbouring features.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "feeler/contact/contact_row.hpp"
#include "feeler/contact/vertex_set.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/paper/candidate_constraint.hpp"
#include "feeler/paper/first_contacts.hpp"
#include "feeler/paper/triangle_ring.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// A candidate principal contact (CPC): inequalities that together describe one convex piece of the free space.
struct Candidate {
  static constexpr int capacity = 48;
  FixedVector<CandidateConstraint, capacity> constraints;
};

/// The candidates of one contact region.
struct RegionCandidates {
  static constexpr int capacity = 16;
  FixedVector<Candidate, capacity> candidates;
  int dropped = 0;  ///< candidates, constraints and triangles for which there was no room
};

/// Finds the candidates of first contacts (paper, section III.C and Fig. 8). The table of neighbours that the paper
/// makes by hand is read from the topology of mesh and tool, so any mesh and any convex tool will do.
///
/// On the object the neighbours of a feature are those of the triangles that share a corner with its triangle; on the tool those that share
/// a face with it. Of them it makes
/// - for each plane the candidate that keeps every neighbouring tool vertex above it (type 1, eq. 6), together with the planes that meet it
///   in valleys and pits and that the tool is above now (types 3, 4 and 5, eq. 8);
/// - for each ridge and each tool edge over it the candidate of the dynamic constraint plane (type 2, eq. 7);
/// - for each tip and each tool face over it the candidate of the face's plane.
///
/// Faces on faces, edges on faces and faces on edges (types 6, 7, 11 and 12) are several of these inequalities at once.
template <ConvexTool Tool, class MeshScalar>
class LocalSearch {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  using Ring = TriangleRing<Scalar, MeshScalar>;

  /// @param reach  how far apart features that will meet within the tick may be now [m]
  /// @param near_vertices  is filled with neighbours on the tool; made for at least as many as the tool has vertices
  LocalSearch(const Tool& tool, const TriangleMesh<MeshScalar>& mesh, const Pose<Scalar>& pose, Scalar reach, VertexSet& near_vertices) noexcept
      : tool_(tool), mesh_(mesh), pose_(pose), axes_(pose.rotation.toRotationMatrix()), reach_(reach), ring_(mesh), near_(near_vertices) {}

  void find(const FirstContact<Scalar>& contact, RegionCandidates& region) noexcept {
    region.candidates.clear();
    is_behind_ = is_behind(contact);
    region.dropped = ring_.find(contact.triangle, is_behind_);
    gather_tool_neighbours(contact);
    add_planes(region);
    add_edges(region);
    add_tips(region);
  }

 private:
  using Plane = typename Ring::Plane;

  Vector tool_vertex(int i) const noexcept { return pose_ * tool_.vertex(i); }
  /// Meshes may be open, and then the tool may be behind them.
  bool is_behind(const FirstContact<Scalar>& contact) const noexcept {
    return mesh_.normal(contact.triangle).template cast<Scalar>().dot(contact.normal_world) < Scalar(0);
  }

  void gather_tool_neighbours(const FirstContact<Scalar>& contact) noexcept {
    near_.clear();
    for (int i = 0; i < contact.features.size; ++i) near_.add(contact.features.tool_vertices[as_index(i)]);
    const std::span<const int> own(near_.begin(), std::size_t(near_.size()));
    const auto is_own = [own](int vertex) { return std::find(own.begin(), own.end(), vertex) != own.end(); };
    for (int e = 0; e < tool_.edge_count(); ++e) {
      const ToolEdge edge = tool_.edge(e);
      if (!is_own(edge.start) && !is_own(edge.end)) continue;
      near_.add(edge.start);
      near_.add(edge.end);
    }
    for (int f = 0; f < tool_.face_count(); ++f) {
      const auto face = tool_.face(f);
      if (std::none_of(face.vertices.begin(), face.vertices.end(), is_own)) continue;
      for (const int v : face.vertices) near_.add(v);
    }
  }

  bool is_above(const Plane& plane) const noexcept {
    for (int v = 0; v < tool_.vertex_count(); ++v) {
      if (near_.contains(v) && plane.normal.dot(tool_vertex(v) - plane.point) < -reach_) return false;
    }
    return true;
  }

  void add_planes(RegionCandidates& region) noexcept {
    FixedVector<std::uint64_t, Ring::plane_capacity> known;  // the sets of planes so far
    for (int i = 0; i < ring_.planes().size(); ++i) {
      const std::uint64_t set = ring_.convex_piece(i, [this](const Plane& plane) { return is_above(plane); });
      if (std::find(known.begin(), known.end(), set) != known.end()) continue;
      known.push_back(set);
      Candidate candidate;
      for (int j = 0; j < ring_.planes().size(); ++j) {
        if ((set >> j & 1u) != 0) add_plane(ring_.planes()[j], j == i, candidate, region);
      }
      add(candidate, region);
    }
  }

  /// Every near tool vertex above a plane; those past a ridge where it ends only if the candidate is the plane's own.
  void add_plane(const Plane& plane, bool is_own, Candidate& candidate, RegionCandidates& region) const noexcept {
    for (int v = 0; v < tool_.vertex_count(); ++v) {
      if (!near_.contains(v) || (!is_own && ring_.is_past_ridge(plane, tool_vertex(v), reach_))) continue;
      if (!candidate.constraints.push_back({FeaturePair::vertex_face, v, plane.triangle, 0, is_behind_})) ++region.dropped;
    }
  }

  void add_edges(RegionCandidates& region) noexcept {
    for (int e = 0; e < tool_.edge_count(); ++e) {
      const ToolEdge edge = tool_.edge(e);
      if (!near_.contains(edge.start) || !near_.contains(edge.end)) continue;
      for (int i = 0; i < ring_.triangles().size(); ++i) {
        for (int k = 0; k < 3; ++k) {
          const int other = mesh_.topology().neighbour(ring_.triangles()[i], k);
          if (ring_.edge_convexity(ring_.triangles()[i], k) != Convexity::convex ||
              (other >= 0 && other < ring_.triangles()[i] && ring_.contains(other)))
            continue;
          if (!is_within_reach(e, ring_.triangles()[i], k)) continue;
          Candidate candidate;
          candidate.constraints.push_back({FeaturePair::edge_edge, e, ring_.triangles()[i], k, is_behind_});
          add(candidate, region);
        }
      }
    }
  }

  /// Whether a tool edge and an object edge are near each other: by the distance of segments, sampled where the lines are closest.
  bool is_within_reach(int e, int triangle, int k) const noexcept {
    const ToolEdge edge = tool_.edge(e);
    const Vector a = tool_vertex(edge.start), u = tool_vertex(edge.end) - a;
    const Vector b = ring_.corner(triangle, k), v = ring_.corner(triangle, (k + 1) % 3) - b;
    const Vector cross = u.cross(v);
    const Scalar area = cross.squaredNorm();
    if (!(area > Scalar(1e-12) * u.squaredNorm() * v.squaredNorm())) return false;  // parallel: the planes hold the tool
    const Scalar s = std::clamp((b - a).cross(v).dot(cross) / area, Scalar(0), Scalar(1));
    const Scalar t = std::clamp((b - a).cross(u).dot(cross) / area, Scalar(0), Scalar(1));
    return (a + s * u - b - t * v).squaredNorm() <= reach_ * reach_;
  }

  void add_tips(RegionCandidates& region) noexcept {
    using std::abs;
    FixedVector<int, Ring::capacity> known;
    for (int i = 0; i < ring_.triangles().size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const int vertex = mesh_.triangle(ring_.triangles()[i])[as_index(k)];
        const Convexity shape = ring_.convexity(mesh_.topology().vertex_convexity(vertex));
        if (shape == Convexity::concave || shape == Convexity::flat) continue;
        if (std::find(known.begin(), known.end(), vertex) != known.end() || !known.push_back(vertex)) continue;
        for (int f = 0; f < tool_.face_count(); ++f) {
          const auto face = tool_.face(f);
          if (std::none_of(face.vertices.begin(), face.vertices.end(), [&](int v) { return near_.contains(v); })) continue;
          const Scalar height = (axes_ * face.normal).dot(ring_.corner(ring_.triangles()[i], k) - tool_vertex(face.vertices[0]));
          if (abs(height) > reach_) continue;
          Candidate candidate;
          candidate.constraints.push_back({FeaturePair::face_vertex, f, ring_.triangles()[i], k, is_behind_});
          add(candidate, region);
        }
      }
    }
  }

  static void add(const Candidate& candidate, RegionCandidates& region) noexcept {
    if (!region.candidates.push_back(candidate)) ++region.dropped;
  }

  const Tool& tool_;
  const TriangleMesh<MeshScalar>& mesh_;
  Pose<Scalar> pose_;
  Matrix3<Scalar> axes_;
  Scalar reach_;
  Ring ring_;
  bool is_behind_ = false;
  VertexSet& near_;
};

}  // namespace feeler
