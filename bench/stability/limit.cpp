// Raises the stiffness of a loop until it is not stable.
#include "stability/limit.hpp"

#include "stability/search.hpp"

namespace feeler::stability {

LoopSetup preset_loop(const StudyOptions& options, const DeviceSpecification& device, const Grip& grip, double rate) {
  constexpr double length = 0.010;
  LoopSetup setup;
  setup.device = device;
  setup.grip = grip;
  setup.rate = rate;
  setup.stiffness = device.stiffness;
  setup.rotational_stiffness = device.pushes_torque() ? device.rotational_stiffness : device.stiffness * length * length;
  setup.has_friction = options.has_friction;
  return setup;
}

double limit_of(const Meeting& meeting, LoopSetup setup) {
  double& stiffness = meeting.situation.turns() ? setup.rotational_stiffness : setup.stiffness;
  const double guess = stiffness;
  // The metric follows the stiffness: with the other one left, the tool would be held by a length that no
  // scene has.
  const double length_squared = setup.rotational_stiffness / setup.stiffness;
  return largest_where(
      [&](double value) {
        stiffness = value;
        if (!setup.device.pushes_torque()) setup.rotational_stiffness = length_squared * value;
        return run_loop(meeting.situation, meeting.contact, setup).is_stable;
      },
      guess, guess / 300, guess * 300);
}

}  // namespace feeler::stability
