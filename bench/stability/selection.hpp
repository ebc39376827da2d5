// What of devices, grips and situations a study was asked for.
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "stability/grips.hpp"
#include "stability/situations.hpp"
#include "stability/studies.hpp"

namespace feeler::stability {

/// A situation, and where its tool meets the object.
struct Meeting {
  Situation situation;
  Pose<double> contact;  ///< as `contact_of` finds it
};

/// The devices asked for; where none was, those of these names, or all where there are no names.
std::vector<NamedDevice> devices_of(const StudyOptions& options, std::initializer_list<std::string_view> usual = {});

/// The grips asked for.
std::vector<NamedGrip> grips_of(const StudyOptions& options);
bool is_wanted(const StudyOptions& options, const NamedGrip& grip);

/// Those of the scene asked for, with their contacts.
std::vector<Meeting> meetings_of(const StudyOptions& options, const std::vector<Situation>& situations);

/// Whether the device can push where the hand presses.
bool concerns(const DeviceSpecification& device, const Situation& situation) noexcept;

}  // namespace feeler::stability
