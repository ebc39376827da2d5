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
  std::string unit;  ///< of its numbers: "m", "cm", "mm" or "in"; of others it is guessed
  std::string bytes;
};

using Wish = std::variant<viewer::SceneRequest, viewer::CancelRequest, SentFile>;

/// The latest one counts.
class Wishes {
 public:
  void add(Wish wish) {
    const std::lock_guard lock(mutex_);
    wish_ = std::move(wish);
    has_come_.notify_one();
  }
  std::optional<Wish> wait_for(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    has_come_.wait_for(lock, time, [this] { return wish_.has_value(); });
    return std::exchange(wish_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::condition_variable has_come_;
  std::optional<Wish> wish_;
};

}  // namespace feeler::demo
