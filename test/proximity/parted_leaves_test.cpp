#include "feeler/proximity/parted_leaves.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "support/random_motions.hpp"

BOOST_AUTO_TEST_SUITE(parted_leaves)

using feeler::BvhLeaf;
using feeler::PartedLeaves;
using namespace feeler_test;
using Box = feeler::Box<double>;
using Wide = Eigen::Matrix<long double, 3, 1>;
using WideMatrix = Eigen::Matrix<long double, 3, 3>;

namespace {

/// Leaves of triangles about a tool, and how far it is from each along a normal at any time of a motion.
struct Ring {
  Ring(std::mt19937& bits, int count, const Vector& centre, double reach) : corners(std::size_t(count)), there(std::size_t(count)) {
    for (std::size_t l = 0; l < corners.size(); ++l) {
      there[l] = 1U + unsigned(below(bits, 15));
      for (Eigen::Matrix3d& triangle : corners[l]) {
        const Vector middle = centre + reach * (1 + 0.2 * fraction(bits)) * random_direction(bits);
        for (int c = 0; c < 3; ++c) triangle.col(c) = middle + 0.05 * reach * random_vector(bits);
      }
    }
  }
  std::vector<std::array<Eigen::Matrix3d, BvhLeaf::width>> corners;
  std::vector<unsigned> there;  // a bit for each triangle of a leaf
};

long double highest(const Eigen::Matrix3d& triangle, const Wide& normal) { return (normal.transpose() * triangle.cast<long double>()).maxCoeff(); }

/// Least height of a box along a normal, by its corners.
long double lowest(const Box& box, const RandomMotion<Box>& random, long double time, const Wide& normal) {
  const auto pose = random.wide().pose_at(time);
  const Eigen::Quaternion<long double> turn = pose.rotation.template cast<long double>();
  long double least = std::numeric_limits<long double>::infinity();
  for (unsigned i = 0; i < 8; ++i) {
    Wide corner;
    for (int k = 0; k < 3; ++k) corner[k] = static_cast<long double>((i >> unsigned(k) & 1U) != 0 ? box.half_extents()[k] : -box.half_extents()[k]);
    least = std::min(least, normal.dot(turn * corner + pose.translation.template cast<long double>()));
  }
  return least;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_parted_stays_above_a_plane_on_the_whole_way) {
  int parted = 0, asked = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    BOOST_TEST_MESSAGE("seed " << seed);
    std::mt19937 bits(seed);
    const double size = magnitude(bits, -4, 2), kept = 0.01 * size * fraction(bits);
    const Box box(size * (Vector::Constant(0.5) + 0.4 * random_vector(bits)));
    RandomMotion<Box> random(bits, box);
    random.reference.setZero();
    random.radius = feeler::radius_about(box, random.reference);
    random.pose.translation = (seed % 3 == 0 ? 1e3 : 0.1) * size * random_vector(bits);
    const int count = 1 + below(bits, 40);
    const Ring ring(bits, count, random.pose.translation, 1.1 * random.radius);
    std::vector<std::array<Wide, BvhLeaf::width>> normals(ring.corners.size());
    std::vector<unsigned> known(ring.corners.size(), 0);
    PartedLeaves<double> leaves(count, 0);
    for (int motion = 0; motion < 12; ++motion) {
      random.motion.linear = magnitude(bits, -4, -0.7) * size * random_direction(bits);
      random.motion.angular = magnitude(bits, -4, -0.5) * random_direction(bits);
      const auto moving = random.moving();
      leaves.begin(moving, kept);
      for (int l = 0; l < count; ++l) {
        const auto leaf = std::size_t(l);
        for (std::size_t i = 0; i < BvhLeaf::width; ++i) {
          if ((ring.there[leaf] >> i & 1U) == 0) continue;
          if ((known[leaf] >> i & 1U) != 0) {
            ++asked;
            if (leaves.is_parted(l, i)) {
              ++parted;
              for (int k = 0; k <= 8; ++k)
                BOOST_TEST(lowest(box, random, k / 8.0L, normals[leaf][i]) - highest(ring.corners[leaf][i], normals[leaf][i]) >= kept);
            }
          } else {
            BOOST_TEST(!leaves.is_parted(l, i));
          }
          if (below(bits, motion == 0 ? 2 : 60) > 0) continue;
          // Any plane above it will do: here the one along the line of the middles.
          const Vector normal = (random.pose.translation - ring.corners[leaf][i].rowwise().mean()).normalized();
          normals[leaf][i] = normal.cast<long double>();
          known[leaf] |= 1U << i;
          const auto room = double(lowest(box, random, 0, normals[leaf][i]) - highest(ring.corners[leaf][i], normals[leaf][i]));
          leaves.note(l, ring.there[leaf], i, normal, room);
        }
      }
      random.pose = moving.pose_at(1);
    }
  }
  BOOST_TEST_MESSAGE(parted << " of " << asked << " parted");
  BOOST_TEST(parted > asked / 4);
  BOOST_TEST(parted < asked);
}

namespace {
/// A motion that turns and goes nowhere, of a cube at a place.
RandomMotion<Box> resting_at(const Vector& place) {
  std::mt19937 bits(1);
  RandomMotion<Box> rest(bits, Box(Vector::Constant(0.01)));
  rest.reference.setZero();
  rest.radius = feeler::radius_about(rest.tool, rest.reference);
  rest.pose = {};
  rest.pose.translation = place;
  rest.motion = {};
  return rest;
}
constexpr unsigned two = 3;  // triangles in a leaf
const Vector up(0, 0, 1);
}  // namespace

BOOST_AUTO_TEST_CASE(a_row_of_leaves_is_parted_where_each_of_its_triangles_is) {
  auto rest = resting_at(Vector::Zero());
  PartedLeaves<double> leaves(8, 0);
  leaves.begin(rest.moving(), 1e-6);
  for (const std::int32_t leaf : {5, 3, 4}) {  // in any order
    leaves.note(leaf, two, 1, up, 1e-3);
    if (leaf != 4) leaves.note(leaf, two, 0, up, 1e-3);
  }
  BOOST_TEST(leaves.begin(rest.moving(), 1e-6) == 3);
  BOOST_TEST(leaves.are_parted(3, 4));
  BOOST_TEST(leaves.are_parted(5, 6));
  BOOST_TEST(!leaves.are_parted(3, 5));  // one triangle has no plane
  BOOST_TEST(!leaves.is_parted(4, 0));
  leaves.note(4, two, 0, up, 1e-3);
  leaves.begin(rest.moving(), 1e-6);
  BOOST_TEST(leaves.are_parted(3, 6));
  BOOST_TEST(!leaves.are_parted(2, 6));  // of one nothing is known
  BOOST_TEST(!leaves.are_parted(3, 7));
  rest.motion.linear = Vector(0, 0, -9.98e-4);  // leaves 2 µm
  leaves.begin(rest.moving(), 1e-6);
  BOOST_TEST(leaves.are_parted(3, 6));
  rest.motion.linear = Vector(0, 0, -9.995e-4);
  leaves.begin(rest.moving(), 1e-6);
  BOOST_TEST(!leaves.is_parted(3, 0));
}

BOOST_AUTO_TEST_CASE(a_turn_takes_as_much_room_as_the_radius_by_its_angle_before_a_note_and_after) {
  const double turn = 0.05;
  auto rest = resting_at(Vector::Zero());
  const double way = turn * rest.radius;
  PartedLeaves<double> leaves(8, 0);
  leaves.begin(rest.moving(), 1e-6);
  leaves.note(0, 1, 0, up, way + 2e-6);
  rest.motion.angular = Vector(turn, 0, 0);
  leaves.begin(rest.moving(), 1e-6);
  BOOST_TEST(leaves.is_parted(0, 0));
  rest.motion.angular *= 1.01;
  leaves.begin(rest.moving(), 1e-6);
  BOOST_TEST(!leaves.is_parted(0, 0));

  rest.motion = {};
  rest.pose.rotation = Eigen::AngleAxisd(turn, Vector::UnitX());
  leaves.begin(rest.moving(), 1e-6);
  BOOST_TEST(leaves.is_parted(0, 0));  // what was noted before the turn has hardly any room left
  leaves.note(1, 1, 0, up, way / 2);  // what is noted after it has all of its own
  leaves.begin(rest.moving(), 1e-6);
  BOOST_TEST(leaves.is_parted(0, 0));
  BOOST_TEST(leaves.is_parted(1, 0));
  rest.pose.rotation = Eigen::AngleAxisd(1.4 * turn, Vector::UnitX());
  leaves.begin(rest.moving(), 1e-6);
  BOOST_TEST(!leaves.is_parted(0, 0));
  BOOST_TEST(leaves.is_parted(1, 0));
  rest.pose.rotation = Eigen::AngleAxisd(1.6 * turn, Vector::UnitX());
  leaves.begin(rest.moving(), 1e-6);
  BOOST_TEST(!leaves.is_parted(1, 0));
}

BOOST_AUTO_TEST_CASE(a_tool_that_has_gone_farther_than_its_size_knows_nothing) {
  auto rest = resting_at(Vector::Zero());
  PartedLeaves<double> leaves(8, 0);
  leaves.begin(rest.moving(), 1e-6);
  leaves.note(0, two, 0, up, 1.0);
  rest.pose.translation = Vector(0.01, 0, 0);
  BOOST_TEST(leaves.begin(rest.moving(), 1e-6) == 1);
  BOOST_TEST(leaves.is_parted(0, 0));
  rest.pose.translation = Vector(0.02, 0, 0);  // its radius is 17 mm
  BOOST_TEST(leaves.begin(rest.moving(), 1e-6) == 0);
  BOOST_TEST(!leaves.is_parted(0, 0));
}

BOOST_AUTO_TEST_CASE(leaves_beyond_the_capacity_are_not_kept_and_those_not_asked_for_go) {
  const auto rest = resting_at(Vector::Zero());
  PartedLeaves<double> leaves(4, 0);
  leaves.begin(rest.moving(), 1e-6);
  for (const std::int32_t leaf : {7, 1}) leaves.note(leaf, 1, 0, up, 1e-3);
  BOOST_TEST(leaves.begin(rest.moving(), 1e-6) == 2);
  for (std::int32_t leaf = 2; leaf < 6; ++leaf) leaves.note(leaf, 1, 0, up, 1e-3);
  BOOST_TEST(leaves.begin(rest.moving(), 1e-6) == 4);
  BOOST_TEST(leaves.are_parted(1, 4));
  BOOST_TEST(leaves.is_parted(7, 0));
  for (int motion = 0; motion < 10; ++motion) {
    leaves.begin(rest.moving(), 1e-6);
    BOOST_TEST(leaves.is_parted(2, 0));
  }
  BOOST_TEST(leaves.begin(rest.moving(), 1e-6) == 1);

  PartedLeaves<double> none;
  none.begin(rest.moving(), 1e-6);
  none.note(0, 1, 0, up, 1e-3);
  BOOST_TEST(none.begin(rest.moving(), 1e-6) == 0);
  BOOST_TEST(!none.is_parted(0, 0));
}

namespace {
/// A motion at rest that comes to some triangles, four a leaf, and notes a plane for each that is not parted.
bool meet(PartedLeaves<double>& leaves, const RandomMotion<Box>& rest, int triangles, double room) {
  leaves.begin(rest.moving(), 1e-6);
  for (int i = 0; i < triangles; ++i) {
    if (!leaves.is_parted(i / 4, std::size_t(i % 4)) && leaves.is_kept()) leaves.note(i / 4, 15, std::size_t(i % 4), up, room);
  }
  return leaves.is_kept();
}
constexpr double parting = 1e-3, not_parting = 0.5e-6;
}  // namespace

BOOST_AUTO_TEST_CASE(a_front_is_kept_where_many_triangles_are_near_and_it_pays) {
  const auto rest = resting_at(Vector::Zero());
  PartedLeaves<double> leaves(16, 8);
  for (int motion = 0; motion < 3; ++motion) BOOST_TEST(!meet(leaves, rest, 7, parting));
  for (int motion = 0; motion < 20; ++motion) meet(leaves, rest, 8, parting);
  BOOST_TEST(leaves.is_kept());  // told once, it tells each time
  BOOST_TEST(!leaves.empty());

  PartedLeaves<double> told_in_vain(16, 8);
  int kept = 0;
  for (int motion = 0; motion < 200; ++motion) kept += meet(told_in_vain, rest, 40, not_parting);
  BOOST_TEST(kept > 0);
  BOOST_TEST(kept < 40);
}

BOOST_AUTO_TEST_CASE(a_cleared_front_does_what_a_new_one_does) {
  const auto rest = resting_at(Vector(3, 1, 2));
  for (const int used : {1, 2, 5, 20}) {  // kept, on trial, given up
    for (const double room : {parting, not_parting}) {
      PartedLeaves<double> cleared(16, 8), fresh(16, 8);
      for (int motion = 0; motion < used; ++motion) meet(cleared, resting_at(Vector(3, 1, 2.001)), 40, room);
      cleared.clear();
      for (int motion = 0; motion < 200; ++motion) {
        BOOST_TEST(meet(cleared, rest, 40, motion % 9 < 6 ? parting : not_parting) == meet(fresh, rest, 40, motion % 9 < 6 ? parting : not_parting));
        BOOST_TEST(cleared.empty() == fresh.empty());
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
