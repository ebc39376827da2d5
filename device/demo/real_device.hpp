// The real device that the user asks for, and what it asks of a scene.
#pragma once

#include <memory>
#include <string>

#include "feeler/device/device_catalogue.hpp"
#include "feeler/device/workspace_map.hpp"
#include "feeler/render/settings.hpp"

namespace feeler::demo {

/// Opens it.
/// @param device  a maker, `auto` for the first that answers, or `simulated`
/// @return nothing where a simulated one is meant, or has to do
/// @throws BadInput where that of a maker does not open
std::unique_ptr<Device> open_real_device(const std::string& device, const DeviceChoice& choice);

/// @throws BadInput where the device does not run at this rate [Hz]
void check_rate(const DeviceSpecification& device, double rate);

/// How a real device lies in a scene: its first button is a clutch.
/// @param scale  metres of the scene a metre of the device
WorkspaceSettings real_workspace(double scale);

/// How much of a stiffness the device renders without buzzing.
double renderable_share(const Stiffness<double>& wanted, const DeviceSpecification& device, const WorkspaceMap& map);

}  // namespace feeler::demo
