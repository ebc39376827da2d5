// What was found in a mesh when it was built.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "feeler/core/number_text.hpp"

namespace feeler {

/// Counts of what a mesh is made of and of what is unusual in it. None of it stops a mesh from being an
/// obstacle.
struct MeshReport {
  int triangles = 0;              ///< rows given; none is dropped
  int vertices = 0;               ///< distinct positions in use
  int welded_vertices = 0;        ///< rows given that repeat the position of an earlier one
  int degenerate_triangles = 0;   ///< of zero area to rounding: a segment or a point, still an obstacle
  int duplicate_triangles = 0;    ///< with the three corners of an earlier one, in any order
  int boundary_edges = 0;         ///< with one triangle
  int non_manifold_edges = 0;     ///< with three triangles or more
  int inconsistent_edges = 0;     ///< whose two triangles face opposite sides
  int non_manifold_vertices = 0;  ///< where parts of the surface meet that share no manifold edge there
  std::array<double, 3> lower{};  ///< least coordinates [m]
  std::array<double, 3> upper{};  ///< largest coordinates [m]

  /// Length of the longest side of the box around it [m].
  double width() const noexcept { return (std::max)({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}); }
  /// Wider than what a hand works on: its numbers are probably millimetres, and want a scale of 0.001.
  bool looks_like_millimetres() const noexcept { return width() > 10; }

  /// The mesh is the surface of solids: every edge has two triangles, facing the same side, and no vertex
  /// joins two sheets. Points and lines alone are none.
  bool is_closed_manifold() const noexcept {
    return degenerate_triangles < triangles && boundary_edges == 0 && non_manifold_edges == 0 && inconsistent_edges == 0 &&
           non_manifold_vertices == 0 && duplicate_triangles == 0;
  }
};

/// The report as a sentence or two, for a log or a message box.
inline std::string to_string(const MeshReport& report) {
  const auto counted = [](int count, const char* one, const char* many) { return std::to_string(count) + " " + (count == 1 ? one : many); };
  std::string text = counted(report.triangles, "triangle", "triangles") + " on " + counted(report.vertices, "vertex", "vertices");
  if (report.welded_vertices > 0) text += " (" + counted(report.welded_vertices, "repeated vertex was", "repeated vertices were") + " welded)";
  text += report.is_closed_manifold() ? "; a closed surface." : "; not a closed surface.";
  std::string rest;
  const auto mention = [&](int count, const char* one, const char* many) {
    if (count > 0) rest += (rest.empty() ? " It has " : ", ") + counted(count, one, many);
  };
  mention(report.boundary_edges, "open edge", "open edges");
  mention(report.non_manifold_edges, "edge with more than two triangles", "edges with more than two triangles");
  mention(report.inconsistent_edges, "edge between triangles that face opposite sides", "edges between triangles that face opposite sides");
  mention(report.non_manifold_vertices, "vertex where separate sheets meet", "vertices where separate sheets meet");
  mention(report.degenerate_triangles, "triangle without area", "triangles without area");
  mention(report.duplicate_triangles, "duplicate triangle", "duplicate triangles");
  if (!rest.empty()) text += rest + ".";
  const auto side = [&](std::size_t k) { return detail::number_text(report.upper[k] - report.lower[k]); };
  text += " It is " + side(0) + " by " + side(1) + " by " + side(2) + " m.";
  if (report.looks_like_millimetres()) text += " If its numbers are millimetres, give the mesh the scale 0.001.";
  return text;
}

}  // namespace feeler
