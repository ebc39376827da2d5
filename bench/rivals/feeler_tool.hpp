// Feeler's renderer behind the interface of its rivals.
#pragma once

#include <memory>
#include <stdexcept>

#include "feeler/feeler.hpp"
#include "rivals/coupled_tool.hpp"
#include "scenes/renderers.hpp"
#include "scenes/scene.hpp"

namespace feeler::rivals {

/// The renderer with its default settings and the stiffness of the scene.
template <RigidTool Tool>
class FeelerTool final : public CoupledTool {
 public:
  /// @param object  outlives the tool
  FeelerTool(const TriangleMesh<double>& object, const Tool& tool, const scenes::Setting& setting) : renderer_(object, tool, setting.settings()) {
    reset(setting.start);
  }

  const std::string& name() const override { return name_; }

  /// Throws where the tool would penetrate.
  void reset(const Pose<double>& pose) override {
    if (renderer_.reset(pose) != Status::converged) throw std::runtime_error("the tool is put at a pose where it penetrates.");
  }

  CoupledTick update(const Pose<double>& haptic_pose) override {
    const auto& tick = renderer_.update(haptic_pose);
    return {tick.graphic_pose, tick.wrench, {}, {tick.path.begin(), tick.path.end()}};
  }

 private:
  std::string name_ = "Feeler";
  HapticRenderer<Tool> renderer_;
};

}  // namespace feeler::rivals
