// A stage with its renderer: the one template of the live view.
#pragma once

#include <chrono>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "feeler/device/conversion.hpp"
#include "feeler/render/fold_detector.hpp"
#include "feeler/render/haptic_renderer.hpp"
#include "live/stage.hpp"

namespace feeler::demo {

/// @tparam Renderer  a `HapticRenderer` of any tool, scalar and contact method
template <class Renderer>
class RenderedStage final : public Stage {
 public:
  using Tool = typename Renderer::Tool;
  using Scalar = typename Renderer::Scalar;

  RenderedStage(StageParts parts, const Tool& tool)
      : Stage(std::move(parts)), renderer_(unless_stopped(mesh()), tool, cast(settings())), fold_(cast(settings())) {
    if (renderer_.reset(scene().setting.start.template cast<Scalar>()) == TickStatus::penetrating)
      throw std::invalid_argument("The tool would begin inside the object: give more clearance.");
    fold_.reset(scene().setting.start.template cast<Scalar>(), renderer_.tick().graphic_pose);
  }

  DeviceWrench render(const ServoTick& servo, const DeviceState& state, viewer::LiveFeed& feed) noexcept override {
    const auto haptic = from_device<Pose<Scalar>>(state.pose);
    const auto before = std::chrono::steady_clock::now();
    const Tick<Scalar>& tick = renderer_.update(haptic);
    const auto after = std::chrono::steady_clock::now();
    const bool has_folded = fold_.observe(haptic, tick) != nullptr;

    const DeviceWrench wrench = to_device_wrench(tick.wrench);
    missed_ += servo.missed;
    viewer::Snapshot snapshot{servo.index,
                              servo.time,
                              number(),
                              mode(),
                              state.pose,
                              to_device_pose(tick.graphic_pose),
                              wrench,
                              std::int32_t(tick.status),
                              tick.iterations,
                              tick.rows,
                              tick.work,
                              missed_,
                              tick.contacts.size(),
                              {}};
    for (int i = 0; i < tick.contacts.size(); ++i) snapshot.contacts[std::size_t(i)] = shown(tick.contacts[i]);
    const Twist<Scalar> apart = motion_between(haptic, tick.graphic_pose);
    feed.tell(snapshot, {servo.time, wrench, double(apart.linear.norm()), double(apart.angular.norm()),
                         1e6 * std::chrono::duration<double>(after - before).count(), 1e-3 * double(servo.late), tick.contacts.size(),
                         tick.iterations, std::int32_t(servo.missed), tick.status != TickStatus::unconverged, has_folded});
    return wrench;
  }

 private:
  /// The object in the renderer's scalar; that in double there is already.
  const TriangleMesh<Scalar>& mesh() {
    if constexpr (std::is_same_v<Scalar, double>) {
      return object();
    } else {
      return narrowed_.emplace(scene().setting.vertices.template cast<Scalar>(), scene().setting.triangles);
    }
  }

  static Settings<Scalar> cast(const Settings<double>& settings) {
    Settings<Scalar> result;
    result.stiffness = {settings.stiffness.translational.cast<Scalar>(), settings.stiffness.rotational.cast<Scalar>()};
    result.margin = Scalar(settings.margin);
    result.closed_means_solid = settings.closed_means_solid;
    return result;
  }

  static viewer::ShownContact shown(const ActiveContact<Scalar>& contact) noexcept {
    const auto& p = contact.point_world;
    const auto& n = contact.normal_world;
    return {
        0, {double(p.x()), double(p.y()), double(p.z())}, {double(n.x()), double(n.y()), double(n.z())}, double(contact.gap), double(contact.force)};
  }

  std::optional<TriangleMesh<Scalar>> narrowed_;
  Renderer renderer_;
  FoldDetector<Scalar> fold_;
};

}  // namespace feeler::demo
