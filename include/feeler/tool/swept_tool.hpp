// What tells a round tool from its core: a radius.
#pragma once

#include <concepts>

#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// A tool of all points within `swept_radius()` [m] of a core. Its vertices, edges and faces are those of the core; whoever asks for them and
/// means the surface subtracts the radius from the separation.
template <class T>
concept SweptTool = ConvexTool<T> && ConvexTool<typename T::Core> && requires(const T& tool) {
  { tool.core() } noexcept -> std::same_as<const typename T::Core&>;
  { tool.swept_radius() } noexcept -> std::same_as<typename T::Scalar>;
};

/// How far the surface of a tool lies beyond its vertices, edges and faces [m]; the constant 0 for a tool that is not swept.
template <ConvexTool Tool>
constexpr typename Tool::Scalar swept_radius(const Tool& tool) noexcept {
  if constexpr (SweptTool<Tool>) {
    return tool.swept_radius();
  } else {
    return typename Tool::Scalar(0);
  }
}

}  // namespace feeler
