// What drivers share whose library answers at once, in the thread that calls it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <utility>

#include "feeler/device/clock.hpp"
#include "feeler/device/device.hpp"
#include "feeler/device/device_specification.hpp"
#include "feeler/device/device_state.hpp"
#include "single_caller.hpp"

namespace feeler {

/// A device whose library `read` and `write` call directly: who may call it, when it pushes, and what is told of it. What it is asked, and how, is
/// the maker's.
///
/// A device that is lost stays lost until it is opened again, and is told to let go as long as somebody asks it to push.
class DirectDriver : public Device {
 public:
  OpenResult open() final;
  DeviceStatus read(DeviceState& state) noexcept final;
  DeviceStatus write(const DeviceWrench& wrench) noexcept final;
  void let_go() noexcept final;
  void close() noexcept final;
  const DeviceSpecification& specification() const noexcept final { return specification_; }
  const char* complaint() const noexcept final { return complaint_.data(); }

 protected:
  /// How a push went.
  struct Answer {
    bool is_taken = false;
    const char* complaint = nullptr;  ///< none where nothing is wrong
  };

  /// @param specification  until the device is asked
  /// @param clock          stamps the poses, outlives the device; none is CLOCK_MONOTONIC
  DirectDriver(DeviceSpecification specification, Clock* clock);

  /// Loads the library and finds the device. @return what went wrong, as a sentence; empty where nothing did
  virtual std::string connect() = 0;
  /// Limits, force on at zero, and the first pose. @return as above
  virtual std::string switch_on(DeviceState& state) = 0;
  /// Releases a device that pushes nothing.
  virtual void switch_off() noexcept = 0;
  /// The pose, where there is a new one, and the buttons. @return why the device is lost, else nullptr
  virtual const char* take_pose(DeviceState& state) noexcept = 0;
  /// What kept the device from pushing when the last pose was taken, or nullptr.
  virtual const char* hindrance() const noexcept { return nullptr; }
  /// @param wrench  within what the device can push
  virtual Answer push(const DeviceWrench& wrench) noexcept = 0;

  void specify(DeviceSpecification specification) { specification_ = std::move(specification); }
  /// Since the device was opened [s].
  double time() noexcept { return double(clock_.now() - opened_at_) * 1e-9; }

 private:
  DeviceStatus lose(const char* why) noexcept;
  void say(const char* sentence) noexcept;

  DeviceSpecification specification_;
  MonotonicClock monotonic_clock_;
  Clock& clock_;
  std::int64_t opened_at_ = 0;
  DeviceState state_;
  bool is_open_ = false;
  bool is_lost_ = false;
  SingleCaller library_calls_;  // by `read` and `write`, and by the watchdog
  std::atomic<bool> is_let_go_ = false;
  std::array<char, 200> complaint_ = {};  // copied, because the library may write its next error in the same place
};

}  // namespace feeler
