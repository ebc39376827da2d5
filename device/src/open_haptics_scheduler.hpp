// The servo loop of libHD, which all its devices in a process share.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "open_haptics_library.hpp"

namespace feeler::open_haptics {

/// A device in the servo loop. All but the handle is called on the thread of the loop.
class Framed {
 public:
  virtual Handle handle() const noexcept = 0;
  /// One frame.
  /// @param must_be_silent  whether nothing may be pushed, because the loop is about to pause
  virtual void frame(bool must_be_silent) noexcept = 0;
  /// Takes an error of its own that came up in the frame of another device.
  virtual void take_error(unsigned int code) noexcept = 0;

 protected:
  ~Framed() = default;
};

/// The servo loop: one for all devices.
///
/// It starts with the first device and stops with the last. libHD initialises and disables no device while it
/// runs. So it pauses while a further device is opened, with all others silent; and a device that is closed
/// while others go on stays initialised, and silent, until the last one is closed.
class Scheduler {
 public:
  /// That of the process.
  static Scheduler& shared();

  std::mutex opening;  ///< held by who opens or closes a device, and by no frame

  /// Pauses the loop and initialises a device. @return its handle, or what libHD gives in its place
  Handle initialise(const Library& library, const std::string& name);
  /// Lets the loop run, with this device in it. @return false where eight are in it already; it stands still until this device leaves
  bool join(const Library& library, Framed& device);
  /// Takes a device out, which wants to push nothing any more, and lets the loop run on for the others.
  /// @param name  by which it was initialised
  void leave(const Library& library, Framed& device, const std::string& name);

  /// The device in the loop that has this handle, or nullptr.
  Framed* device_of(Handle handle) const noexcept;

 private:
  static unsigned int turn_of(void* scheduler) noexcept;
  bool has_devices() const noexcept;
  bool has_turned() const;
  void run(const Library& library);
  void unschedule(const Library& library);
  void stop(const Library& library);

  std::array<std::atomic<Framed*>, 8> devices_ = {};
  std::atomic<std::int64_t> turns_ = 0;
  std::atomic<bool> is_pausing_ = false;

  // Of who holds `opening`.
  std::map<std::string, Handle> kept_;  // closed while others went on
  unsigned long callback_ = 0;
  bool is_scheduled_ = false;
  bool is_running_ = false;
};

}  // namespace feeler::open_haptics
