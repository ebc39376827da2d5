// The drivers and the limits are in the library.
#include <feeler/device/device_catalogue.hpp>
#include <feeler/device/wrench_limit.hpp>

int main() {
  const auto device = feeler::make_device(feeler::Maker::virtuose, "/nowhere/libvirtuose.so");
  return feeler::limited({{2020, 0, 0}, {0, 0, 0}}, 3, 0).force[0] == 3 && !device->open() ? 0 : 1;
}
