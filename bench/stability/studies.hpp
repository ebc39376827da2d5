// The questions that are put to the closed loop, each answered in a CSV file and a table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "feeler/device/device_specification.hpp"
#include "stability/rendering.hpp"

namespace feeler::stability {

/// What to run.
struct StudyOptions {
  std::vector<std::string> devices;  ///< short names; empty for all
  std::vector<double> rates;         ///< of the limits [Hz]
  std::string scene;                 ///< empty for all
  std::string grip;                  ///< empty for all
  bool has_friction = true;
  std::filesystem::path folder;
};

struct NamedDevice {
  std::string name;  ///< for a command line
  DeviceSpecification device;
};
/// Every preset that differs from the others in more than its name.
std::vector<NamedDevice> all_devices();

/// At the stiffness of each preset, on every hold with every grip: is it stable, and how much does it swing
/// and buzz?
/// @return loops that were not stable
int study_presets(const StudyOptions& options);
/// The largest stable stiffness of each device at each rate, and the Z-width.
void study_limits(const StudyOptions& options);
/// Feeler and its rivals side by side: the largest stable stiffness, and the buzz.
void study_rivals(const StudyOptions& options);
/// Buzz and force steps while the hand slides over edges.
void study_slides(const StudyOptions& options);
/// What a servo loop at 4 kHz over a renderer at 1 kHz gains by the derivative of the wrench.
void study_extrapolation(const StudyOptions& options);
/// What passivity control does to loops that are too stiff.
void study_passivity(const StudyOptions& options);
/// A face on a wall without friction and encoders, against linear theory: what the simulation itself is
/// worth.
/// @return limits that differ by more than 7 %
int study_theory(const StudyOptions& options);
/// Handle and force over time, below and above the limit.
void study_traces(const StudyOptions& options);

}  // namespace feeler::stability
