// Picks the part of a study that its options name.
#include "stability/selection.hpp"

#include <algorithm>

namespace feeler::stability {

std::vector<NamedDevice> all_devices() {
  return {{"premium-3.0", phantom_premium_3_0_6dof()},
          {"premium-1.5", phantom_premium_1_5_6dof()},
          {"premium-1.5-hf", phantom_premium_1_5_high_force_6dof()},
          {"touch", touch()},
          {"touch-x", touch_x()},
          {"omega.6", omega_6()},
          {"sigma.7", sigma_7()},
          {"lambda.7", lambda_7()},
          {"delta.3", delta_3()},
          {"falcon", falcon()},
          {"virtuose-6d", virtuose_6d()},
          {"virtuose-desktop", virtuose_6d_desktop()}};
}

std::vector<NamedDevice> devices_of(const StudyOptions& options, std::initializer_list<std::string_view> usual) {
  const auto holds_name = [](const auto& names, std::string_view name) {
    return names.size() == 0 || std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<NamedDevice> devices;
  for (const NamedDevice& device : all_devices()) {
    if (options.devices.empty() ? holds_name(usual, device.name) : holds_name(options.devices, device.name)) devices.push_back(device);
  }
  return devices;
}

bool is_wanted(const StudyOptions& options, const NamedGrip& grip) { return options.grip.empty() || options.grip == grip.name; }

std::vector<NamedGrip> grips_of(const StudyOptions& options) {
  std::vector<NamedGrip> wanted;
  for (const NamedGrip& grip : grips) {
    if (is_wanted(options, grip)) wanted.push_back(grip);
  }
  return wanted;
}

std::vector<Meeting> meetings_of(const StudyOptions& options, const std::vector<Situation>& situations) {
  std::vector<Meeting> meetings;
  for (const Situation& situation : situations) {
    if (options.scene.empty() || options.scene == situation.scene)
      meetings.push_back({situation, contact_of(situation, scene_named(situation.scene))});
  }
  return meetings;
}

bool concerns(const DeviceSpecification& device, const Situation& situation) noexcept { return device.pushes_torque() || !situation.turns(); }

}  // namespace feeler::stability
