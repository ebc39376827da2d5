// What a page may say: a few small messages, checked before anything else sees them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "feeler/viewer/live_feed.hpp"

namespace feeler::viewer {

/// Another scene, or other settings of the same one; what is unset stays or takes the scene's default.
struct SceneRequest {
  std::string scene;                ///< an id of the gallery
  std::optional<double> clearance;  ///< [m]
  std::optional<double> stiffness;  ///< [N/m]
  std::optional<double> margin;     ///< [m]
  std::string variant;              ///< one of the scene's; empty for its first
  std::string tool;                 ///< an id of the tools; empty for the scene's own
  std::string method;               ///< an id of the contact methods; empty for the first
  std::string scalar;               ///< "double" or "float"; empty for double
};

/// What is being built is not wanted any more.
struct CancelRequest {};

using PageMessage = std::variant<HandRequest, SceneRequest, CancelRequest>;

/// The message, or a sentence that says what is wrong with it.
struct ParsedMessage {
  std::optional<PageMessage> message;
  std::string refusal;
};

/// Reads one text message. Never throws; numbers that are not finite, too large or of another type are
/// refused, quaternions normalised.
ParsedMessage parse_page_message(std::string_view text) noexcept;

}  // namespace feeler::viewer
