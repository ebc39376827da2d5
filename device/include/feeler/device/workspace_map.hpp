// From the workspace of a device to a scene and back: scale, rotation, and a clutch to reach beyond the
// device's end.
#pragma once

#include <cstdint>
#include <string>

#include "feeler/device/device_specification.hpp"
#include "feeler/device/device_state.hpp"

namespace feeler {

/// How a device lies in a scene.
struct WorkspaceSettings {
  double scale = 1;                            ///< metres of the scene a metre of the device; above 0
  double scene_from_device[4] = {1, 0, 0, 0};  ///< unit quaternion w, x, y, z
  std::uint32_t clutch_buttons = 0;  ///< pressing any of these lifts the tool off the device; 0 for no clutch
  bool clutches_rotation = false;    ///< else the tool goes on turning with the handle
};

/// The map of one session:
///
///     p_scene = s R p_device + t,   R_scene = R R_device C
///
/// with the scale s and the rotation R of the settings. The clutch changes t, and C if it clutches rotations.
/// A wrench goes back as
///
///     F_device = Rᵀ F_scene,   τ_device = Rᵀ τ_scene / s
///
/// which does 1/s times the work of the scene in every motion, so what is passive in the scene is passive in
/// the hand. The hand then feels s times the renderer's translational stiffness and 1/s times its rotational
/// one; `scene_stiffness` corrects for it.
class WorkspaceMap {
 public:
  /// Refuses (`std::invalid_argument`) a scale that is not positive and finite, and a quaternion that is not
  /// a unit one to 1e-6.
  explicit WorkspaceMap(const WorkspaceSettings& settings = {});
  /// The sentence with which the constructor refuses; empty where it does not.
  static std::string reason_against(const WorkspaceSettings& settings = {});

  /// Puts the scene's pose where the device's is now, both position and orientation.
  void place(const DevicePose& device, const DevicePose& scene) noexcept;

  /// One tick. While the clutch is held the tool stays where it was, and then goes on from there. No
  /// allocation.
  /// @return the pose of the tool in the scene
  DevicePose to_scene(const DeviceState& state) noexcept;

  /// The wrench for the device, at the origin of the handle; nothing while the clutch is held, for the tool
  /// then does not follow the hand.
  DeviceWrench to_device(const DeviceWrench& scene) const noexcept;

  bool is_clutched() const noexcept { return is_clutched_; }

  /// The stiffness for the renderer with which the hand feels this one [N/m].
  double scene_stiffness(double device_stiffness) const noexcept { return device_stiffness / settings_.scale; }
  /// The same of rotations [N·m/rad].
  double scene_rotational_stiffness(double device_stiffness) const noexcept { return device_stiffness * settings_.scale; }

 private:
  DevicePose mapped(const DevicePose& device) const noexcept;
  void put_origin(const DevicePose& device, const DevicePose& scene) noexcept;
  void put_rotation(const DevicePose& device, const DevicePose& scene) noexcept;

  WorkspaceSettings settings_;
  double origin_[3] = {0, 0, 0};               // t [m]
  double handle_from_tool_[4] = {1, 0, 0, 0};  // C
  DevicePose held_;                            // the tool while the clutch is held
  bool is_clutched_ = false;
};

}  // namespace feeler
