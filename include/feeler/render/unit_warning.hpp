// A word to the user whose numbers are probably no metres.
#pragma once

#include <string>

#include <Eigen/Geometry>

#include "feeler/core/number_text.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/tool/rigid_tool.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// Length of the longest side of the box around a tool, along the axes of its frame [m].
template <RigidTool Tool>
double width_of(const Tool& tool) noexcept {
  Eigen::AlignedBox3d box;
  for (int i = 0; i < piece_count(tool); ++i) {
    const auto& piece = piece_of(tool, i);
    const Vector3<double> round = Vector3<double>::Constant(static_cast<double>(swept_radius(piece)));
    for (int v = 0; v < piece.vertex_count(); ++v) {
      const Vector3<double> vertex = piece.vertex(v).template cast<double>();
      box.extend(vertex - round).extend(vertex + round);
    }
  }
  return box.sizes().maxCoeff();
}

/// A sentence where an object is wider than 10 m or a tool than 1 m, as if they were in millimetres; else nothing. For a log, when a scene is loaded.
template <RigidTool Tool>
std::string unit_warning(const TriangleMesh<typename Tool::Scalar>& object, const Tool& tool) {
  const double width = width_of(tool);
  const bool is_tool_wide = width > 1;
  if (!is_tool_wide && !object.report().looks_like_millimetres()) return {};
  return "The object is " + detail::number_text(object.report().width()) + " m wide and the tool " + detail::number_text(width) +
         (is_tool_wide ? " m; if the numbers are in millimetres, give them in metres, by the scale 0.001."
                       : " m; if the object's numbers are in millimetres, give it the scale 0.001.");
}

}  // namespace feeler
