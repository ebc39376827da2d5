// A small hierarchy over the pieces of a tool: boxes around groups of neighbours.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "feeler/tool/box.hpp"
#include "feeler/tool/rigid_tool.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// A group of pieces, or a single one, and a box along the axes of the tool frame that holds them.
template <class Scalar>
struct PieceGroup {
  int piece_count = 0;
  int index = 0;           ///< of a single piece: its number in the tool; of a group: its own, counted in the order of the tree
  Vector3<Scalar> centre;  ///< of the box, in the tool frame [m]
  Box<Scalar> box;

  bool is_single() const noexcept { return piece_count == 1; }
  /// Nodes of the tree from this one to the first that is not below it.
  int subtree_size() const noexcept { return 2 * piece_count - 1; }
};

/// The pieces of a tool in a binary tree: each group is halved along the longest side of the box about its pieces' centres.
///
/// In preorder: the halves of a group follow it at once, so whoever is done with a group goes on `subtree_size()` nodes later.
template <RigidTool Tool>
class PieceTree {
 public:
  using Scalar = typename Tool::Scalar;
  using Group = PieceGroup<Scalar>;
  static constexpr int maximum_groups = maximum_pieces<Tool> - 1;  ///< of more than one piece

  explicit PieceTree(const Tool& tool) {
    std::vector<Bounds> pieces;
    for (int i = 0; i < feeler::piece_count(tool); ++i) pieces.push_back(bounds_of(piece_of(tool, i), i));
    nodes_.reserve(2 * pieces.size() - 1);
    add(pieces);
  }

  /// The root first.
  std::span<const Group> nodes() const noexcept { return nodes_; }

 private:
  struct Bounds {
    Vector3<Scalar> lower;
    Vector3<Scalar> upper;
    int piece = 0;

    Vector3<Scalar> centre() const { return (lower + upper) / 2; }
  };

  static Bounds bounds_of(const PieceOf<Tool>& piece, int number) {
    Bounds bounds{piece.vertex(0), piece.vertex(0), number};
    for (int i = 1; i < piece.vertex_count(); ++i) {
      bounds.lower = bounds.lower.cwiseMin(piece.vertex(i));
      bounds.upper = bounds.upper.cwiseMax(piece.vertex(i));
    }
    bounds.lower.array() -= swept_radius(piece);
    bounds.upper.array() += swept_radius(piece);
    return bounds;
  }

  /// Adds a group and all below it.
  void add(std::span<Bounds> pieces) {
    Bounds all = pieces[0], centres{all.centre(), all.centre()};
    for (const Bounds& piece : pieces) {
      all.lower = all.lower.cwiseMin(piece.lower);
      all.upper = all.upper.cwiseMax(piece.upper);
      centres.lower = centres.lower.cwiseMin(piece.centre());
      centres.upper = centres.upper.cwiseMax(piece.centre());
    }
    // Wider than rounding needs, and never flat.
    const Scalar size = (std::max)(all.lower.cwiseAbs().maxCoeff(), all.upper.cwiseAbs().maxCoeff());
    const Scalar width = (std::max)(size * Scalar(1e-6), (std::numeric_limits<Scalar>::min)());
    const Vector3<Scalar> half = ((all.upper - all.lower) / 2).array() + width;
    const bool is_single = pieces.size() == 1;
    nodes_.push_back({int(pieces.size()), is_single ? all.piece : group_count_++, all.centre(), Box<Scalar>(half)});
    if (is_single) return;
    int axis = 0;
    (centres.upper - centres.lower).maxCoeff(&axis);
    const std::size_t middle = pieces.size() / 2;
    std::nth_element(pieces.begin(), pieces.begin() + std::ptrdiff_t(middle), pieces.end(),
                     [axis](const Bounds& a, const Bounds& b) { return a.centre()[axis] < b.centre()[axis]; });
    add(pieces.first(middle));
    add(pieces.subspan(middle));
  }

  int group_count_ = 0;
  std::vector<Group> nodes_;
};

}  // namespace feeler
