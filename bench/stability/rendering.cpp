// Feeler and its rivals behind one interface.
#include "stability/rendering.hpp"

#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "feeler/device/conversion.hpp"
#include "rivals/bullet_tool.hpp"
#include "rivals/ode_tool.hpp"
#include "scenes/renderers.hpp"

namespace feeler::stability {
namespace {

template <RigidTool Tool>
class FeelerRendering final : public Rendering {
 public:
  FeelerRendering(const scenes::Scene& scene, const Tool& tool)
      : object_(scene.vertices, scene.triangles), renderer_(object_, tool, scene.settings()) {}

  void reset(const Pose<double>& pose) override {
    if (renderer_.reset(pose) != Status::converged) throw std::runtime_error("a tool is put at a pose where it penetrates");
  }
  Wrench<double> update(const Pose<double>& haptic_pose) override { return renderer_.update(haptic_pose).wrench; }
  bool derivative(std::array<double, 36>& rows) const override {
    const auto derivative = wrench_derivative(renderer_);
    store_derivative(derivative.matrix, rows);
    return true;
  }

 private:
  TriangleMesh<double> object_;
  HapticRenderer<Tool> renderer_;
};

class RivalRendering final : public Rendering {
 public:
  template <class Make>
  RivalRendering(rivals::CoupledScene scene, bool is_damped, const Make& make)
      : scene_(std::move(scene)), is_damped_(is_damped), tool_(make(scene_)) {}

  void reset(const Pose<double>& pose) override { tool_->reset(pose); }
  Wrench<double> update(const Pose<double>& haptic_pose) override {
    const rivals::CoupledTick tick = tool_->update(haptic_pose);
    if (!is_damped_) return tick.wrench;
    return {tick.wrench.force + tick.damping.force, tick.wrench.torque + tick.damping.torque};
  }

 private:
  rivals::CoupledScene scene_;
  bool is_damped_;
  std::unique_ptr<rivals::CoupledTool> tool_;
};

}  // namespace

const char* name_of(Engine engine) noexcept {
  switch (engine) {
    case Engine::feeler: return "feeler";
    case Engine::ode: return "ode";
    case Engine::ode_damped: return "ode-damped";
    case Engine::bullet: return "bullet";
    case Engine::bullet_damped: return "bullet-damped";
  }
  return "unknown";
}

bool is_built(Engine engine) noexcept {
  switch (engine) {
    case Engine::feeler: return true;
    case Engine::ode:
    case Engine::ode_damped:
#ifdef FEELER_HAS_ODE
      return true;
#else
      return false;
#endif
    case Engine::bullet:
    case Engine::bullet_damped:
#ifdef FEELER_HAS_BULLET
      return true;
#else
      return false;
#endif
  }
  return false;
}

std::unique_ptr<Rendering> make_rendering(Engine engine, const scenes::Scene& scene, [[maybe_unused]] double period) {
  return std::visit(
      [&](const auto& tool) -> std::unique_ptr<Rendering> {
        using Tool = std::remove_cvref_t<decltype(tool)>;
        if (engine == Engine::feeler) return std::make_unique<FeelerRendering<Tool>>(scene, tool);
        const double clearance = scene.name == "cavity" ? 1e-3 : std::numeric_limits<double>::infinity();
        [[maybe_unused]] rivals::CoupledScene coupled = rivals::coupled_scene(scene, tool, clearance);
        [[maybe_unused]] const bool is_damped = engine == Engine::ode_damped || engine == Engine::bullet_damped;
#ifdef FEELER_HAS_ODE
        if (engine == Engine::ode || engine == Engine::ode_damped) {
          return std::make_unique<RivalRendering>(std::move(coupled), is_damped,
                                                  [period](const rivals::CoupledScene& s) { return rivals::make_ode_tool(s, 4, period); });
        }
#endif
#ifdef FEELER_HAS_BULLET
        if (engine == Engine::bullet || engine == Engine::bullet_damped) {
          return std::make_unique<RivalRendering>(std::move(coupled), is_damped,
                                                  [period](const rivals::CoupledScene& s) { return rivals::make_bullet_tool(s, 1, period); });
        }
#endif
        return nullptr;
      },
      scene.tool);
}

}  // namespace feeler::stability
