// Makes drivers by name and asks who answers.
#include "feeler/device/device_catalogue.hpp"

#include <sstream>

#include "feeler/device/force_dimension_device.hpp"
#include "feeler/device/open_haptics_device.hpp"
#include "feeler/device/virtuose_device.hpp"

namespace feeler {

const char* name_of(Maker maker) noexcept {
  switch (maker) {
    case Maker::open_haptics:
      return "openhaptics";
    case Maker::force_dimension:
      return "forcedimension";
    case Maker::virtuose:
      return "virtuose";
  }
  return "unknown";
}

std::optional<Maker> maker_named(std::string_view name) noexcept {
  for (const Maker maker : all_makers) {
    if (name == name_of(maker)) return maker;
  }
  return std::nullopt;
}

std::unique_ptr<Device> make_device(Maker maker, const std::string& library, double period) {
  switch (maker) {
    case Maker::open_haptics: {
      OpenHapticsSettings settings;
      if (!library.empty()) settings.libraries = {library};
      return std::make_unique<OpenHapticsDevice>(settings);
    }
    case Maker::force_dimension: {
      ForceDimensionSettings settings;
      if (!library.empty()) settings.libraries = {library};
      return std::make_unique<ForceDimensionDevice>(settings);
    }
    case Maker::virtuose: {
      VirtuoseSettings settings;
      if (!library.empty()) settings.libraries = {library};
      settings.period = period;
      return std::make_unique<VirtuoseDevice>(settings);
    }
  }
  return nullptr;
}

std::vector<DeviceListing> list_devices() {
  std::vector<DeviceListing> listings;
  for (const Maker maker : all_makers) {
    const auto device = make_device(maker);
    OpenResult opened = device->open();
    listings.push_back(
        {maker, opened ? device->specification() : DeviceSpecification{}, std::move(opened.problem)});
    device->close();
  }
  return listings;
}

std::string to_string(const DeviceListing& listing) {
  std::ostringstream out;
  out << name_of(listing.maker) << ": ";
  if (!listing.problem.empty()) {
    out << "none. " << listing.problem << "\n";
    return out.str();
  }
  const DeviceSpecification& device = listing.device;
  out << device.name << ", " << device.maximum_force << " N (" << device.continuous_force << " N for ever), ";
  if (device.pushes_torque()) {
    out << device.maximum_torque << " N m";
  } else {
    out << "force-only";
  }
  out << ", " << device.stiffness << " N/m\n";
  return out.str();
}

}  // namespace feeler
