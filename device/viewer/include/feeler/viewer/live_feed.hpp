// The hand-off between the servo loop and its one watcher; neither waits for the other.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include <boost/lockfree/spsc_queue.hpp>

#include "feeler/device/latest_value.hpp"
#include "feeler/viewer/live_state.hpp"

namespace feeler::viewer {

/// What somebody at a page asks of the hand.
struct HandRequest {
  HandMode mode = HandMode::still;
  std::int32_t stage = 0;  ///< number of the scene that is meant; another one pays no heed
  DevicePose pose;         ///< where the hand is to go, of `HandMode::person`; unit quaternion
};

/// The newest snapshot, every tick's sample, and the latest request to the hand. One servo thread and one
/// watcher thread; all functions are wait-free and allocate nothing.
class LiveFeed {
 public:
  static constexpr std::size_t sample_capacity = 8192;  ///< eight seconds at 1 kHz, should the watcher be kept from running

  /// By the servo loop, once a tick.
  void tell(const Snapshot& snapshot, const TickSample& sample) noexcept {
    snapshots_.store(snapshot);
    if (!samples_.push(sample)) lost_.fetch_add(1, std::memory_order_relaxed);
  }
  /// By the servo loop. @return whether there was a request that was not fetched before
  bool fetch(HandRequest& request) noexcept { return requests_.fetch(request); }

  /// By the watcher. @return whether there was a snapshot that was not fetched before
  bool fetch(Snapshot& snapshot) noexcept { return snapshots_.fetch(snapshot); }
  /// By the watcher: calls `take(sample)` for all samples told since, in order.
  template <class Take>
  void drain(const Take& take) {
    samples_.consume_all(take);
  }
  /// By the watcher; a later request overwrites one that the loop has not seen.
  void ask(const HandRequest& request) noexcept { requests_.store(request); }

  /// Samples that found no room, because nobody drained.
  std::int64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  LatestValue<Snapshot> snapshots_;
  LatestValue<HandRequest> requests_;
  boost::lockfree::spsc_queue<TickSample, boost::lockfree::capacity<sample_capacity>> samples_;
  std::atomic<std::int64_t> lost_ = 0;
};

}  // namespace feeler::viewer
