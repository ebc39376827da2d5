// Fills in what a `ForceSafety` wants to know of each tick.
#include "feeler/device/wrench_guard.hpp"

#include <limits>
#include <utility>

#include "feeler/core/requirement.hpp"

namespace feeler {
namespace {

double usable(double rate) {
  if (!(rate >= 25 && rate <= 10'000))
    refuse("wrench guard: the rate of the loop must be from 25 to 10000 Hz; a slower one needs a servo loop beside it");
  return rate;
}

}  // namespace

WrenchGuard::WrenchGuard(const DeviceSpecification& device, double rate) : WrenchGuard(device, rate, limits_of(device, 1 / usable(rate))) {}

WrenchGuard::WrenchGuard(const DeviceSpecification& device, double rate, const ForceLimits& limits) : safety_(limits, device) {
  tick_.period = 1 / usable(rate);
  if (!(limits.latest_tick > tick_.period))
    refuse("wrench guard: the latest tick of the force limits must be longer than the period of the loop, or every frame is late");
}

DeviceWrench WrenchGuard::allowed(const DeviceState& state, const DeviceWrench& wanted, double now, DeviceStatus status) noexcept {
  // The pose is at most as old as the last frame. A clock that stands, goes back or is none makes the frame a late one.
  tick_.age = !has_ticked_ ? 0 : now > tick_.now ? now - tick_.now : std::numeric_limits<double>::infinity();
  tick_.now = now;
  has_ticked_ = true;
  tick_.status = status;
  tick_.request = std::exchange(request_, ForceRequest::none);
  tick_.state = state;
  tick_.wanted = wanted;
  return safety_.step(tick_);
}

}  // namespace feeler
