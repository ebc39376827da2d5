// Reads the messages of pages as JSON, and trusts nothing in them.
#include "feeler/viewer/page_message.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace feeler::viewer {
namespace {

using nlohmann::json;

constexpr double farthest = 100.0;  // [m]
constexpr std::size_t longest_name = 64;

/// Ends the reading of a message with a sentence for the page.
struct Refused {
  std::string sentence;
};

double number_of(const json& value, const char* what, double low, double high) {
  if (!value.is_number()) throw Refused{std::string(what) + " is no number."};
  const double number = value.get<double>();
  if (!(number >= low && number <= high)) throw Refused{std::string(what) + " is out of range."};
  return number;
}

const json& member(const json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) throw Refused{std::string("The message has no ") + name + "."};
  return *found;
}

template <std::size_t count>
void read_numbers(const json& list, const char* what, double bound, double (&numbers)[count]) {
  if (!list.is_array() || list.size() != count) throw Refused{std::string(what) + " is no list of " + std::to_string(count) + " numbers."};
  for (std::size_t i = 0; i < count; ++i) numbers[i] = number_of(list[i], what, -bound, bound);
}

DevicePose pose_of(const json& message) {
  DevicePose pose;
  read_numbers(member(message, "position"), "The position of the hand", farthest, pose.position);
  read_numbers(member(message, "orientation"), "The orientation of the hand", 2.0, pose.orientation);
  double squared = 0;
  for (const double q : pose.orientation) squared += q * q;
  if (!(squared > 0.25)) throw Refused{"The orientation of the hand is no quaternion."};
  for (double& q : pose.orientation) q /= std::sqrt(squared);
  return pose;
}

std::int32_t stage_of(const json& message) { return std::int32_t(number_of(member(message, "stage"), "The stage", 0, 1e9)); }

std::string name_of(const json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end()) return {};
  if (!found->is_string()) throw Refused{std::string("The ") + key + " is no text."};
  std::string name = found->get<std::string>();
  if (name.size() > longest_name) throw Refused{std::string("The ") + key + " is too long a name."};
  return name;
}

std::optional<double> setting_of(const json& message, const char* key, double low, double high) {
  const auto found = message.find(key);
  if (found == message.end() || found->is_null()) return {};
  return number_of(*found, (std::string("The ") + key).c_str(), low, high);
}

SceneRequest scene_of(const json& message) {
  SceneRequest request;
  request.scene = name_of(message, "scene");
  if (request.scene.empty()) throw Refused{"The message names no scene."};
  request.clearance = setting_of(message, "clearance", 0.0, 0.01);
  request.stiffness = setting_of(message, "stiffness", 10.0, 5000.0);
  request.margin = setting_of(message, "margin", 1e-8, 1e-4);
  request.variant = name_of(message, "variant");
  request.tool = name_of(message, "tool");
  request.method = name_of(message, "method");
  request.scalar = name_of(message, "scalar");
  return request;
}

PageMessage message_of(const json& message) {
  if (!message.is_object()) throw Refused{"The message is no object."};
  const std::string type = name_of(message, "type");
  if (type == "hand") return HandRequest{HandMode::person, stage_of(message), pose_of(message)};
  if (type == "still") return HandRequest{HandMode::still, stage_of(message), {}};
  if (type == "motion") return HandRequest{HandMode::motion, stage_of(message), {}};
  if (type == "scene") return scene_of(message);
  if (type == "cancel") return CancelRequest{};
  throw Refused{"The message is of no known type: hand, still, motion, scene or cancel."};
}

}  // namespace

ParsedMessage parse_page_message(std::string_view text) noexcept {
  try {
    const json message = json::parse(text.begin(), text.end(), nullptr, false);
    if (message.is_discarded()) return {{}, "The message is no JSON."};
    return {message_of(message), {}};
  } catch (const Refused& refused) {
    return {{}, refused.sentence};
  } catch (...) {
    return {{}, "The message cannot be read."};
  }
}

}  // namespace feeler::viewer
