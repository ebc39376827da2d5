// A real device as the hand of a live view.
#pragma once

#include "feeler/device/conversion.hpp"
#include "feeler/device/workspace_map.hpp"
#include "live/stage_switch.hpp"

namespace feeler::demo {

/// Renders the stage on show to the handle of a real device. A stage that comes on show begins at its start, wherever the handle is, and so
/// without force. Belongs to the servo loop; no function allocates.
class RealHand {
 public:
  RealHand(StageSwitch& stages, viewer::LiveFeed& feed, const WorkspaceSettings& workspace) : stages_(stages), feed_(feed), map_(workspace) {}

  /// One tick.
  /// @param device  as it was read
  /// @return the wrench for the device
  DeviceWrench render(const ServoTick& tick, const DeviceState& device) noexcept {
    Stage& stage = stages_.current();
    if (stage.number() != placed_) {
      map_.place(device.pose, to_device_pose(stage.scene().setting.start));
      placed_ = stage.number();
    }
    DeviceState hand = device;
    hand.pose = map_.to_scene(device);
    return map_.to_device(stage.render(tick, hand, feed_));
  }

 private:
  StageSwitch& stages_;
  viewer::LiveFeed& feed_;
  WorkspaceMap map_;
  int placed_ = 0;  // number of the stage that begins where the handle was; stages count from 1
};

}  // namespace feeler::demo
