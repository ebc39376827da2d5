// A loop at the stiffness of its device's preset, and how stiff it may be made.
#pragma once

#include "stability/closed_loop.hpp"
#include "stability/selection.hpp"

namespace feeler::stability {

/// The stiffness of the preset; where no motor turns the handle, a turn is shown as one of 10 mm.
LoopSetup preset_loop(const StudyOptions& options, const DeviceSpecification& device, const Grip& grip, double rate);

/// What linear theory knows of a device.
inline Handle handle_of(const DeviceSpecification& device) noexcept {
  return {device.apparent_mass, device.apparent_inertia, device.damping, device.rotational_damping};
}

/// The largest stiffness of the loop's kind, translational or rotational, the other one left; 0 where none
/// is.
double limit_of(const Meeting& meeting, LoopSetup setup);

}  // namespace feeler::stability
