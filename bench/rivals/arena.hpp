// Feeler and its rivals, built for one scene.
#pragma once

#include <limits>
#include <memory>

#include "rivals/contest.hpp"
#include "rivals/coupled_scene.hpp"
#include "rivals/engines.hpp"
#include "rivals/make_feeler_tool.hpp"

namespace feeler::rivals {

/// Owns what the tools of a contest refer to. With `has_rivals` unset, Feeler competes alone.
class Arena {
 public:
  template <RigidTool Tool>
  Arena(const scenes::Setting& setting, const Tool& tool, double clearance, double tick_seconds, bool has_rivals = true)
      : setting_(setting),
        elsewhere_(out_of_reach(setting)),
        scene_(coupled_scene(setting_, tool, clearance)),
        free_scene_(coupled_scene(elsewhere_, tool, clearance)),
        object_(setting_.vertices, setting_.triangles),
        far_object_(elsewhere_.vertices, elsewhere_.triangles),
        contest_{.scene = setting.name,
                 .motion = setting.motion,
                 .start = setting.start,
                 .tip = setting.tip,
                 .length = setting.length,
                 .tools = {},
                 .free_tools = {},
                 .distance = {},
                 .object = {setting_.vertices, setting_.triangles},
                 .pieces = test::checked_pieces(tool)} {
    contest_.tools.push_back(make_feeler_tool(object_, tool, setting_));
    contest_.free_tools.push_back(make_feeler_tool(far_object_, tool, elsewhere_));
    if (!has_rivals) return;
    for (auto& engine : make_engines(scene_, tick_seconds)) contest_.tools.push_back(std::move(engine));
    for (auto& engine : make_engines(free_scene_, tick_seconds)) contest_.free_tools.push_back(std::move(engine));
#ifdef FEELER_HAS_FCL
    contest_.distance = [query = std::make_shared<FclDistance>(scene_)](const Pose<double>& pose) { return (*query)(pose); };
#endif
  }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  Contest& contest() { return contest_; }
  const CoupledScene& scene() const { return scene_; }

 private:
  /// The scene with one triangle 100 m away for an object.
  static scenes::Setting out_of_reach(const scenes::Setting& setting) {
    scenes::Setting far = setting;
    far.vertices = scenes::points_from({{100.0, 0.0, 0.0}, {100.1, 0.0, 0.0}, {100.0, 0.1, 0.0}});
    far.triangles = scenes::triangles_from({{0, 1, 2}});
    return far;
  }

  scenes::Setting setting_, elsewhere_;
  CoupledScene scene_, free_scene_;
  TriangleMesh<double> object_, far_object_;
  Contest contest_;
};

}  // namespace feeler::rivals
