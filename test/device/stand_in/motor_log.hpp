// When a stand-in's motors were told to push, and when to be silent, readable from any thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

namespace feeler_test {

class MotorLog {
 public:
  using Moment = std::chrono::steady_clock::time_point;

  /// @param size  of what the motors are told from now on; any measure that is 0 for nothing
  void told(double size) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Moment now = std::chrono::steady_clock::now();
    if (size > 0) {
      last_push_ = now;
    } else if (size_ > 0) {
      silent_since_ = now;
    }
    size_ = size;
    largest_ = std::max(largest_, size);
  }
  /// Of what they push now.
  double size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return size_;
  }
  bool is_silent() const { return !(size() > 0); }
  /// The largest since this was asked last.
  double take_largest() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(largest_, size_);
  }
  Moment last_push() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_push_;
  }
  /// Of the latest silence, or the one before while something is pushed.
  Moment silent_since() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return silent_since_;
  }

 private:
  mutable std::mutex mutex_;
  double size_ = 0, largest_ = 0;
  Moment last_push_, silent_since_;
};

}  // namespace feeler_test
