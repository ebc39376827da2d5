// What the user asks of the demo.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "feeler/device/device_catalogue.hpp"

namespace feeler::demo {

/// The command line; every value is in range.
struct Options {
  std::optional<std::string> scene;             ///< unset: cavity, steps and a real mesh, one after the other
  std::optional<std::filesystem::path> object;  ///< of the scene `file`
  std::optional<std::filesystem::path> tool;    ///< of the scene `file`; its convex hull is taken
  double scale = 1.0;                           ///< metres a unit of both files
  std::optional<Vector3<double>> start;         ///< of the scene `file`: where the tool begins [m]
  double clearance = 1e-3;                      ///< of the cavity [m]
  bool is_clearance_given = false;              ///< by the user
  int triangles = 10082;                        ///< of the terrain, about
  bool are_triangles_given = false;             ///< by the user
  double rate = 1000.0;                         ///< of the servo loop [Hz]
  double seconds = 8.0;                         ///< a scene
  std::uint32_t seed = 1;                       ///< of everything random
  std::string device = "simulated";             ///< or auto, or the name of a maker
  std::string device_library;                   ///< file of the maker's library; empty for its usual names
  std::string device_address;                   ///< of the maker's device or service; empty for the usual one
  std::string serial_number;                    ///< of one of several devices of a maker; empty for the first
  std::optional<int> device_index;              ///< of one of several, from 0
  bool initialises = false;                     ///< a device that is not calibrated may move by itself
  double workspace_scale = 1.0;                 ///< metres of the scene a metre of the device
  bool record = false;                          ///< the session, into the report
  bool list_devices = false;                    ///< and nothing else
  std::vector<std::filesystem::path> replay;  ///< a recorded session and nothing else, or recordings to view
  bool views = false;                         ///< the live view, and no report
  std::optional<unsigned short> port;  ///< of the live view; unset for the usual one, or any that is free
  std::optional<std::string> listen;   ///< address of the live view, other than this machine's own
  bool plays = false;                  ///< the live view begins with the motion of its scene
  std::optional<double> view_seconds;  ///< of the live view; unset until it is interrupted
  std::optional<std::filesystem::path> out;  ///< unset: `out/`, a folder a scene in it
};

/// Which real device they ask for.
DeviceChoice choice_of(const Options& options);

/// What the command line comes to: options to run with, or an exit code where it only asked for help.
struct CommandLine {
  Options options;
  std::optional<int> exit_code;
};

/// @throws BadInput for an unknown option or a value out of range
CommandLine read_command_line(int argument_count, const char* const* arguments);

}  // namespace feeler::demo
