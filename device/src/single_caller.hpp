// One thread at a time in a maker's library, and nobody waits.
#pragma once

#include <atomic>

namespace feeler {

/// Turns at a library that need not be safe to call from two threads. Who comes while it is taken goes
/// without.
class SingleCaller {
 public:
  /// Taken where true, until it is destroyed.
  class Turn {
   public:
    explicit Turn(std::atomic_flag& is_taken) noexcept : is_taken_(is_taken.test_and_set(std::memory_order_acquire) ? nullptr : &is_taken) {}
    ~Turn() {
      if (is_taken_ != nullptr) is_taken_->clear(std::memory_order_release);
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

    explicit operator bool() const noexcept { return is_taken_ != nullptr; }

   private:
    std::atomic_flag* is_taken_;
  };

  Turn turn() noexcept { return Turn(is_taken_); }

 private:
  std::atomic_flag is_taken_;
};

}  // namespace feeler
