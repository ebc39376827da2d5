// A tool that is not convex, as the union of convex pieces.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "feeler/core/requirement.hpp"
#include "feeler/tool/convex_polytope.hpp"
#include "feeler/tool/rigid_tool.hpp"

namespace feeler {

/// Up to 64 convex pieces of one type, all in the tool frame [m]. They may touch and overlap; the tool is their union.
///
/// To a renderer, each piece near the object costs about as much as a tool of its own; those far from it, next to nothing.
template <ConvexTool PieceType>
class CompoundTool {
 public:
  using Piece = PieceType;
  using Scalar = typename Piece::Scalar;
  static constexpr int maximum_pieces = 64;

  /// Refuses no pieces, and more than 64.
  explicit CompoundTool(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
    if (pieces_.empty()) refuse("CompoundTool: no pieces; give at least one");
    if (pieces_.size() > std::size_t(maximum_pieces)) {
      refuse("CompoundTool: " + std::to_string(pieces_.size()) + " pieces, more than " + std::to_string(maximum_pieces) +
             "; join some of them");
    }
  }

  /// A piece for each set of points: its convex hull. Refuses what `ConvexPolytope::hull_of` refuses.
  static CompoundTool hulls_of(std::span<const Points<Scalar>> sets)
    requires std::same_as<Piece, ConvexPolytope<Scalar>>
  {
    std::vector<Piece> pieces;
    pieces.reserve(sets.size());
    for (const Points<Scalar>& points : sets) pieces.push_back(Piece::hull_of(points));
    return CompoundTool(std::move(pieces));
  }

  int piece_count() const noexcept { return int(pieces_.size()); }
  const Piece& piece(int i) const noexcept { return pieces_[std::size_t(i)]; }

  template <class Other>
  auto cast() const {  // named in the body, so that a piece may do without a cast
    std::vector<ToolCast<Piece, Other>> pieces;
    pieces.reserve(pieces_.size());
    for (const Piece& piece : pieces_) pieces.push_back(piece.template cast<Other>());
    return CompoundTool<ToolCast<Piece, Other>>(std::move(pieces));
  }

 private:
  std::vector<Piece> pieces_;
};

static_assert(RigidTool<CompoundTool<ConvexPolytope<double>>>);

}  // namespace feeler
