// Which devices there are: the drivers by name, and the search for one that answers.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "feeler/device/device.hpp"

namespace feeler {

/// The makers whose devices Feeler drives.
enum class Maker { open_haptics, force_dimension, virtuose, haply };

constexpr std::array<Maker, 4> all_makers = {Maker::open_haptics, Maker::force_dimension, Maker::virtuose, Maker::haply};

/// Its name for a command line: "openhaptics", "forcedimension", "virtuose", "haply".
const char* name_of(Maker maker) noexcept;
/// The other way round; nothing for another name.
std::optional<Maker> maker_named(std::string_view name) noexcept;

/// Which device of a maker, and how to reach it. What is left empty is as usual: the first device, at its usual place.
struct DeviceChoice {
  std::string library = {};        ///< file of the maker's library; not of Haply, which has none
  std::string address =
      {};        ///< OpenHaptics: the name that its setup program gave it. Virtuose: "host#port". Haply: "host:port". Not of Force Dimension
  std::string serial_number = {};  ///< of one of several; goes before the index. Force Dimension: a number. Haply: the `device_id`
  std::optional<int> index = {};   ///< of one of several, from 0. Force Dimension, Haply
  bool initialises = false;        ///< lets a device that is not calibrated move by itself, so hands off. Force Dimension
  double period = 1e-3;            ///< of the servo loop, for makers that want to know it [s]
};

/// Why this maker's driver cannot take the choice, as a sentence; empty where it can.
std::string reason_against(Maker maker, const DeviceChoice& choice);

/// A driver that is not open yet. Refuses (`std::invalid_argument`) a choice that there is a `reason_against`.
std::unique_ptr<Device> make_device(Maker maker, const DeviceChoice& choice);
/// The same of the usual device.
/// @param library  file of the maker's library; empty for its usual names, and for a maker without one
/// @param period   of the servo loop, for makers that want to know it [s]
std::unique_ptr<Device> make_device(Maker maker, const std::string& library = {}, double period = 1e-3);

/// What a search found of one maker.
struct DeviceListing {
  Maker maker;
  DeviceSpecification device;  ///< of the device that answered
  std::string problem;         ///< why none did, in a sentence; empty if one did
};

/// Opens one device of each maker, with its force at zero, and closes it again. Takes seconds.
std::vector<DeviceListing> list_devices();

/// The listing as a paragraph a maker, for a terminal.
std::string to_string(const DeviceListing& listing);

}  // namespace feeler
