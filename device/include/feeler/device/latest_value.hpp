// A hand-off of the latest value from the servo loop to one watcher; neither ever waits for the other.
#pragma once

#include <array>
#include <atomic>
#include <type_traits>

namespace feeler {

/// A triple buffer for one writing and one reading thread. The writer never waits, the reader never sees half a value or an older one
/// than before, and values that nobody fetched are overwritten.
/// @tparam T  what is handed over: trivially copyable, so that a store is a copy of bytes
template <class T>
  requires std::is_trivially_copyable_v<T>
class LatestValue {
 public:
  /// By the one writer. Wait-free: a copy and one atomic exchange.
  void store(const T& value) noexcept {
    slots_[writing_].value = value;
    writing_ = shared_.exchange(writing_ | fresh_, std::memory_order_acq_rel) & index_;
  }

  /// By the one reader. Wait-free.
  /// @param value  the latest value stored, when it was not fetched before; else as it was
  /// @return true if there was a new value
  bool fetch(T& value) noexcept {
    if ((shared_.load(std::memory_order_relaxed) & fresh_) == 0) return false;
    reading_ = shared_.exchange(reading_, std::memory_order_acq_rel) & index_;
    value = slots_[reading_].value;
    return true;
  }

 private:
  static constexpr unsigned index_ = 3;
  static constexpr unsigned fresh_ = 4;

  // A cache line each, so that reading one does not slow the writing of another.
  struct alignas(64) Slot {
    T value = {};
  };

  std::array<Slot, 3> slots_ = {};
  alignas(64) unsigned writing_ = 0;
  alignas(64) std::atomic<unsigned> shared_ = 1;
  alignas(64) unsigned reading_ = 2;
};

}  // namespace feeler
