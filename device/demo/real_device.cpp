// Opens devices and compares scenes with what they can do.
#include "real_device.hpp"

#include <algorithm>
#include <cstdio>

#include "bad_input.hpp"

namespace feeler::demo {

std::unique_ptr<Device> open_real_device(const std::string& device, const DeviceChoice& choice) {
  if (device == "simulated") return nullptr;
  for (const Maker maker : all_makers) {
    if (device != "auto" && device != name_of(maker)) continue;
    auto opened = make_device(maker, choice);
    const OpenResult result = opened->open();
    if (result) return opened;
    if (device != "auto") throw BadInput(result.problem);
    std::printf("  note: %s\n", result.problem.c_str());
  }
  std::printf("  note: no device answers, so a simulated one is used.\n");
  return nullptr;
}

void check_rate(const DeviceSpecification& device, double rate) {
  if (rate >= device.minimum_rate && rate <= device.maximum_rate) return;
  throw BadInput("The " + device.name + " runs at " + std::to_string(int(device.minimum_rate)) + " to " + std::to_string(int(device.maximum_rate)) +
                 " Hz: give such a --rate.");
}

WorkspaceSettings real_workspace(double scale) {
  WorkspaceSettings workspace;
  workspace.scale = scale;
  workspace.clutch_buttons = 1;
  return workspace;
}

double renderable_share(const Stiffness<double>& wanted, const DeviceSpecification& device, const WorkspaceMap& map) {
  double share = std::min(1.0, map.scene_stiffness(device.stiffness) / wanted.translational.maxCoeff());
  if (device.pushes_torque()) {
    share = std::min(share, map.scene_rotational_stiffness(device.rotational_stiffness) / wanted.rotational.maxCoeff());
  }
  return share;
}

}  // namespace feeler::demo
