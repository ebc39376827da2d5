// A body of Bullet, convex hulls against a triangle mesh, on a spring and a damper.
#pragma once

#include <memory>

#include "rivals/coupled_scene.hpp"
#include "rivals/coupled_tool.hpp"

namespace feeler::rivals {

/// Set as well as we could: the world times 100, since Bullet is made for metres, a margin of 100 µm or an
/// eighth of the clearance, ERP 0.8, 10 iterations.
/// @param scene         outlives the tool
/// @param substeps      steps of the engine in a tick
/// @param tick_seconds  between two updates
std::unique_ptr<CoupledTool> make_bullet_tool(const CoupledScene& scene, int substeps, double tick_seconds = 1e-3);

/// Set as in the demos of CHAI3D: the world times 30, a margin of 33 µm, 10 g, 4000 N/m and 30 units of
/// torque a radian, no velocity of the device, one step a tick, all else as delivered.
std::unique_ptr<CoupledTool> make_chai3d_tool(const CoupledScene& scene, double tick_seconds = 1e-3);

}  // namespace feeler::rivals
