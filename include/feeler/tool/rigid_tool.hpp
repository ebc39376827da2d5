// What can be held: one convex shape, or several that move together.
#pragma once

#include <concepts>
#include <type_traits>

#include "feeler/core/scalar.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// A union of convex pieces in one tool frame; `maximum_pieces` bounds what a renderer keeps for each of them.
template <class T>
concept CompoundShape = RealScalar<typename T::Scalar> && ConvexTool<typename T::Piece> && (T::maximum_pieces > 0) && requires(const T& tool, int i) {
  { tool.piece_count() } noexcept -> std::same_as<int>;
  { tool.piece(i) } noexcept -> std::same_as<const typename T::Piece&>;
};

/// What a renderer takes as a tool.
template <class T>
concept RigidTool = ConvexTool<T> || CompoundShape<T>;

namespace detail {
template <RigidTool Tool>
struct Pieces {
  using Piece = Tool;
  static constexpr int maximum = 1;
  static constexpr int count(const Tool&) noexcept { return 1; }
  static const Piece& get(const Tool& tool, int) noexcept { return tool; }
};
template <CompoundShape Tool>
struct Pieces<Tool> {
  using Piece = typename Tool::Piece;
  static constexpr int maximum = Tool::maximum_pieces;
  static int count(const Tool& tool) noexcept { return tool.piece_count(); }
  static const Piece& get(const Tool& tool, int i) noexcept { return tool.piece(i); }
};
}  // namespace detail

/// The convex shape that a tool is, or that its pieces are.
template <RigidTool Tool>
using PieceOf = typename detail::Pieces<Tool>::Piece;

/// Most pieces that a tool of this type can have; 1 for a convex one.
template <RigidTool Tool>
inline constexpr int maximum_pieces = detail::Pieces<Tool>::maximum;

template <RigidTool Tool>
constexpr int piece_count(const Tool& tool) noexcept {
  return detail::Pieces<Tool>::count(tool);
}
template <RigidTool Tool>
const PieceOf<Tool>& piece_of(const Tool& tool, int i) noexcept {
  return detail::Pieces<Tool>::get(tool, i);
}

}  // namespace feeler
