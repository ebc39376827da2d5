#include "feeler/proximity/known_triangles.hpp"

#include <boost/test/unit_test.hpp>

#include <random>
#include <span>
#include <vector>

#include "feeler/tool/box.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(known_triangles)

using namespace feeler_test;
using Box = feeler::Box<double>;
using Known = feeler::KnownTriangle<double>;
using Vector = Eigen::Vector3d;

namespace {

const Box box(Vector(0.01, 0.01, 0.01));
const feeler::Clearance<double> clearance;

/// A box that stands with its bottom at z = 0, or sinks by so much.
feeler::MovingTool<Box> falling(double way) {
  const feeler::Twist<double> motion{Vector(0, 0, -way), Vector::Zero()};
  return feeler::MovingTool<Box>(box, Vector::Zero(), 0.02, feeler::Pose<double>(), motion);
}
Eigen::Matrix3d level(double height) {
  Eigen::Matrix3d corners;
  corners << -1, 1, 0, -1, -1, 1, height, height, height;
  corners.row(2).array() -= 0.01;  // as seen from the middle of the box
  return corners;
}
Known floor_at(int number, double height, const Vector& normal = Vector::UnitZ()) { return {number, {level(height), normal, {}, true}}; }

struct Set {
  std::vector<Known> list;
  feeler::KnownTriangles<double> known;
  explicit Set(std::vector<Known> all) : list(std::move(all)) { known.set(std::span<const Known>(list)); }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_plane_hides_where_the_tool_stands_near_it_and_not_in_it) {
  const auto standing = falling(0);
  const auto hiding = [&](double gap, const Vector& normal) {
    return Set({floor_at(0, -gap, normal)}).known.hiding_planes(standing, standing.frame_at_start(), clearance);
  };
  const double kept = clearance.kept;
  for (const double gap : {1.9 * kept, 0.5 * kept, kept / 500}) {
    const auto planes = hiding(gap, Vector::UnitZ());
    BOOST_TEST_REQUIRE(planes.size() == 1);
    BOOST_TEST((planes[0].normal == Vector::UnitZ()));
    BOOST_TEST(planes[0].height >= -0.01 - gap);
    BOOST_TEST(planes[0].height < -0.01 - gap + kept / 100);
  }
  BOOST_TEST(hiding(2.1 * kept, Vector::UnitZ()).empty());
  BOOST_TEST(hiding(-kept, Vector::UnitZ()).empty());
  BOOST_TEST(hiding(kept, Vector::Zero()).empty());  // none is known
}

BOOST_AUTO_TEST_CASE(no_two_planes_that_hide_are_alike_and_they_are_a_few) {
  const auto standing = falling(0);
  const double gap = clearance.kept;
  std::vector<Known> all;
  for (int i = 0; i < 10; ++i) all.push_back(floor_at(i, -gap));
  BOOST_TEST(Set(all).known.hiding_planes(standing, standing.frame_at_start(), clearance).size() == 1);
  all.clear();
  for (int i = 0; i < 10; ++i) {
    Known leaning = floor_at(i, 0, Vector(1e-3 * (i - 5), 0, 1).normalized());
    const double height = standing.lowest(leaning.state.normal, standing.frame_at_start()) - gap;
    leaning.state.corners.setZero();
    leaning.state.corners.colwise() += Vector(height * leaning.state.normal);
    all.push_back(leaning);
  }
  BOOST_TEST(Set(all).known.hiding_planes(standing, standing.frame_at_start(), clearance).size() == feeler::KnownTriangles<double>::plane_capacity);
}

BOOST_AUTO_TEST_CASE(what_lies_in_or_behind_the_plane_of_a_known_triangle_is_hidden_as_long_as_that_parts_it) {
  const double kept = clearance.kept, gap = 10 * kept;
  const auto hides = [&](double way, double height, const Vector& normal = Vector::UnitZ()) {
    Set set({floor_at(0, -gap, normal)});
    const auto moving = falling(way);
    int work = 0;
    return set.known.hide(level(height), moving, moving.frame_at_start(), moving.frame_at(1), clearance, work);
  };
  BOOST_TEST(hides(0, -gap));
  BOOST_TEST(hides(0, -gap - 0.1));
  BOOST_TEST(hides(0, -gap + kept / 1100));  // as flat as a wall may be
  BOOST_TEST(!hides(0, -gap + kept / 900));
  BOOST_TEST(!hides(0, -gap, Vector::Zero()));
  BOOST_TEST(hides(gap - 1.01 * kept, -gap));
  BOOST_TEST(!hides(gap - 0.99 * kept, -gap));
  BOOST_TEST(hides(gap - 0.99 * kept, -gap - kept));
}

BOOST_AUTO_TEST_CASE(triangles_are_known_by_their_numbers) {
  std::mt19937 bits(1);
  for (int round = 0; round < 20; ++round) {
    std::vector<Known> all;
    std::vector<bool> is_listed(500, false);
    for (int i = 0; i < 2 * round; ++i) {
      const int number = below(bits, 500);
      all.push_back(floor_at(number, 0));
      is_listed[std::size_t(number)] = true;
    }
    const Set set(all);
    const auto is_known = set.known.by_number();
    for (int i = 0; i < 500; ++i) BOOST_TEST(is_known(i) == is_listed[std::size_t(i)]);
  }
}

BOOST_AUTO_TEST_SUITE_END()
