// Separations along planes that pairs have, against sums over all vertices in long double.
#include "feeler/render/constraints/pair_separation.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "feeler/render/rendered_scene.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(pair_separation)

using namespace feeler_test;

using feeler::RenderedScene;
using Box = feeler::Box<double>;
using Capsule = feeler::Capsule<double>;
using Pair = feeler::WorkingPair<double>;
using Pose = feeler::Pose<double>;
using Wide = Eigen::Matrix<long double, 3, 1>;

namespace {

/// A triangle of 0.2 m in the plane z = 0, with its first side along x.
const feeler::TriangleMesh<double>& floor_triangle() {
  static const feeler::TriangleMesh<double> mesh(feeler::Points<double>{{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0, 0.1, 0}}, feeler::Triangles{{0, 1, 2}});
  return mesh;
}
Pair pair_of(const Eigen::Matrix3d& corners) {
  Pair pair;
  pair.triangle = 0;
  pair.corners_world = corners;
  return pair;
}
Pair floor_pair() { return pair_of(floor_triangle().corners(0)); }

/// A cube of 20 mm above the floor, the planes of its pairs measured at a start.
struct Cube {
  using Scene = RenderedScene<Box>;
  static constexpr double half = 0.01;

  Scene scene{floor_triangle(), Box(Vector::Constant(half)), feeler::Settings<double>()};
  feeler::PairSeparation<Scene> separation;
  int work = 0;

  static Pose at(double height) { return {{0, 0, half + height}, Eigen::Quaterniond::Identity()}; }
  Pair measured(double height) {
    Pair pair = floor_pair();
    separation.put_at(at(height), true);
    separation.query(scene, pair, separation.corners_in_tool(scene, pair), work);
    return pair;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(the_separation_along_a_normal_is_from_the_highest_corner_to_the_lowest_point_of_a_round_tool) {
  std::mt19937 bits(1);
  for (int round = 0; round < 300; ++round) {
    const Capsule tool = random_capsule(bits);
    feeler::Settings<double> settings;
    settings.reference_point = 0.1 * random_vector(bits);
    const RenderedScene<Capsule> scene(floor_triangle(), tool, settings);
    feeler::PairSeparation<RenderedScene<Capsule>> separation;
    const Pose frame{0.2 * random_vector(bits), random_rotation(bits)};
    const Vector normal = random_direction(bits);
    const Pair pair = pair_of(random_triangle(bits, Shape::ordinary));
    long double lowest = std::numeric_limits<long double>::infinity(), highest = -lowest;
    const Wide n = normal.cast<long double>();
    for (int i = 0; i < 2; ++i) lowest = std::min(lowest, n.dot((frame * tool.vertex(i)).cast<long double>()));
    for (int k = 0; k < 3; ++k) highest = std::max(highest, n.dot(Wide(pair.corners_world.col(k).cast<long double>())));
    const double expected = double(lowest - feeler::swept_radius(tool) - highest);
    int work = 0;
    separation.put_at(scene.reference_pose(frame), false);
    BOOST_TEST(std::abs(separation.slack_along(scene, pair, normal, work) - expected) < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(what_is_measured_at_a_start_is_the_plane_of_the_pair_and_on_the_way_it_is_not) {
  Cube cube;
  const Pair pair = cube.measured(1e-3);
  BOOST_TEST((pair.normal - Vector::UnitZ()).norm() < 1e-12);
  BOOST_TEST((pair.last_normal - Vector::UnitZ()).norm() < 1e-12);
  BOOST_TEST(pair.slack == 1e-3, boost::test_tools::tolerance(1e-9));

  Pair on_the_way = pair;
  on_the_way.moved = 1e-4;
  cube.separation.put_at(Cube::at(2e-3), false);
  const auto closest = cube.separation.query(cube.scene, on_the_way, cube.separation.corners_in_tool(cube.scene, on_the_way), cube.work);
  BOOST_TEST(closest.distance == 2e-3, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(on_the_way.slack == pair.slack);
  BOOST_TEST(on_the_way.moved == 1e-4);

  // At the start of a motion that is under way it is again.
  cube.separation.query_at_start(cube.scene, on_the_way, Cube::at(3e-3), cube.work);
  BOOST_TEST(on_the_way.slack == 3e-3, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(on_the_way.moved == 0.0);
}

BOOST_AUTO_TEST_CASE(planes_keep_a_distance_or_as_much_of_it_as_there_was_at_the_start) {
  const double margin = 1e-6, infinite = std::numeric_limits<double>::infinity();
  Cube cube;
  for (const double start : {0.3e-6, 0.9e-6, 5e-6}) {
    const std::array<Pair, 1> pairs{cube.measured(start)};
    const double enough = std::min(margin, start);
    for (const double end : {0.2e-6, 0.4e-6, 0.8e-6, 0.95e-6, 1.1e-6, 6e-6}) {
      const bool is_kept = cube.separation.keeps(cube.scene, pairs, margin, Cube::at(end), infinite, cube.work);
      BOOST_TEST(is_kept == (end > enough), "from " << start << " to " << end);
    }
    BOOST_TEST(cube.separation.keeps(cube.scene, pairs, margin, Cube::at(start + 1e-12), infinite, cube.work));
    BOOST_TEST(cube.separation.keeps(cube.scene, pairs, margin, Cube::at(0), start / 2, cube.work), "it is beyond the reach");
    BOOST_TEST(!cube.separation.keeps(cube.scene, pairs, margin, Cube::at(0), 2 * start, cube.work));
  }
}

BOOST_AUTO_TEST_CASE(a_pair_below_the_plane_of_another_has_that_plane_where_a_motion_starts_and_its_normal_on_the_way) {
  Cube cube;
  // A triangle that falls away from the floor on one side, by 45°.
  Eigen::Matrix3d slope = floor_triangle().corners(0);
  slope.col(2) = Vector(0, -0.2, -0.1);
  for (const bool is_at_start : {true, false}) {
    const Pair top = cube.measured(1e-4);
    cube.separation.put_at(Cube::at(2e-4), is_at_start);
    Pair below = pair_of(slope);
    const Vector own = Vector(0, -1, 1).normalized();
    below.set_plane(own, 0.5);
    below.last_normal = own;
    BOOST_TEST(!cube.separation.try_cover(cube.scene, below), "no plane covers others yet");
    cube.separation.add_cover(top, 2e-4);
    BOOST_TEST_REQUIRE(cube.separation.try_cover(cube.scene, below));
    BOOST_TEST((below.last_normal - Vector::UnitZ()).norm() < 1e-12);
    if (is_at_start) {
      BOOST_TEST((below.normal - Vector::UnitZ()).norm() < 1e-12);
      BOOST_TEST(below.slack == 2e-4, boost::test_tools::tolerance(1e-9));
    } else {
      BOOST_TEST(below.normal == own);
      BOOST_TEST(below.slack == 0.5);
    }
    Pair beside = floor_pair();
    beside.corners_world.row(2).array() += 1e-5;
    BOOST_TEST(!cube.separation.try_cover(cube.scene, beside), "it is above the plane");
  }
}

BOOST_AUTO_TEST_CASE(a_pair_is_left_to_its_own_plane_where_that_parts_it_by_more_than_what_touches) {
  Cube cube;
  const double touches = cube.scene.contact_distance();
  for (const bool is_at_start : {true, false}) {
    for (const double height : {0.5 * touches, 0.99 * touches, 1.01 * touches, 2 * touches}) {
      Pair pair = cube.measured(1e-3);
      cube.separation.put_at(Cube::at(height), is_at_start);
      const bool is_parted = cube.separation.try_own_plane(cube.scene, pair, 1.0, cube.work);
      BOOST_TEST(is_parted == (height > touches));
      BOOST_TEST(pair.slack == (is_at_start && is_parted ? height : 1e-3), boost::test_tools::tolerance(1e-6));
    }
    Pair unknown = floor_pair();
    BOOST_TEST(!cube.separation.try_own_plane(cube.scene, unknown, 1.0, cube.work));
    Pair far = cube.measured(1e-3);
    cube.separation.put_at(Cube::at(0), is_at_start);
    BOOST_TEST(cube.separation.try_own_plane(cube.scene, far, 0.9e-3, cube.work), "it is beyond the reach");
  }
}

BOOST_AUTO_TEST_SUITE_END()
