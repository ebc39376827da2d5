// A host without exceptions, as engines are built, and the compiled module: what it might refuse is asked for first.
#include <feeler/core/result.hpp>
#include <feeler/device/device_catalogue.hpp>
#include <feeler/device/servo_loop.hpp>
#include <feeler/device/workspace_map.hpp>
#include <feeler/device/wrench_guard.hpp>

int main() {
  using feeler::try_make;
  if (try_make<feeler::WrenchGuard>(feeler::touch(), 0).reason().empty()) return 1;
  if (try_make<feeler::WorkspaceMap>(feeler::WorkspaceSettings{.scale = -1}).reason().empty()) return 2;
  if (feeler::reason_against(feeler::Maker::virtuose, {.period = 0}).empty()) return 3;
  const auto device = feeler::make_device(feeler::Maker::virtuose);
  const feeler::ServoLoop::Render nothing;
  if (try_make<feeler::ServoLoop>(feeler::ServoSettings(), *device, nothing).reason().empty()) return 4;
  auto guard = try_make<feeler::WrenchGuard>(feeler::touch(), 60);
  if (!guard) return 5;
  const feeler::DeviceWrench pushed = guard->allowed({}, {{5, 0, 0}, {0, 0, 0}}, 0);
  return pushed.force[0] == 0 ? 0 : 6;  // a start in contact is never free
}
