// A device whose driver is compiled into the module, so that a maker's library stays out of the headers.
#pragma once

#include <memory>
#include <utility>

#include "feeler/device/device.hpp"

namespace feeler {

/// Hands every call to the driver that it owns, and closes it in the end.
class DrivenDevice : public Device {
 public:
  ~DrivenDevice() override { driver_->close(); }

  OpenResult open() final { return driver_->open(); }
  DeviceStatus read(DeviceState& state) noexcept final { return driver_->read(state); }
  DeviceStatus write(const DeviceWrench& wrench) noexcept final { return driver_->write(wrench); }
  void let_go() noexcept final { driver_->let_go(); }
  void close() noexcept final { driver_->close(); }
  const DeviceSpecification& specification() const noexcept final { return driver_->specification(); }
  bool lives_by_the_clock() const noexcept final { return driver_->lives_by_the_clock(); }
  const char* complaint() const noexcept final { return driver_->complaint(); }

 protected:
  explicit DrivenDevice(std::unique_ptr<Device> driver) noexcept : driver_(std::move(driver)) {}

 private:
  std::unique_ptr<Device> driver_;
};

}  // namespace feeler
