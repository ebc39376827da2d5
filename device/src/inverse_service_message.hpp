// What the Inverse Service of Haply says, and what it is told, without the JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace feeler {

/// An arm in a message. What a message does not tell is left out: after the first one the service tells states alone.
struct ServiceArm {
  std::string id;
  std::string type;  // "inverse3", "minverse", …; of the first message
  std::optional<bool> is_calibrated;
  std::optional<bool> has_power;
  std::optional<bool> is_ready;
  bool has_position = false;
  double position[3] = {0, 0, 0};  // x right, y forward, z up [m]; a NaN for what is no number
};

/// A grip in a message, wired or wireless.
struct ServiceGrip {
  std::string id;
  std::optional<bool> is_connected;
  std::optional<bool> is_awake;
  bool has_orientation = false;
  double orientation[4] = {1, 0, 0, 0};  // w, x, y, z in the frame of the arm; NaNs for what are no numbers
  std::uint32_t buttons = 0;
};

struct ServiceMessage {
  std::vector<ServiceArm> arms;
  std::vector<ServiceGrip> grips;
};

/// @return nothing for a text that is no JSON or does not list arms
std::optional<ServiceMessage> read_service_message(std::string_view text);

/// The text that makes the arm push, and the service answer with a state.
/// @param force  x right, y forward, z up [N]; finite
std::string force_message(const std::string& arm, const double (&force)[3]);

}  // namespace feeler
