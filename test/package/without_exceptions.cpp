// A file without exceptions in a program that has files with them; see with_exceptions.cpp.
#include <feeler/feeler.hpp>

#include <array>

namespace {
const feeler::Points<double> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const feeler::Triangles triangles{{0, 1, 2}};
}  // namespace

void make_a_mesh_of_nothing_here() { feeler::TriangleMesh<double>(corners, feeler::Triangles(0, 3)); }

/// Neither throws nor aborts, and says the reason. Ticks.
bool makes_what_can_be_made() {
  using Hull = feeler::ConvexPolytope<double>;
  using Tool = feeler::Box<double>;
  using Renderer = feeler::HapticRenderer<Tool>;
  if (feeler::try_make<feeler::TriangleMesh<double>>(corners, feeler::Triangles(0, 3)).reason().empty()) return false;
  if (Hull::try_hull_of(corners.topRows(3)).reason().empty() || !Hull::try_hull_of(corners)) return false;
  const std::array<feeler::Points<double>, 2> sets{corners, corners.topRows(2)};
  if (feeler::CompoundTool<Hull>::try_hulls_of(sets).reason().find("piece 1") == std::string::npos) return false;

  const auto object = feeler::try_make<feeler::TriangleMesh<double>>(corners, triangles);
  const auto tool = feeler::try_make<Tool>(feeler::Vector3<double>(0.01, 0.01, 0.01));
  if (!object || !tool) return false;
  feeler::Settings<double> settings;
  settings.margin = 0;
  if (feeler::try_make<Renderer>(*object, *tool, settings).reason().find("margin") == std::string::npos) return false;
  auto renderer = feeler::try_make<Renderer>(*object, *tool);
  if (!renderer || renderer->reset({.translation = {0.2, 0.2, 0.02}}) != feeler::Status::converged) return false;
  const auto& tick = renderer->update({.translation = {0.2, 0.2, 0.005}});
  return tick.wrench.force.z() > 4.9 && tick.graphic_pose.translation.z() > 0.01;
}
