// A scene in the form that every engine can be built from: triangles of the object, pieces and triangles of
// the tool.
#pragma once

#include <concepts>
#include <limits>
#include <variant>
#include <vector>

#include "feeler/tool/compound_tool.hpp"
#include "scenes/scene.hpp"

namespace feeler::rivals {

/// Closed surfaces, triangles counter-clockwise seen from outside; or a line, as a triangle without area.
struct Surface {
  std::vector<Vector3<double>> vertices;  ///< [m]
  std::vector<Eigen::Vector3i> triangles;
};

/// What the engines need of a scene. They refer to it while they live.
struct CoupledScene {
  const scenes::Setting& setting;
  std::vector<Points<double>> pieces;  ///< vertices of each convex piece of the tool, in the tool frame [m]
  Surface tool_surface;                ///< of all pieces, in the tool frame
  std::variant<std::monostate, Box<double>, Segment<double>> primitive;     ///< the tool, for engines that know such shapes
  double clearance;  ///< the least free play of the tool in the object [m]; infinite where nothing fits
};

/// Radius of the capsule that stands for a line where an engine needs a volume [m].
inline constexpr double line_radius = 1e-4;

/// Appends a fan for each face of a convex piece; a piece without faces is a line and becomes a triangle
/// without area.
template <ConvexTool Piece>
void add_surface(const Piece& piece, Surface& surface) {
  const int first = int(surface.vertices.size());
  for (int i = 0; i < piece.vertex_count(); ++i) surface.vertices.emplace_back(piece.vertex(i));
  if (piece.face_count() == 0) {
    const ToolEdge line = piece.edge(0);
    surface.triangles.emplace_back(first + line.start, first + line.end, first + line.end);
  }
  for (int i = 0; i < piece.face_count(); ++i) {
    const auto face = piece.face(i).vertices;
    for (std::size_t k = 2; k < face.size(); ++k) {
      surface.triangles.emplace_back(first + face[0], first + face[k - 1], first + face[k]);
    }
  }
}

/// @param tool       as Feeler renders it
/// @param clearance  the least free play of the tool in the object [m]
template <RigidTool Tool>
CoupledScene coupled_scene(const scenes::Setting& setting, const Tool& tool, double clearance = std::numeric_limits<double>::infinity()) {
  CoupledScene scene{setting, {}, {}, {}, clearance};
  if constexpr (std::same_as<Tool, Box<double>> || std::same_as<Tool, Segment<double>>) scene.primitive = tool;
  for (int i = 0; i < piece_count(tool); ++i) {
    const auto& piece = piece_of(tool, i);
    Points<double> points(piece.vertex_count(), 3);
    for (int k = 0; k < piece.vertex_count(); ++k) points.row(k) = Vector3<double>(piece.vertex(k)).transpose();
    scene.pieces.push_back(points);
    add_surface(piece, scene.tool_surface);
  }
  return scene;
}

}  // namespace feeler::rivals
