#include "feeler/proximity/traversal_order.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include "support/contact_scenes.hpp"

BOOST_AUTO_TEST_SUITE(traversal_order)

using feeler::BvhNode;
using Orders = std::tuple<feeler::NearestFirst, feeler::InBatches>;
using Passed = std::array<std::int32_t, BvhNode::width>;
using namespace feeler_test;

namespace {

/// A floor of 2·4ⁿ triangles.
feeler::TriangleMesh<double> divided_floor(int n) {
  Soup floor = floor_object();
  for (int i = 0; i < n; ++i) floor = floor.divided();
  return floor.mesh();
}

/// Nothing has passed, where there is a child.
Passed none_of(const BvhNode& node) {
  Passed passed;
  for (std::size_t i = 0; i < passed.size(); ++i) passed[i] = node.child[i] == 0 ? -1 : 0;
  return passed;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(every_node_and_leaf_that_has_not_passed_is_visited_once, Order, Orders) {
  std::mt19937 bits(1);
  for (const int n : {0, 1, 3, 6}) {
    const auto mesh = divided_floor(n);
    const auto& bvh = mesh.bvh();
    std::vector<int> nodes(bvh.nodes().size()), leaves(bvh.leaves().size());
    std::vector<bool> is_expected(leaves.size(), true);
    Order order(Eigen::Vector3f(1, 2, 3));
    while (!order.empty()) {
      const auto next = order.take();
      BOOST_TEST_REQUIRE(!next.empty());
      for (const std::int32_t entry : next) {
        BOOST_TEST_REQUIRE(BvhNode::is_leaf(entry) == BvhNode::is_leaf(next.front()));
        if (BvhNode::is_leaf(entry)) {
          ++leaves[std::size_t(~entry)];
          continue;
        }
        ++nodes[std::size_t(entry)];
        const BvhNode& node = bvh.nodes()[std::size_t(entry)];
        Passed passed = none_of(node);
        for (std::size_t i = 0; i < passed.size(); ++i) {  // some leaves pass
          if (node.child[i] == 0 || !BvhNode::is_leaf(node.child[i]) || below(bits, 3) > 0) continue;
          passed[i] = -1;
          is_expected[std::size_t(~node.child[i])] = false;
        }
        order.push_children(node, passed);
      }
      if (BvhNode::is_leaf(next.front())) BOOST_TEST(int(next.size()) <= Order::leaves_at_once);
    }
    BOOST_TEST((std::ranges::all_of(nodes, [](int visits) { return visits == 1; })));
    for (std::size_t i = 0; i < leaves.size(); ++i) BOOST_TEST_REQUIRE(leaves[i] == int(is_expected[i]));
  }
}

BOOST_AUTO_TEST_CASE(of_the_children_of_a_node_the_one_that_the_motion_comes_to_first_is_next) {
  const auto mesh = divided_floor(6);
  const Eigen::Vector3f motion(0.3F, -1, 0.2F);
  for (const BvhNode& node : mesh.bvh().nodes()) {
    feeler::NearestFirst order(motion);
    order.take();
    order.push_children(node, none_of(node));
    float last = -std::numeric_limits<float>::infinity();
    while (!order.empty()) {
      const auto at = std::find(std::begin(node.child), std::end(node.child), order.take().front()) - std::begin(node.child);
      float along = 0;
      for (int k = 0; k < 3; ++k) along += motion[k] * (node.lower[k][at] + node.upper[k][at]);
      BOOST_TEST_REQUIRE(along >= last);
      last = along;
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_tree_of_the_greatest_depth_has_room, Order, Orders) {
  // Every node is full, and named by how deep it is: far more than can be visited, so that only a part is.
  constexpr int depth = feeler::Bvh<double>::maximum_depth - 1;
  Order order(Eigen::Vector3f::Zero());
  long leaves = 0;
  for (int i = 0; i < 300000; ++i) {
    const auto next = order.take();
    for (const std::int32_t entry : next) {
      if (BvhNode::is_leaf(entry)) {
        ++leaves;
        continue;
      }
      BvhNode node{};
      std::fill_n(node.child, BvhNode::width, entry + 1 < depth ? entry + 1 : ~std::int32_t(0));
      order.push_children(node, {});
    }
  }
  BOOST_TEST(leaves > 100000);  // as deep as it goes
}

BOOST_AUTO_TEST_SUITE_END()
