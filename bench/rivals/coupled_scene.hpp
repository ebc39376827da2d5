// A scene in the form that every engine can be built from: triangles of the object, pieces and triangles of
// the tool.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <variant>
#include <vector>

#include "feeler/tool/compound_tool.hpp"
#include "scenes/scene.hpp"

namespace feeler::rivals {

/// A closed surface or several; triangles counter-clockwise seen from outside.
struct Surface {
  std::vector<Vector3<double>> vertices;  ///< [m]
  std::vector<Eigen::Vector3i> triangles;
};

/// What the engines need of a scene. They refer to it while they live.
struct CoupledScene {
  const scenes::Setting& setting;
  std::vector<Points<double>> pieces;  ///< vertices of each convex piece of the tool, in the tool frame [m]
  Surface tool_surface;                ///< of all pieces, in the tool frame
  std::variant<std::monostate, Box<double>, Segment<double>>
      primitive;     ///< the tool, for engines that know such shapes
  double clearance;  ///< the least free play of the tool in the object [m]; infinite where nothing fits
};

/// Radius of the capsule or prism that stands for a line where an engine needs a volume [m].
inline constexpr double line_radius = 1e-4;

/// Appends a fan for each face of a convex piece; a piece without faces is a line and becomes a thin prism.
template <ConvexTool Piece>
void add_surface(const Piece& piece, Surface& surface) {
  if (piece.face_count() == 0) {
    const Vector3<double> start = piece.vertex(piece.edge(0).start), end = piece.vertex(piece.edge(0).end);
    const Vector3<double> across = (end - start).unitOrthogonal(),
                          other = (end - start).normalized().cross(across);
    Points<double> prism(12, 3);
    for (int i = 0; i < 6; ++i) {
      const double angle = double(i) * std::numbers::pi / 3.0;
      const Vector3<double> out = line_radius * (std::cos(angle) * across + std::sin(angle) * other);
      prism.row(2 * i) = (start + out).transpose();
      prism.row(2 * i + 1) = (end + out).transpose();
    }
    return add_surface(ConvexPolytope<double>::hull_of(prism), surface);
  }
  const int first = int(surface.vertices.size());
  for (int i = 0; i < piece.vertex_count(); ++i) surface.vertices.emplace_back(piece.vertex(i));
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
CoupledScene coupled_scene(const scenes::Setting& setting, const Tool& tool,
                           double clearance = std::numeric_limits<double>::infinity()) {
  CoupledScene scene{setting, {}, {}, {}, clearance};
  if constexpr (std::same_as<Tool, Box<double>> || std::same_as<Tool, Segment<double>>)
    scene.primitive = tool;
  for (int i = 0; i < piece_count(tool); ++i) {
    const auto& piece = piece_of(tool, i);
    Points<double> points(piece.vertex_count(), 3);
    for (int k = 0; k < piece.vertex_count(); ++k)
      points.row(k) = Vector3<double>(piece.vertex(k)).transpose();
    scene.pieces.push_back(points);
    add_surface(piece, scene.tool_surface);
  }
  return scene;
}

}  // namespace feeler::rivals
