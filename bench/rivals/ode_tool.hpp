// A body of the Open Dynamics Engine against a triangle mesh, on a spring and a damper.
#pragma once

#include <memory>

#include "rivals/coupled_scene.hpp"
#include "rivals/coupled_tool.hpp"

namespace feeler::rivals {

/// A box or a capsule where the tool is a box or a line, else a trimesh of all its pieces, against a trimesh.
///
/// Set as its manual advises for contact without friction: QuickStep with 20 iterations, ERP 0.2, all else as
/// delivered.
/// @param scene         outlives the tool
/// @param substeps      steps of the engine in a tick
/// @param tick_seconds  between two updates
std::unique_ptr<CoupledTool> make_ode_tool(const CoupledScene& scene, int substeps, double tick_seconds = 1e-3);

}  // namespace feeler::rivals
