// The interface of a haptic device: whoever has one implements this, and the demo and the servo loop run it.
#pragma once

#include <string>

#include "feeler/device/device_specification.hpp"
#include "feeler/device/device_state.hpp"

namespace feeler {

/// How a read or a write went. An enumeration, because the tick must not allocate a sentence.
enum class DeviceStatus {
  ok,
  not_open,    ///< call `open` first; nothing was read or written
  not_finite,  ///< the wrench given has a NaN or an infinity; a zero wrench is written in its place
  warning,     ///< done, but the device complains, of warm motors for example
  fault,       ///< the device stopped answering or refuses force; close it
};

/// One sentence for a log or a message box.
constexpr const char* to_string(DeviceStatus status) noexcept {
  switch (status) {
    case DeviceStatus::ok: return "ok";
    case DeviceStatus::not_open: return "not open: call open before read and write";
    case DeviceStatus::not_finite: return "not finite: the wrench has a NaN or an infinity; no force is pushed";
    case DeviceStatus::warning: return "warning: done, but the device complains";
    case DeviceStatus::fault: return "fault: the device stopped answering or refuses force; close it";
  }
  return "unknown status";
}

/// How opening went: true, or false with what is wrong and what to do about it.
struct OpenResult {
  std::string problem = {};  ///< one plain sentence; empty when the device is open

  explicit operator bool() const noexcept { return problem.empty(); }
};

/// An impedance-type haptic device: pose in, wrench out. One tick is one `read` and then one `write`, from one thread.
///
/// Implementations convert to metres, radians, newtons and newton metres, and to the right-handed frame x right, y up, z to the user.
class Device {
 public:
  virtual ~Device() = default;

  /// Finds the device and switches its force on at zero. May allocate, wait and take seconds. Opening an open device does nothing.
  virtual OpenResult open() = 0;

  /// The latest pose. On `not_open` and `fault` the state is left as it was. No allocation.
  virtual DeviceStatus read(DeviceState& state) noexcept = 0;

  /// Pushes the wrench, limited to what the device can push, until the next one. No allocation.
  virtual DeviceStatus write(const DeviceWrench& wrench) noexcept = 0;

  /// Takes the force away while `read` or `write` may be under way on another thread: the watchdog of the loop calls it, again and
  /// again, while a renderer hangs. Nothing is pushed from then on before a `write` for a pose that was read later. Must not wait for
  /// the other thread. A device with a watchdog of its own that is as fast needs none.
  virtual void let_go() noexcept {}

  /// Force to zero, device released. Closing a closed device does nothing.
  virtual void close() noexcept = 0;

  /// The figures of this device; valid before `open`, and refined by it where the device can be asked.
  virtual const DeviceSpecification& specification() const noexcept = 0;

  /// Whether time passes for it while nobody reads: true of hardware. For a simulated device that a read advances, no tick is late.
  virtual bool lives_by_the_clock() const noexcept { return true; }

  /// What the device said with its last `warning` or `fault`, as a sentence; empty if nothing. Valid until the next call.
  virtual const char* complaint() const noexcept { return ""; }

 protected:
  Device() = default;
  Device(const Device&) = default;
  Device& operator=(const Device&) = default;
};

}  // namespace feeler
