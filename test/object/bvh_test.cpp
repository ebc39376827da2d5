#include <boost/test/unit_test.hpp>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include "feeler/object/triangle_mesh.hpp"
#include "support/allocation_count.hpp"

BOOST_AUTO_TEST_SUITE(bvh)

using feeler::BvhBuilder;
using feeler::BvhLeaf;
using feeler::BvhNode;
using feeler::Points;
using feeler::TriangleMesh;
using feeler::Triangles;
using Wide = feeler::Vector3<long double>;

namespace {
double unit(std::mt19937& bits) { return double(bits()) / 2147483648.0 - 1.0; }

/// A height field of n × n vertices over a square of side 1.
template <class Scalar>
TriangleMesh<Scalar> terrain(int n, Scalar scale = Scalar(1), Scalar offset = Scalar(0)) {
  Points<Scalar> vertices(n * n, 3);
  Triangles triangles(2 * (n - 1) * (n - 1), 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = double(i) / n, y = double(j) / n;
      vertices.row(i * n + j) << Scalar(x), Scalar(y), Scalar(0.1 * std::sin(9 * x) * std::cos(7 * y) + 0.01 * std::sin(60 * x + 50 * y));
      vertices.row(i * n + j) = (vertices.row(i * n + j) * scale).array() + offset;
    }
  int t = 0;
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) {
      const int a = i * n + j, b = a + n;
      triangles.row(t++) << a, b, b + 1;
      triangles.row(t++) << a, b + 1, a + 1;
    }
  return TriangleMesh<Scalar>(vertices, triangles);
}

struct Box {
  std::array<float, 3> lower, upper;

  bool contains(const Box& other) const {
    bool contains = true;
    for (std::size_t k = 0; k < 3; ++k) contains = contains && other.lower[k] >= lower[k] && other.upper[k] <= upper[k];
    return contains;
  }
  double half_area() const {
    const double x = double(upper[0]) - double(lower[0]), y = double(upper[1]) - double(lower[1]), z = double(upper[2]) - double(lower[2]);
    return x * y + y * z + z * x;
  }
};
Box box_of(const BvhNode& node, int i) {
  return {{node.lower[0][i], node.lower[1][i], node.lower[2][i]}, {node.upper[0][i], node.upper[1][i], node.upper[2][i]}};
}
Box box_around(const BvhNode& node) {
  Box box = box_of(node, 0);
  for (int i = 1; i < BvhNode::width; ++i) {
    for (int k = 0; k < 3; ++k) {
      box.lower[std::size_t(k)] = std::min(box.lower[std::size_t(k)], node.lower[k][i]);
      box.upper[std::size_t(k)] = std::max(box.upper[std::size_t(k)], node.upper[k][i]);
    }
  }
  return box;
}
int triangles_in(const BvhLeaf& leaf) {
  return int(std::count_if(std::begin(leaf.triangle), std::end(leaf.triangle), [](int t) { return t >= 0; }));
}

/// Checks the triangles of a leaf against its box and the exact corners.
template <class Scalar>
void check_leaf(const TriangleMesh<Scalar>& mesh, const BvhLeaf& leaf, const Box& box, std::vector<int>& seen) {
  const Wide origin = mesh.bvh().origin().template cast<long double>();
  bool is_inside = true, is_near = true;
  for (std::size_t i = 0; i < std::size_t(BvhLeaf::width); ++i) {
    const bool is_used = leaf.triangle[i] >= 0;
    const int triangle = is_used ? leaf.triangle[i] : leaf.triangle[std::size_t(triangles_in(leaf) - 1)];
    if (is_used) ++seen[std::size_t(triangle)];
    const auto corners = mesh.corners(triangle);
    for (int c = 0; c < 3; ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        const long double exact = static_cast<long double>(corners(axis, c)) - origin[axis];
        const auto k = std::size_t(axis);
        is_inside = is_inside && static_cast<long double>(box.lower[k]) <= exact && exact <= static_cast<long double>(box.upper[k]);
        const auto kept = static_cast<long double>(leaf.corner[c][axis][i]);
        is_near = is_near && std::abs(kept - exact) <= std::ldexp(std::abs(exact), -24) + std::numeric_limits<float>::denorm_min();
      }
    }
  }
  BOOST_TEST(is_inside);
  BOOST_TEST(is_near);
}

/// Walks from the root; checks the boxes against the exact corners, the leaves, the nesting and the depth.
template <class Scalar>
void check_hierarchy(const TriangleMesh<Scalar>& mesh) {
  const auto& bvh = mesh.bvh();
  std::vector<int> seen(std::size_t(mesh.triangle_count()), 0);
  std::vector<int> node_visits(bvh.nodes().size(), 0), leaf_visits(bvh.leaves().size(), 0);
  struct Entry {
    std::size_t node;
    int depth;
    Box box;
  };
  std::vector<Entry> stack{{0, 1, box_around(bvh.nodes()[0])}};
  bool is_nested = true, is_shallow = true;
  while (!stack.empty()) {
    const Entry entry = stack.back();
    stack.pop_back();
    ++node_visits[entry.node];
    is_shallow = is_shallow && entry.depth <= bvh.maximum_depth;
    const BvhNode& node = bvh.nodes()[entry.node];
    for (int i = 0; i < BvhNode::width; ++i) {
      const std::int32_t child = node.child[i];
      const Box box = box_of(node, i);
      if (child == 0) {
        is_nested = is_nested && box.lower[0] > box.upper[0];
        continue;
      }
      is_nested = is_nested && entry.box.contains(box);
      if (BvhNode::is_leaf(child)) {
        ++leaf_visits[std::size_t(~child)];
        check_leaf(mesh, bvh.leaves()[std::size_t(~child)], box, seen);
      } else {
        stack.push_back({std::size_t(child), entry.depth + 1, box});
      }
    }
  }
  BOOST_TEST(is_nested);
  BOOST_TEST(is_shallow);
  BOOST_TEST((std::count(seen.begin(), seen.end(), 1) == mesh.triangle_count()));
  BOOST_TEST((std::count(node_visits.begin(), node_visits.end(), 1) == std::ptrdiff_t(node_visits.size())));
  BOOST_TEST((std::count(leaf_visits.begin(), leaf_visits.end(), 1) == std::ptrdiff_t(leaf_visits.size())));
}

/// Expected number of boxes and triangles met by a random line that meets the root.
template <class Scalar>
double surface_area_cost(const TriangleMesh<Scalar>& mesh) {
  const auto& bvh = mesh.bvh();
  const double whole = box_around(bvh.nodes()[0]).half_area();
  double cost = whole;
  for (const BvhNode& node : bvh.nodes()) {
    for (int i = 0; i < BvhNode::width && node.child[i] != 0; ++i) {
      const std::int32_t child = node.child[i];
      cost += box_of(node, i).half_area() * (BvhNode::is_leaf(child) ? 1 + triangles_in(bvh.leaves()[std::size_t(~child)]) : 1);
    }
  }
  return cost / whole;
}

/// The same cost of a tree that halves the list along its longest side, by recursion.
template <class Scalar>
double median_cost(const TriangleMesh<Scalar>& mesh, std::vector<int>::iterator first, std::vector<int>::iterator last) {
  Eigen::AlignedBox3f box;
  const auto middle_of = [&mesh](int t, int axis) { return mesh.corners(t).row(axis).minCoeff() + mesh.corners(t).row(axis).maxCoeff(); };
  for (auto i = first; i != last; ++i)
    for (int k = 0; k < 3; ++k) box.extend((mesh.corners(*i).col(k) - mesh.bvh().origin()).template cast<float>());
  const double area = Box{{box.min()[0], box.min()[1], box.min()[2]}, {box.max()[0], box.max()[1], box.max()[2]}}.half_area();
  if (last - first <= BvhLeaf::width) return area * double(1 + (last - first));
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [&](int a, int b) { return middle_of(a, axis) < middle_of(b, axis); });
  return area + median_cost(mesh, first, middle) + median_cost(mesh, middle, last);
}

/// Bytes; 0 where it is not known.
std::size_t heap_in_use() {
#if FEELER_TEST_COUNTS_ALLOCATIONS
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

TriangleMesh<double> soup(const std::vector<Eigen::Matrix3d>& corners) {
  Points<double> vertices(3 * Eigen::Index(corners.size()), 3);
  Triangles triangles(Eigen::Index(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto row = Eigen::Index(3 * i);
    vertices.middleRows(row, 3) = corners[i].transpose();
    triangles.row(Eigen::Index(i)) << int(row), int(row) + 1, int(row) + 2;
  }
  return TriangleMesh<double>(vertices, triangles);
}
}  // namespace

BOOST_AUTO_TEST_CASE(boxes_contain_their_triangles_at_every_size_and_place) {
  for (const double offset : {0.0, 1.0, -1e6, 1e6})
    for (const double scale : {1e-6, 1e-3, 1.0, 1e3}) check_hierarchy(terrain<double>(20, scale, offset));
  check_hierarchy(terrain<float>(20));
  check_hierarchy(terrain<float>(20, 1e-6F, 1e3F));
  check_hierarchy(terrain<float>(20, 1e-6F));
  check_hierarchy(terrain<long double>(20, 1e-6L, 1e6L));
}

BOOST_AUTO_TEST_CASE(random_triangles_of_mixed_sizes_are_each_in_one_leaf) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    BOOST_TEST_MESSAGE("seed " << seed);
    std::mt19937 bits(seed);
    std::vector<Eigen::Matrix3d> triangles;
    for (int i = 0; i < 1500; ++i) {
      const double size = std::pow(10.0, 6 * unit(bits));
      const Eigen::Vector3d place(unit(bits), unit(bits), unit(bits));
      Eigen::Matrix3d t;
      for (int k = 0; k < 3; ++k) t.col(k) = place + size * Eigen::Vector3d(unit(bits), unit(bits), unit(bits));
      triangles.push_back(t);
    }
    check_hierarchy(soup(triangles));
  }
}

BOOST_AUTO_TEST_CASE(the_leaves_under_a_child_are_those_from_its_first_to_its_last) {
  std::mt19937 bits(6);
  std::vector<Eigen::Matrix3d> triangles;
  for (int i = 0; i < 1000; ++i) {
    Eigen::Matrix3d t;
    for (int k = 0; k < 3; ++k) t.col(k) = Eigen::Vector3d(unit(bits), unit(bits), unit(bits));
    triangles.push_back(t);
  }
  for (const auto& mesh : {soup(triangles), terrain<double>(20), soup({Eigen::Matrix3d::Identity()})}) {
    const auto& bvh = mesh.bvh();
    for (const BvhNode& node : bvh.nodes()) {
      for (const std::int32_t child : node.child) {
        if (child == 0) continue;
        std::vector<std::int32_t> found, waiting{child};
        while (!waiting.empty()) {
          const std::int32_t entry = waiting.back();
          waiting.pop_back();
          if (BvhNode::is_leaf(entry)) {
            found.push_back(~entry);
            continue;
          }
          for (const std::int32_t below : bvh.nodes()[std::size_t(entry)].child)
            if (below != 0) waiting.push_back(below);
        }
        std::sort(found.begin(), found.end());
        const auto under = bvh.leaves_under(child);
        BOOST_TEST_REQUIRE(under[1] - under[0] == std::int32_t(found.size()));
        for (std::size_t i = 0; i < found.size(); ++i) BOOST_TEST_REQUIRE(found[i] == under[0] + std::int32_t(i));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(one_triangle_is_one_leaf) {
  const auto mesh = soup({Eigen::Matrix3d::Identity()});
  BOOST_TEST(mesh.bvh().nodes().size() == 1U);
  BOOST_TEST(mesh.bvh().leaves().size() == 1U);
  check_hierarchy(mesh);
  check_hierarchy(soup({Eigen::Matrix3d::Zero()}));
}

BOOST_AUTO_TEST_CASE(coincident_triangles_are_halved_to_leaves) {
  const auto mesh = soup(std::vector<Eigen::Matrix3d>(1000, Eigen::Matrix3d::Identity()));
  check_hierarchy(mesh);
  BOOST_TEST(mesh.bvh().leaves().size() <= 512U);
  BOOST_TEST(mesh.bvh().nodes().size() <= 512U / 2);
}

BOOST_AUTO_TEST_CASE(depth_is_bounded_where_every_split_takes_off_a_sliver) {
  // Distances that shrink by half leave all but a few items in the first bin, level after level.
  std::vector<feeler::BvhItem> items;
  for (int i = 0; i < 240; ++i) {
    const float x = std::ldexp(1.0F, -i / 2);
    items.push_back({{x, x, x}, {x, x, x}, i});
  }
  const auto depth_with = [&items](int limit) {
    auto copy = items;
    const BvhBuilder builder(copy, limit);
    std::vector<int> depths(builder.nodes().size(), 1);
    for (std::size_t i = 0; i < depths.size(); ++i)  // children come after their parent
      if (const BvhBuilder::Node& node = builder.nodes()[i]; !node.is_leaf())
        depths[std::size_t(node.first)] = depths[std::size_t(node.first) + 1] = depths[i] + 1;
    return *std::max_element(depths.begin(), depths.end());
  };
  BOOST_TEST(depth_with(64) > 16);
  for (const int limit : {8, 10, 12, 16}) BOOST_TEST(depth_with(limit) <= limit);
}

BOOST_AUTO_TEST_CASE(surface_area_cost_is_no_worse_than_that_of_halving) {
  const auto mesh = terrain<double>(100);
  std::vector<int> all(std::size_t(mesh.triangle_count()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = int(i);
  const double median = median_cost(mesh, all.begin(), all.end()) / box_around(mesh.bvh().nodes()[0]).half_area();
  BOOST_TEST_MESSAGE("surface area cost " << surface_area_cost(mesh) << ", halving " << median);
  BOOST_TEST(surface_area_cost(mesh) <= median);
}

BOOST_AUTO_TEST_CASE(million_triangles_are_built_in_160_bytes_each) {
  const std::size_t before = heap_in_use();
  const auto start = std::chrono::steady_clock::now();
  const auto mesh = terrain<double>(708);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const double bytes = double(heap_in_use() - before) / mesh.triangle_count();
  BOOST_TEST_MESSAGE(mesh.triangle_count() << " triangles in " << time.count() << " s, " << bytes << " bytes each");
  BOOST_TEST(bytes <= 160);
  BOOST_TEST(mesh.triangle_count() == 2 * 707 * 707);
  BOOST_TEST(mesh.report().boundary_edges == 4 * 707);
}

BOOST_AUTO_TEST_SUITE_END()
