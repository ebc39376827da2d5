// Feeler's renderer for every type of tool in the scenes, compiled once.
#pragma once

#include <memory>

#include "feeler/object/triangle_mesh.hpp"
#include "feeler/tool/rigid_tool.hpp"
#include "rivals/coupled_tool.hpp"
#include "scenes/scene.hpp"

namespace feeler::rivals {

/// Instantiated for the tools of `scenes::Tool` and for compounds of polytopes.
/// @param object  outlives the tool
template <RigidTool Tool>
std::unique_ptr<CoupledTool> make_feeler_tool(const TriangleMesh<double>& object, const Tool& tool, const scenes::Setting& setting);

}  // namespace feeler::rivals
