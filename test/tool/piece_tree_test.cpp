#include "feeler/tool/piece_tree.hpp"

#include <boost/test/unit_test.hpp>

#include <random>
#include <set>
#include <vector>

#include "feeler/tool/compound_tool.hpp"
#include "feeler/tool/convex_polytope.hpp"
#include "feeler/tool/sphere_swept.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(piece_tree)

using feeler::CompoundTool;
using feeler::PieceTree;

namespace {

/// What every tree must be, looked at from the root down; returns where its subtree ends.
template <class Tool>
std::size_t check_below(const Tool& tool, const PieceTree<Tool>& tree, std::size_t i, std::multiset<int>& pieces, std::multiset<int>& groups) {
  const auto& node = tree.nodes()[i];
  const std::size_t end = i + std::size_t(node.subtree_size());
  (node.is_single() ? pieces : groups).insert(node.index);
  std::multiset<int> below;
  if (node.is_single()) {
    below.insert(node.index);
  } else {
    const std::size_t second = check_below(tool, tree, i + 1, below, groups);
    BOOST_TEST(check_below(tool, tree, second, below, groups) == end);
    pieces.insert(below.begin(), below.end());
  }
  BOOST_TEST(int(below.size()) == node.piece_count);
  for (const int piece : below) {
    const auto& shape = tool.piece(piece);
    for (int k = 0; k < shape.vertex_count(); ++k) {
      const Eigen::Vector3d beyond =
          ((shape.vertex(k) - node.centre).cwiseAbs().array() + feeler::swept_radius(shape)).matrix() - node.box.half_extents();
      BOOST_TEST(beyond.maxCoeff() <= 0);
    }
  }
  return end;
}

template <class Tool>
void check(const Tool& tool) {
  const PieceTree<Tool> tree(tool);
  BOOST_TEST_REQUIRE(int(tree.nodes().size()) == 2 * tool.piece_count() - 1);
  std::multiset<int> pieces, groups;
  BOOST_TEST(check_below(tool, tree, 0, pieces, groups) == tree.nodes().size());
  for (int i = 0; i < tool.piece_count(); ++i) BOOST_TEST(pieces.count(i) == 1U);
  for (int i = 0; i < tool.piece_count() - 1; ++i) BOOST_TEST(groups.count(i) == 1U);
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_piece_is_once_in_the_tree_and_inside_every_box_above_it) {
  std::mt19937 bits(1);
  for (const int count : {1, 2, 3, 9, 33, 64}) {
    BOOST_TEST_CONTEXT(count << " pieces") {
      std::vector<feeler::ConvexPolytope<double>> hulls;
      std::vector<feeler::Sphere<double>> spheres;
      for (int i = 0; i < count; ++i) {
        hulls.push_back(feeler_test::random_hull(bits, 12));
        spheres.push_back(feeler_test::random_sphere(bits));
      }
      check(CompoundTool(hulls));
      check(CompoundTool(spheres));
    }
  }
}

BOOST_AUTO_TEST_CASE(pieces_that_lie_on_each_other_are_a_tree_too) {
  check(CompoundTool(std::vector(7, feeler::Point<double>(Eigen::Vector3d::Zero()))));
  check(CompoundTool(std::vector(8, feeler::Point<double>(Eigen::Vector3d(1, 2, 3)))));
}

BOOST_AUTO_TEST_CASE(a_row_of_pieces_is_halved_along_it) {
  std::vector<feeler::Point<double>> row;
  for (int i = 0; i < 16; ++i) row.emplace_back(Eigen::Vector3d(0, 0.1 * (i * 5 % 16), 0));
  const CompoundTool tool(row);
  const PieceTree<CompoundTool<feeler::Point<double>>> tree(tool);
  for (const auto& node : tree.nodes()) BOOST_TEST(std::abs(node.box.half_extents().y() - 0.05 * (node.piece_count - 1)) < 1e-5);
}

BOOST_AUTO_TEST_SUITE_END()
