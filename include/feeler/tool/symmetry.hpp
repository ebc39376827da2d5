// Which turns of a tool leave it as it is.
#pragma once

#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// The turns that leave a tool as it is, known from its type.
enum class Symmetry {
  none,
  about_axis,   ///< any turn about the line through vertices 0 and 1, as of a line or a capsule; there are no other vertices
  about_point,  ///< any turn about vertex 0, as of a point or a sphere; there are no other vertices
};

namespace detail {
template <class Tool>
constexpr Symmetry symmetry_of_tool() noexcept {
  if constexpr (requires { Tool::symmetry; }) {
    return Tool::symmetry;
  } else {
    return Symmetry::none;
  }
}
}  // namespace detail

/// What a tool states as its static member `symmetry`; `none` where it states nothing.
template <class Tool>
inline constexpr Symmetry symmetry_of = detail::symmetry_of_tool<Tool>();

}  // namespace feeler
