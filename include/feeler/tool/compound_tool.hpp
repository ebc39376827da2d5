// A tool that is not convex, as the union of convex pieces.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "feeler/core/requirement.hpp"
#include "feeler/core/result.hpp"
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
  explicit CompoundTool(std::vector<Piece> pieces) : pieces_(std::move(pieces)) { refuse_for(reason_against(pieces_)); }
  static std::string reason_against(const std::vector<Piece>& pieces) {
    if (pieces.empty()) return "CompoundTool: no pieces; give at least one";
    if (pieces.size() > std::size_t(maximum_pieces)) {
      return "CompoundTool: " + std::to_string(pieces.size()) + " pieces, more than " + std::to_string(maximum_pieces) + "; join some of them";
    }
    return {};
  }

  /// A piece for each set of points: its convex hull. Refuses what `ConvexPolytope::hull_of` refuses.
  static CompoundTool hulls_of(std::span<const Points<Scalar>> sets)
    requires std::same_as<Piece, ConvexPolytope<Scalar>>
  {
    return try_hulls_of(sets).value();
  }
  /// The same, or the reason against it.
  static Result<CompoundTool> try_hulls_of(std::span<const Points<Scalar>> sets)
    requires std::same_as<Piece, ConvexPolytope<Scalar>>
  {
    std::vector<Piece> pieces;
    pieces.reserve(sets.size());
    for (const Points<Scalar>& points : sets) {
      Result<Piece> piece = Piece::try_hull_of(points);
      if (!piece) return Result<CompoundTool>::refused("CompoundTool: piece " + std::to_string(pieces.size()) + ": " + piece.reason());
      pieces.push_back(*std::move(piece));
    }
    return try_make<CompoundTool>(std::move(pieces));
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
