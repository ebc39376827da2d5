// Terrain and pebbles of growing size, and a rod in ever more pieces.
#include "rivals/scaling.hpp"

#include <cstdio>

#include "feeler/tool/compound_tool.hpp"
#include "rivals/arena.hpp"
#include "scenes/rod.hpp"
#include "scenes/terrain.hpp"

namespace feeler::rivals {
namespace {

template <RigidTool Tool>
std::vector<Score> scores_of(const scenes::Setting& scene, const Tool& tool, ContestOptions options) {
  options.is_judged = false;
  Arena arena(scene, tool, std::numeric_limits<double>::infinity(), 1.0 / options.rate, false);
#ifdef FEELER_HAS_ODE
  arena.contest().tools.push_back(make_ode_tool(arena.scene(), 4, 1.0 / options.rate));
#endif
  return hold(arena.contest(), options);
}

/// Points on the ellipsoid of the scene's pebble; all are vertices of their hull.
ConvexPolytope<double> pebble_of(int vertices) {
  scenes::RandomBits random(1);
  Points<double> points(vertices, 3);
  for (int i = 0; i < vertices; ++i) points.row(i) = random.direction().cwiseProduct(scenes::Vector(0.015, 0.012, 0.010)).transpose();
  return ConvexPolytope<double>::hull_of(points);
}

}  // namespace

std::vector<ScalingPoint> grow_object(const ContestOptions& options) {
  std::vector<ScalingPoint> curve;
  for (const int cells : {22, 39, 71, 122, 224, 387, 707}) {
    std::fprintf(stderr, "terrain of %d triangles\n", 2 * cells * cells);
    const scenes::Scene scene = scenes::terrain(cells);
    curve.push_back({2 * cells * cells, scores_of(scene, std::get<ConvexPolytope<double>>(scene.tool), options)});
  }
  return curve;
}

std::vector<ScalingPoint> grow_tool(const ContestOptions& options) {
  std::vector<ScalingPoint> curve;
  const scenes::Scene scene = scenes::terrain(71);
  for (const int vertices : {4, 8, 16, 32, 64, 128, 256}) {
    std::fprintf(stderr, "tool of %d vertices\n", vertices);
    curve.push_back({vertices, scores_of(scene, pebble_of(vertices), options)});
  }
  return curve;
}

std::vector<ScalingPoint> cut_tool(const ContestOptions& options) {
  std::vector<ScalingPoint> curve;
  for (const int pieces : {1, 2, 4, 8, 16, 32, 64}) {
    std::fprintf(stderr, "tool of %d pieces\n", pieces);
    const scenes::CompoundScene scene = scenes::rod(71, pieces);
    const auto tool = CompoundTool<ConvexPolytope<double>>::hulls_of(scene.pieces);
    curve.push_back({pieces, scores_of(scene, tool, options)});
  }
  return curve;
}

}  // namespace feeler::rivals
