// What an engine's loop asks for gets no more than the device may give; and the drivers are in the library.
#include <feeler/device/device_catalogue.hpp>
#include <feeler/device/wrench_guard.hpp>

int main() {
  feeler::WrenchGuard guard(feeler::touch(), 60);
  feeler::DeviceState state;
  double most = 0;
  for (int frame = 0; frame < 120; ++frame) {
    state.time = frame / 60.0;
    const feeler::DeviceWrench wanted{{frame == 0 ? 0.0 : 2020.0, 0, 0}, {0, 0, 0}};
    const feeler::DeviceWrench pushed = guard.allowed(state, wanted, state.time);
    if (pushed.force[0] > most) most = pushed.force[0];
  }
  const auto device = feeler::make_device(feeler::Maker::virtuose, "/nowhere/libvirtuose.so");
  return most > 3 && most <= 3.3 && !device->open() ? 0 : 1;
}
