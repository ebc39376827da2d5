// Reads and writes JSON of the Inverse Service, schema 3.1 to 3.5. No exceptions: every type is asked before a value is taken.
#include "inverse_service_message.hpp"

#include <array>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

namespace feeler {
namespace {

using nlohmann::json;

/// The member of that name, or nullptr.
const json* member(const json* object, const char* name) {
  if (object == nullptr || !object->is_object()) return nullptr;
  const auto found = object->find(name);
  return found == object->end() ? nullptr : &*found;
}

std::string text_of(const json* value) { return value != nullptr && value->is_string() ? value->get<std::string>() : std::string(); }

std::optional<bool> answer_of(const json* object, const char* name) {
  const json* const value = member(object, name);
  if (value == nullptr || !value->is_boolean()) return std::nullopt;
  return value->get<bool>();
}

double number_of(const json* object, const char* name) {
  const json* const value = member(object, name);
  return value != nullptr && value->is_number() ? value->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

ServiceArm arm_of(const json& entry) {
  ServiceArm arm;
  arm.id = text_of(member(&entry, "device_id"));
  arm.type = text_of(member(member(&entry, "config"), "type"));
  const json* const status = member(&entry, "status");
  arm.is_calibrated = answer_of(status, "calibrated");
  arm.has_power = answer_of(status, "power_supply");
  arm.is_ready = answer_of(status, "ready");
  if (const json* const place = member(member(&entry, "state"), "cursor_position")) {
    arm.has_position = true;
    constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
    for (std::size_t i = 0; i < axes.size(); ++i) arm.position[i] = number_of(place, axes[i]);
  }
  return arm;
}

ServiceGrip grip_of(const json& entry) {
  ServiceGrip grip;
  grip.id = text_of(member(&entry, "device_id"));
  const json* const status = member(&entry, "status");
  grip.is_connected = answer_of(status, "connected");
  grip.is_awake = answer_of(status, "awake");
  const json* const state = member(&entry, "state");
  if (const json* const turn = member(state, "orientation")) {
    grip.has_orientation = true;
    constexpr std::array<const char*, 4> parts = {"w", "x", "y", "z"};
    for (std::size_t i = 0; i < parts.size(); ++i) grip.orientation[i] = number_of(turn, parts[i]);
  }
  const json* const buttons = member(state, "buttons");
  constexpr std::array<std::pair<const char*, unsigned>, 7> names = {
      {{"a", 0}, {"b", 1}, {"c", 2}, {"button_0", 0}, {"button_1", 1}, {"button_2", 2}, {"button_3", 3}}};
  for (const auto& [name, bit] : names) {
    if (answer_of(buttons, name).value_or(false)) grip.buttons |= 1u << bit;
  }
  if (answer_of(state, "button").value_or(false)) grip.buttons |= 1u;  // of a wired grip
  return grip;
}

}  // namespace

std::optional<ServiceMessage> read_service_message(std::string_view text) {
  const json document = json::parse(text, nullptr, false);
  const json* const arms = member(&document, "inverse3");
  if (arms == nullptr || !arms->is_array()) return std::nullopt;
  ServiceMessage message;
  for (const json& entry : *arms) message.arms.push_back(arm_of(entry));
  for (const char* const kind : {"wireless_verse_grip", "verse_grip", "custom_verse_grip"}) {
    const json* const grips = member(&document, kind);
    if (grips == nullptr || !grips->is_array()) continue;
    for (const json& entry : *grips) message.grips.push_back(grip_of(entry));
  }
  return message;
}

std::string force_message(const std::string& arm, const double (&force)[3]) {
  const json values = {{"x", force[0]}, {"y", force[1]}, {"z", force[2]}};
  const json entry = {{"device_id", arm}, {"commands", {{"set_cursor_force", {{"values", values}}}}}};
  const json message = {{"inverse3", json::array({entry})}};
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace feeler
