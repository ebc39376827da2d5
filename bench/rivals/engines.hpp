// The rivals that are installed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rivals/coupled_scene.hpp"
#include "rivals/coupled_tool.hpp"
#ifdef FEELER_HAS_BULLET
#include "rivals/bullet_tool.hpp"
#endif
#ifdef FEELER_HAS_ODE
#include "rivals/ode_tool.hpp"
#endif
#ifdef FEELER_HAS_FCL
#include "rivals/fcl_distance.hpp"
#endif

namespace feeler::rivals {

/// Every engine with every number of substeps that is compared, at the start of the scene.
/// @param scene  outlives the tools
inline std::vector<std::unique_ptr<CoupledTool>> make_engines([[maybe_unused]] const CoupledScene& scene, [[maybe_unused]] double tick_seconds) {
  std::vector<std::unique_ptr<CoupledTool>> tools;
#ifdef FEELER_HAS_ODE
  for (const int substeps : {1, 4, 10}) tools.push_back(make_ode_tool(scene, substeps, tick_seconds));
#endif
#ifdef FEELER_HAS_BULLET
  for (const int substeps : {1, 4}) tools.push_back(make_bullet_tool(scene, substeps, tick_seconds));
  tools.push_back(make_chai3d_tool(scene, tick_seconds));
#endif
  return tools;
}

/// Debian's packages of the engines that this program was built without.
inline std::vector<std::string> missing_packages() {
  std::vector<std::string> packages;
#ifndef FEELER_HAS_ODE
  packages.emplace_back("libode-dev");
#endif
#ifndef FEELER_HAS_BULLET
  packages.emplace_back("libbullet-dev");
#endif
#ifndef FEELER_HAS_FCL
  packages.emplace_back("libfcl-dev");
#endif
  return packages;
}

}  // namespace feeler::rivals
