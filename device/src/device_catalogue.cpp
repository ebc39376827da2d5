// Makes drivers by name and asks who answers.
#include "feeler/device/device_catalogue.hpp"

#include <charconv>
#include <cstdint>
#include <sstream>

#include "feeler/core/requirement.hpp"
#include "feeler/device/force_dimension_device.hpp"
#include "feeler/device/haply_device.hpp"
#include "feeler/device/open_haptics_device.hpp"
#include "feeler/device/virtuose_device.hpp"
#include "loop_period.hpp"

namespace feeler {
namespace {

/// The whole of the text as a number that is not negative, or nothing.
std::optional<int> number_of(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end || number < 0) return std::nullopt;
  return number;
}

struct Place {
  std::string host;
  std::uint16_t port;
};

/// "host:port", or nothing.
std::optional<Place> place_of(std::string_view address) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string_view::npos || colon == 0) return std::nullopt;
  const auto port = number_of(address.substr(colon + 1));
  if (!port || *port == 0 || *port > 65535) return std::nullopt;
  return Place{std::string(address.substr(0, colon)), static_cast<std::uint16_t>(*port)};
}

}  // namespace

const char* name_of(Maker maker) noexcept {
  switch (maker) {
    case Maker::open_haptics: return "openhaptics";
    case Maker::force_dimension: return "forcedimension";
    case Maker::virtuose: return "virtuose";
    case Maker::haply: return "haply";
  }
  return "unknown";
}

std::optional<Maker> maker_named(std::string_view name) noexcept {
  for (const Maker maker : all_makers) {
    if (name == name_of(maker)) return maker;
  }
  return std::nullopt;
}

std::string reason_against(Maker maker, const DeviceChoice& choice) {
  const std::string name = name_of(maker);
  const bool is_force_dimension = maker == Maker::force_dimension;
  const bool is_haply = maker == Maker::haply;
  if (is_haply && !choice.library.empty()) return name + " has no library: leave it out, or give the address of the Inverse Service.";
  if (is_force_dimension && !choice.address.empty()) return name + " has no address: choose a device by its serial number or its index.";
  if (is_haply && !choice.address.empty() && !place_of(choice.address)) {
    return "\"" + choice.address + "\" is no address of an Inverse Service: give host and port, as in localhost:10001.";
  }
  if (!is_force_dimension && !is_haply && (!choice.serial_number.empty() || choice.index)) {
    return name + " knows no serial number and no index: choose a device by its address.";
  }
  if (is_force_dimension && !choice.serial_number.empty() && !number_of(choice.serial_number)) {
    return "\"" + choice.serial_number + "\" is no serial number of forcedimension: it is a number.";
  }
  if (!is_force_dimension && choice.initialises) return name + " has no device that initialises itself when asked to: leave that out.";
  return reason_against_period(choice.period);
}

std::unique_ptr<Device> make_device(Maker maker, const DeviceChoice& choice) {
  refuse_for(reason_against(maker, choice));
  switch (maker) {
    case Maker::open_haptics: {
      OpenHapticsSettings settings;
      if (!choice.library.empty()) settings.libraries = {choice.library};
      settings.device_name = choice.address;
      return std::make_unique<OpenHapticsDevice>(settings);
    }
    case Maker::force_dimension: {
      ForceDimensionSettings settings;
      if (!choice.library.empty()) settings.libraries = {choice.library};
      settings.serial_number = number_of(choice.serial_number);
      settings.index = choice.index;
      settings.initialises = choice.initialises;
      return std::make_unique<ForceDimensionDevice>(settings);
    }
    case Maker::virtuose: {
      VirtuoseSettings settings;
      if (!choice.library.empty()) settings.libraries = {choice.library};
      if (!choice.address.empty()) settings.address = choice.address;
      settings.period = choice.period;
      return std::make_unique<VirtuoseDevice>(settings);
    }
    case Maker::haply: {
      HaplySettings settings;
      if (const auto place = place_of(choice.address)) {
        settings.host = place->host;
        settings.port = place->port;
      }
      settings.serial_number = choice.serial_number;
      settings.index = choice.index;
      settings.period = choice.period;
      return std::make_unique<HaplyDevice>(settings);
    }
  }
  return nullptr;
}

std::unique_ptr<Device> make_device(Maker maker, const std::string& library, double period) {
  DeviceChoice choice;
  if (maker != Maker::haply) choice.library = library;
  choice.period = period;
  return make_device(maker, choice);
}

std::vector<DeviceListing> list_devices() {
  std::vector<DeviceListing> listings;
  for (const Maker maker : all_makers) {
    const auto device = make_device(maker);
    OpenResult opened = device->open();
    listings.push_back({maker, opened ? device->specification() : DeviceSpecification{}, std::move(opened.problem)});
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
