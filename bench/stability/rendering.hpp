// What the closed loop is closed with: the device's pose in, the wrench on the hand out.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/wrench.hpp"
#include "scenes/scene.hpp"

/// A simulated device in a simulated hand, closed over a renderer, and how stiff that may be.
namespace feeler::stability {

/// A renderer in the loop. One `update` is one of its ticks.
class Rendering {
 public:
  Rendering() = default;
  Rendering(const Rendering&) = delete;
  Rendering& operator=(const Rendering&) = delete;
  virtual ~Rendering() = default;

  /// Puts the tool at a pose, at rest; throws where it would penetrate.
  virtual void reset(const Pose<double>& pose) = 0;
  /// The wrench on the hand at the origin of the tool frame, world axes.
  virtual Wrench<double> update(const Pose<double>& haptic_pose) = 0;
  /// Of the last tick; the derivative of the wrench by the haptic pose, row by row. False where it is not
  /// known.
  virtual bool derivative(std::array<double, 36>& /*rows*/) const { return false; }
};

/// Who renders.
enum class Engine {
  feeler,
  ode,            ///< with four substeps; the spring alone is felt
  ode_damped,     ///< the spring and its damper are felt: the whole reaction of the coupling
  bullet,         ///< as well set as we could, one step a tick; the spring alone is felt
  bullet_damped,  ///< spring and damper
};
constexpr std::array<Engine, 5> all_engines = {Engine::feeler, Engine::ode, Engine::ode_damped, Engine::bullet, Engine::bullet_damped};

const char* name_of(Engine engine) noexcept;
/// Whether it was built: rivals are, where they are installed.
bool is_built(Engine engine) noexcept;

/// @param scene   outlives the rendering; its stiffness is what is rendered
/// @param period  of the ticks of the renderer [s]
/// @return nothing for an engine that was not built
std::unique_ptr<Rendering> make_rendering(Engine engine, const scenes::Scene& scene, double period);

}  // namespace feeler::stability
