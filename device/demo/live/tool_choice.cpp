// Makes tools of any size about any middle.
#include "live/tool_choice.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "scenes/terrain.hpp"

namespace feeler::demo {
namespace {

Points<double> vertices_of(const LiveTool& tool) {
  std::vector<Vector3<double>> list;
  for_each_piece(tool, [&](const auto& piece) {
    for (int i = 0; i < piece.vertex_count(); ++i) list.push_back(piece.vertex(i));
  });
  return scenes::points_from(list);
}

/// The hull of points about a middle.
ConvexPolytope<double> hull_about(const Vector3<double>& middle, Points<double> points) {
  points.rowwise() += middle.transpose();
  return ConvexPolytope<double>::hull_of(points);
}

Points<double> cube_corners(double radius) {
  Points<double> corners(8, 3);
  for (int i = 0; i < 8; ++i) corners.row(i) << ((i & 1) ? 1 : -1), ((i & 2) ? 1 : -1), ((i & 4) ? 1 : -1);
  return corners * (radius / std::sqrt(3.0));
}

Points<double> pebble_points(double radius) {
  const ConvexPolytope<double> pebble = scenes::pebble(1);
  Points<double> points = vertices_of(pebble);
  return points * (radius / points.rowwise().norm().maxCoeff());
}

/// The vertex farthest in the direction in which the last tool's tip was.
Vector3<double> tip_of(const Points<double>& vertices, const Vector3<double>& direction) {
  Eigen::Index farthest = 0;
  (vertices * direction).maxCoeff(&farthest);
  return vertices.row(farthest).transpose();
}

}  // namespace

void choose_tool(LiveScene& scene, const std::string& kind) {
  if (kind.empty() || kind == "own") return;
  const Points<double> own = vertices_of(scene.tool);
  const Vector3<double> middle = (own.colwise().minCoeff() + own.colwise().maxCoeff()).transpose() / 2;
  const double radius = (own.rowwise() - middle.transpose()).rowwise().norm().maxCoeff() / 2;
  if (kind == "cube") {
    scene.tool = hull_about(middle, cube_corners(radius));
  } else if (kind == "pebble") {
    scene.tool = hull_about(middle, pebble_points(radius));
  } else if (kind == "needle") {
    const Vector3<double> half(0, 0, radius);
    scene.tool = Segment<double>(middle - half, middle + half);
  } else {
    throw std::invalid_argument("There is no tool " + kind + ".");
  }
  scene.setting.tip = tip_of(vertices_of(scene.tool), scene.setting.tip - middle);
}

}  // namespace feeler::demo
