// Maps poses to the scene and wrenches back.
#include "feeler/device/workspace_map.hpp"

#include <algorithm>
#include <cmath>

#include "feeler/core/requirement.hpp"
#include "quaternion.hpp"

namespace feeler {

using quaternion::conjugate;
using quaternion::multiply;
using quaternion::rotate;

WorkspaceMap::WorkspaceMap(const WorkspaceSettings& settings) : settings_(settings) { refuse_for(reason_against(settings)); }

std::string WorkspaceMap::reason_against(const WorkspaceSettings& settings) {
  if (!(settings.scale > 0 && std::isfinite(settings.scale))) return "workspace map: the scale must be positive and finite";
  const double* q = settings.scene_from_device;
  if (!(std::abs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1) <= 2e-6))
    return "workspace map: the rotation must be a unit quaternion w, x, y, z";
  return {};
}

void WorkspaceMap::place(const DevicePose& device, const DevicePose& scene) noexcept {
  put_origin(device, scene);
  put_rotation(device, scene);
  held_ = scene;
}

DevicePose WorkspaceMap::to_scene(const DeviceState& state) noexcept {
  const bool was_clutched = is_clutched_;
  is_clutched_ = (state.buttons & settings_.clutch_buttons) != 0;
  if (was_clutched && !is_clutched_) {
    put_origin(state.pose, held_);
    if (settings_.clutches_rotation) put_rotation(state.pose, held_);
  }
  const DevicePose pose = mapped(state.pose);
  if (!is_clutched_) return held_ = pose;
  if (!settings_.clutches_rotation) std::copy(pose.orientation, pose.orientation + 4, held_.orientation);
  return held_;
}

DeviceWrench WorkspaceMap::to_device(const DeviceWrench& scene) const noexcept {
  DeviceWrench device;
  if (is_clutched_) return device;
  double device_from_scene[4];
  conjugate(settings_.scene_from_device, device_from_scene);
  rotate(device_from_scene, scene.force, device.force);
  rotate(device_from_scene, scene.torque, device.torque);
  for (double& component : device.torque) component /= settings_.scale;
  return device;
}

DevicePose WorkspaceMap::mapped(const DevicePose& device) const noexcept {
  DevicePose scene;
  rotate(settings_.scene_from_device, device.position, scene.position);
  for (int i = 0; i < 3; ++i) scene.position[i] = settings_.scale * scene.position[i] + origin_[i];
  double scene_from_handle[4];
  multiply(settings_.scene_from_device, device.orientation, scene_from_handle);
  multiply(scene_from_handle, handle_from_tool_, scene.orientation);
  return scene;
}

void WorkspaceMap::put_origin(const DevicePose& device, const DevicePose& scene) noexcept {
  const DevicePose now = mapped(device);
  for (int i = 0; i < 3; ++i) origin_[i] += scene.position[i] - now.position[i];
}

void WorkspaceMap::put_rotation(const DevicePose& device, const DevicePose& scene) noexcept {
  double scene_from_handle[4];
  double handle_from_scene[4];
  multiply(settings_.scene_from_device, device.orientation, scene_from_handle);
  conjugate(scene_from_handle, handle_from_scene);
  multiply(handle_from_scene, scene.orientation, handle_from_tool_);
  // Of unit length for ever, however often the clutch is used.
  const double* c = handle_from_tool_;
  const double length = std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2] + c[3] * c[3]);
  for (double& component : handle_from_tool_) component /= length;
}

}  // namespace feeler
