// What pages ask to be built, from the server's thread to the one that builds.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "feeler/viewer/page_message.hpp"

namespace feeler::demo {

/// A mesh file from a page.
struct SentFile {
  std::string name;
  std::string bytes;
};

using Wish = std::variant<viewer::SceneRequest, SentFile>;

/// Of scenes the latest one counts; a file waits for its turn.
class Wishes {
 public:
  void add(viewer::SceneRequest request) {
    const std::lock_guard lock(mutex_);
    scene_ = std::move(request);
    has_come_.notify_one();
  }
  /// @return whether there was room: one file waits at most
  bool add(SentFile file) {
    const std::lock_guard lock(mutex_);
    if (file_) return false;
    file_ = std::move(file);
    has_come_.notify_one();
    return true;
  }
  std::optional<Wish> wait_for(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    has_come_.wait_for(lock, time, [this] { return scene_ || file_; });
    if (auto file = std::exchange(file_, std::nullopt)) return Wish(*std::move(file));
    if (auto scene = std::exchange(scene_, std::nullopt)) return Wish(*std::move(scene));
    return std::nullopt;
  }

 private:
  std::mutex mutex_;
  std::condition_variable has_come_;
  std::optional<viewer::SceneRequest> scene_;
  std::optional<SentFile> file_;
};

}  // namespace feeler::demo
