// A scene on show: its renderer, and the simulated device and hand that move its tool.
#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "feeler/device/servo_loop.hpp"
#include "feeler/device/simulated_phantom.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/render/settings.hpp"
#include "feeler/viewer/live_feed.hpp"
#include "live/contact_watch.hpp"
#include "live/hand_guide.hpp"
#include "live/live_scene.hpp"
#include "live/workshop.hpp"

namespace feeler::demo {

/// How a scene is rendered: the choices that are template parameters of the renderer.
struct RenderChoice {
  std::string method = "closest";  ///< or "paper"
  std::string scalar = "double";   ///< or "float"
};

/// What every stage is made of.
struct StageParts {
  int number = 0;
  LiveScene scene;
  Settings<double> settings;
  RenderChoice choice;
  double period = 1e-3;            ///< of a tick [s]
  bool is_on_real_device = false;  ///< which moves the tool instead of the simulated hand
  std::stop_token stop = {};       ///< of the building, which ends between two steps
};

/// A scene with all that one tick of it takes. Built outside the servo loop, then handed to it; `read` and
/// `render` are the loop's, and neither allocates.
class Stage {
 public:
  explicit Stage(StageParts parts);
  virtual ~Stage() = default;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// The simulated device, one tick on.
  DeviceStatus read(DeviceState& state) noexcept;
  DeviceStatus write(const DeviceWrench& wrench) noexcept { return phantom_.write(wrench); }
  void ask(const viewer::HandRequest& request) noexcept { guide_.ask(request); }

  /// One tick of the renderer, told to the feed.
  virtual DeviceWrench render(const ServoTick& tick, const DeviceState& state, viewer::LiveFeed& feed) noexcept = 0;

  int number() const noexcept { return parts_.number; }
  const LiveScene& scene() const noexcept { return parts_.scene; }
  const Settings<double>& settings() const noexcept { return parts_.settings; }
  const TriangleMesh<double>& object() const noexcept { return *object_; }
  ContactWatch& watch() noexcept { return watch_; }  ///< the watcher's

 protected:
  /// What the next step of the building takes.
  template <class Part>
  const Part& unless_stopped(const Part& part) const {
    go_on_unless(parts_.stop);
    return part;
  }
  viewer::HandMode mode() const noexcept { return parts_.is_on_real_device ? viewer::HandMode::device : guide_.mode(); }
  std::int64_t missed_ = 0;

 private:
  StageParts parts_;
  std::shared_ptr<const TriangleMesh<double>> object_;
  ContactWatch watch_;
  HandGuide guide_;
  SimulatedPhantom phantom_;
  bool has_begun_ = false;
};

/// @throws std::invalid_argument with a sentence where the scene or the settings cannot be rendered, or Abandoned where it is stopped
std::unique_ptr<Stage> make_stage(StageParts parts);

}  // namespace feeler::demo
