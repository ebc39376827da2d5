// Terrain and pebbles of growing size.
#include "rivals/scaling.hpp"

#include <cstdio>

#include "rivals/arena.hpp"
#include "scenes/terrain.hpp"

namespace feeler::rivals {
namespace {

std::vector<Score> scores_of(const scenes::Scene& scene, ContestOptions options) {
  options.is_judged = false;
  Arena arena(scene, std::get<ConvexPolytope<double>>(scene.tool), std::numeric_limits<double>::infinity(),
              1.0 / options.rate, false);
#ifdef FEELER_HAS_ODE
  arena.contest().tools.push_back(make_ode_tool(arena.scene(), 4, 1.0 / options.rate));
#endif
  return hold(arena.contest(), options);
}

/// Points on the ellipsoid of the scene's pebble; all are vertices of their hull.
ConvexPolytope<double> pebble_of(int vertices) {
  scenes::RandomBits random(1);
  Points<double> points(vertices, 3);
  for (int i = 0; i < vertices; ++i)
    points.row(i) = random.direction().cwiseProduct(scenes::Vector(0.015, 0.012, 0.010)).transpose();
  return ConvexPolytope<double>::hull_of(points);
}

}  // namespace

std::vector<ScalingPoint> grow_object(const ContestOptions& options) {
  std::vector<ScalingPoint> curve;
  for (const int cells : {22, 39, 71, 122, 224, 387, 707}) {
    std::fprintf(stderr, "terrain of %d triangles\n", 2 * cells * cells);
    curve.push_back({2 * cells * cells, scores_of(scenes::terrain(cells), options)});
  }
  return curve;
}

std::vector<ScalingPoint> grow_tool(const ContestOptions& options) {
  std::vector<ScalingPoint> curve;
  scenes::Scene scene = scenes::terrain(71);
  for (const int vertices : {4, 8, 16, 32, 64, 128, 256}) {
    std::fprintf(stderr, "tool of %d vertices\n", vertices);
    scene.tool = pebble_of(vertices);
    curve.push_back({vertices, scores_of(scene, options)});
  }
  return curve;
}

}  // namespace feeler::rivals
