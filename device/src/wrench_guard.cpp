// Fills in what a `ForceSafety` wants to know of each tick.
#include "feeler/device/wrench_guard.hpp"

#include <limits>
#include <utility>

#include "feeler/core/requirement.hpp"

namespace feeler {
namespace {

/// Of any rate, also one that is refused.
ForceLimits limits_at(const DeviceSpecification& device, double rate) { return limits_of(device, rate > 0 ? 1 / rate : 0); }

}  // namespace

WrenchGuard::WrenchGuard(const DeviceSpecification& device, double rate) : WrenchGuard(device, rate, limits_at(device, rate)) {}

WrenchGuard::WrenchGuard(const DeviceSpecification& device, double rate, const ForceLimits& limits) : safety_(limits, device) {
  refuse_for(reason_against(device, rate, limits));
  tick_.period = 1 / rate;
}

std::string WrenchGuard::reason_against(const DeviceSpecification& device, double rate) {
  return reason_against(device, rate, limits_at(device, rate));
}

std::string WrenchGuard::reason_against(const DeviceSpecification& device, double rate, const ForceLimits& limits) {
  std::string reason = feeler::reason_against(limits, device);
  if (!reason.empty()) return reason;
  if (!(rate >= 25 && rate <= 10'000))
    return "wrench guard: the rate of the loop must be from 25 to 10000 Hz; a slower one needs a servo loop beside it";
  if (!(limits.latest_tick > 1 / rate))
    return "wrench guard: the latest tick of the force limits must be longer than the period of the loop, or every frame is late";
  return {};
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
