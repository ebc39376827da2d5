// The clock of the servo loop: the monotonic one of the system, or one that a test moves.
#pragma once

#include <cstdint>

namespace feeler {

/// Nanoseconds since some fixed moment, and waiting for a moment.
class Clock {
 public:
  virtual ~Clock() = default;

  virtual std::int64_t now() noexcept = 0;                     ///< [ns]
  virtual void sleep_until(std::int64_t moment) noexcept = 0;  ///< [ns]; returns at once when it has passed

 protected:
  Clock() = default;
  Clock(const Clock&) = default;
  Clock& operator=(const Clock&) = default;
};

/// CLOCK_MONOTONIC, on Windows the performance counter, with waits for absolute moments: a wait that starts late does not end later.
class MonotonicClock final : public Clock {
 public:
  std::int64_t now() noexcept override;
  void sleep_until(std::int64_t moment) noexcept override;
};

}  // namespace feeler
