#include "feeler/proximity/coarse_planes.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "feeler/object/triangle_mesh.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(coarse_planes)

using feeler::BvhLeaf;
using feeler::BvhNode;
using namespace feeler_test;
using Vector = Eigen::Vector3d;
using Wide = Eigen::Matrix<long double, 3, 1>;

namespace {
constexpr int capacity = 16;

/// Planes and the sides of a box, in double and relative to a motion's origin, and the same for a hierarchy.
struct Planes {
  Planes(std::mt19937& bits, const Vector& relative_to, double size) : to_boxes(relative_to), extent(size) {
    count = below(bits, capacity + 1);
    for (int i = 0; i < count; ++i) {
      normals.push_back(random_direction(bits));
      limits.push_back(size * (0.5 * fraction(bits) - 0.6) - normals.back().dot(to_boxes));
    }
    const Vector centre = 0.4 * size * random_vector(bits);
    for (int k = 0; k < 3; ++k) {
      lower[k] = centre[k] - 0.4 * size - to_boxes[k];
      upper[k] = centre[k] + 0.4 * size - to_boxes[k];
    }
  }
  template <class Coarse>
  void set(Coarse& coarse) const {
    coarse.begin(to_boxes, extent);
    for (int k = 0; k < 3; ++k) coarse.set_sides(k, lower[k], upper[k]);
    for (int i = 0; i < count; ++i) coarse.set_plane(i, normals[std::size_t(i)], limits[std::size_t(i)]);
  }
  /// The most room that a plane leaves above points, relative to the hierarchy's origin.
  long double room_above(const std::vector<Wide>& points) const {
    long double most = -std::numeric_limits<long double>::infinity();
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Wide normal = normals[i].cast<long double>();
      long double height = -std::numeric_limits<long double>::infinity();
      for (const Wide& point : points) height = std::max(height, normal.dot(point - to_boxes.cast<long double>()));
      most = std::max(most, static_cast<long double>(limits[i]) - height);
    }
    return most;
  }
  /// How far a box is beyond the nearest side; negative where it is beyond none.
  long double beyond(const std::array<float, 3>& box_lower, const std::array<float, 3>& box_upper) const {
    long double most = -std::numeric_limits<long double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const auto shift = static_cast<long double>(to_boxes[k]);
      most = std::max({most, static_cast<long double>(lower[k]) + shift - static_cast<long double>(box_upper[std::size_t(k)]),
                       static_cast<long double>(box_lower[std::size_t(k)]) - static_cast<long double>(upper[k]) - shift});
    }
    return most;
  }

  Vector to_boxes, lower, upper;
  double extent;
  int count = 0;
  std::vector<Vector> normals;
  std::vector<double> limits;
};

/// A node with boxes of mixed sizes, some of them missing.
BvhNode random_node(std::mt19937& bits, double size) {
  BvhNode node;
  for (int i = 0; i < BvhNode::width; ++i) {
    const bool is_there = i == 0 || below(bits, 4) > 0;
    node.child[i] = is_there ? i + 1 : 0;
    const Vector centre = 0.5 * size * random_vector(bits), half = magnitude(bits, -4, -1) * size * random_vector(bits).cwiseAbs();
    for (int k = 0; k < 3; ++k) {
      node.lower[k][i] = is_there ? float(centre[k] - half[k]) : std::numeric_limits<float>::infinity();
      node.upper[k][i] = is_there ? float(centre[k] + half[k]) : -std::numeric_limits<float>::infinity();
    }
  }
  return node;
}

std::vector<Wide> corners_of(const BvhNode& node, std::size_t i) {
  std::vector<Wide> corners;
  for (unsigned c = 0; c < 8; ++c) {
    Wide& corner = corners.emplace_back();
    for (int k = 0; k < 3; ++k) corner[k] = static_cast<long double>((c >> unsigned(k) & 1U) != 0 ? node.upper[k][i] : node.lower[k][i]);
  }
  return corners;
}
std::vector<Wide> corners_of(const feeler::TriangleMesh<double>& mesh, int triangle) {
  std::vector<Wide> corners;
  for (int c = 0; c < 3; ++c) corners.push_back(mesh.corners(triangle).col(c).cast<long double>() - mesh.bvh().origin().cast<long double>());
  return corners;
}
/// Four triangles, which a mesh has in one leaf.
feeler::TriangleMesh<double> random_leaf(std::mt19937& bits, double size) {
  feeler::Points<double> vertices(12, 3);
  feeler::Triangles list(4, 3);
  for (int v = 0; v < 12; ++v) {
    if (v % 3 == 0) vertices.row(v) = 0.5 * size * random_vector(bits).transpose();
    else vertices.row(v) = vertices.row(v - v % 3) + 0.1 * size * random_vector(bits).transpose();
    list(v / 3, v % 3) = v;
  }
  return {vertices, list};
}

struct Counts {
  int passed = 0, kept = 0;
};

/// What passed must be clear, and what is clear by more than rounding must have passed.
void judge(bool passed, long double room, double rounding, Counts& counts) {
  if (passed) BOOST_TEST(room >= 0);
  else BOOST_TEST(room <= static_cast<long double>(rounding));
  ++(passed ? counts.passed : counts.kept);
}
}  // namespace

BOOST_AUTO_TEST_CASE(what_passes_is_clear_and_what_is_clear_passes) {
  Counts boxes, triangles;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    BOOST_TEST_MESSAGE("seed " << seed);
    std::mt19937 bits(seed);
    const double size = magnitude(bits, -6, 3);
    const Planes planes(bits, 0.3 * size * random_vector(bits), size);
    const double rounding = 64 * double(std::numeric_limits<float>::epsilon()) * size;
    feeler::CoarsePlanes<double, capacity> coarse;
    planes.set(coarse);

    const BvhNode node = random_node(bits, size);
    const auto passed = coarse.passed(std::array{&node}, planes.count)[0];
    for (std::size_t i = 0; i < passed.size(); ++i) {
      const std::array<float, 3> lower{node.lower[0][i], node.lower[1][i], node.lower[2][i]},
          upper{node.upper[0][i], node.upper[1][i], node.upper[2][i]};
      if (node.child[i] == 0) {
        BOOST_TEST(passed[i] != 0);
        continue;
      }
      judge(passed[i] != 0, std::max(planes.beyond(lower, upper), planes.room_above(corners_of(node, i))), rounding, boxes);
    }

    const auto mesh = random_leaf(bits, size);
    const BvhLeaf& leaf = mesh.bvh().leaves()[0];
    const auto parted = coarse.passed(std::array{&leaf}, planes.count)[0];
    for (std::size_t i = 0; i < parted.size(); ++i) {
      if (leaf.triangle[i] < 0) continue;
      judge(parted[i] != 0, planes.room_above(corners_of(mesh, leaf.triangle[i])), rounding, triangles);
    }
  }
  BOOST_TEST(boxes.passed > 200);
  BOOST_TEST(boxes.kept > 100);
  BOOST_TEST(triangles.passed > 200);
  BOOST_TEST(triangles.kept > 100);
}

BOOST_AUTO_TEST_CASE(what_reaches_above_a_plane_by_less_than_rounding_does_not_pass) {
  for (unsigned seed = 1; seed <= 400; ++seed) {
    BOOST_TEST_MESSAGE("seed " << seed);
    std::mt19937 bits(seed);
    const double size = magnitude(bits, -6, 3);
    const Vector to_boxes = 0.3 * size * random_vector(bits);
    const auto check = [&](const auto& boxes, std::size_t i, const std::vector<Wide>& corners) {
      const Vector normal = random_direction(bits);
      long double height = -std::numeric_limits<long double>::infinity();
      for (const Wide& corner : corners) height = std::max(height, normal.cast<long double>().dot(corner - to_boxes.cast<long double>()));
      feeler::CoarsePlanes<double, capacity> coarse;
      coarse.begin(to_boxes, size);
      for (int k = 0; k < 3; ++k) coarse.set_sides(k, -10 * size, 10 * size);
      coarse.set_plane(0, normal, double(height) - 1e-12 * size);
      BOOST_TEST(coarse.passed(std::array{&boxes}, 1)[0][i] == 0);
    };
    const BvhNode node = random_node(bits, size);
    const auto mesh = random_leaf(bits, size);
    const BvhLeaf& leaf = mesh.bvh().leaves()[0];
    for (std::size_t i = 0; i < std::size_t(BvhNode::width); ++i) {
      if (node.child[i] != 0) check(node, i, corners_of(node, i));
      if (leaf.triangle[i] >= 0) check(leaf, i, corners_of(mesh, leaf.triangle[i]));
    }
  }
}

BOOST_AUTO_TEST_CASE(any_number_of_lanes_and_of_nodes_at_once_gives_the_same_answers_and_hits) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    BOOST_TEST_MESSAGE("seed " << seed);
    std::mt19937 bits(seed);
    const Planes planes(bits, Vector(0.1, 0.2, -0.1), 1.0);
    feeler::CoarsePlanes<double, capacity, 4> four;
    feeler::CoarsePlanes<double, capacity, 2> two;
    feeler::CoarsePlanes<double, capacity, 1> one, no_planes;
    planes.set(four), planes.set(two), planes.set(one), planes.set(no_planes);
    std::vector<int> hits(std::size_t(planes.count), 0);
    const auto check = [&](const auto& boxes) {  // pointers to four
      const auto at_once = four.passed(boxes, planes.count);
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const std::array single{boxes[i]};
        const auto expected = one.passed(single, planes.count)[0];
        BOOST_TEST((at_once[i] == expected));
        BOOST_TEST((two.passed(single, planes.count)[0] == expected));
        auto before = no_planes.passed(single, 0)[0];
        for (int plane = 0; plane < planes.count; ++plane) {
          const auto after = no_planes.passed(single, plane + 1)[0];
          for (std::size_t lane = 0; lane < before.size(); ++lane) hits[std::size_t(plane)] += after[lane] != 0 && before[lane] == 0 ? 1 : 0;
          before = after;
        }
      }
    };
    for (int k = 0; k < 3; ++k) {
      std::array<BvhNode, 4> nodes;
      for (BvhNode& node : nodes) node = random_node(bits, 1.0);
      check(std::array<const BvhNode*, 4>{&nodes[0], &nodes[1], &nodes[2], &nodes[3]});
      const auto mesh = random_leaf(bits, 1.0);
      const BvhLeaf& leaf = mesh.bvh().leaves()[0];
      check(std::array<const BvhLeaf*, 4>{&leaf, &leaf, &leaf, &leaf});
    }
    int taken = 0;
    const auto are_hits = [&](int plane, int count) {
      BOOST_TEST(count == hits[std::size_t(plane)]);
      ++taken;
    };
    four.take_hits(planes.count, are_hits);
    two.take_hits(planes.count, are_hits);
    one.take_hits(planes.count, are_hits);
    BOOST_TEST(taken == 3 * planes.count);
    four.take_hits(planes.count, [](int, int count) { BOOST_TEST(count == 0); });
  }
}

BOOST_AUTO_TEST_SUITE_END()
