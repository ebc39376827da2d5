// Makes stages from what pages wish for.
#pragma once

#include <atomic>
#include <memory>
#include <stop_token>
#include <string>

#include "feeler/device/device.hpp"
#include "feeler/viewer/page_message.hpp"
#include "live/gallery.hpp"
#include "live/stage.hpp"
#include "options.hpp"
#include "real_device.hpp"

namespace feeler::demo {

using Text = std::shared_ptr<const std::string>;

inline Text shared_text(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

/// A stage as pages are told of it.
struct Shown {
  std::shared_ptr<Stage> stage;
  Text text;
  Text mesh;
};

/// Counts the stages that it makes, on whatever threads.
class StageBuilder {
 public:
  /// @param device  a real one that is to feel the stages; none where the hand is simulated
  StageBuilder(const Options& options, const Device* device)
      : period_(1 / options.rate), workspace_(real_workspace(options.workspace_scale)), device_(device) {}

  /// @throws BadInput or std::invalid_argument with a sentence for the page, or Abandoned where it is stopped
  Shown build(const GalleryEntry& entry, const viewer::SceneRequest& wish, const std::stop_token& stop = {});

 private:
  double period_;
  WorkspaceSettings workspace_;
  const Device* device_;
  std::atomic<int> number_ = 0;
};

}  // namespace feeler::demo
