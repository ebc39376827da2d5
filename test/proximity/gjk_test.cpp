#include "feeler/proximity/gjk.hpp"

#include <boost/test/unit_test.hpp>

#include <random>

#include "feeler/proximity/separation.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(gjk)

using feeler::ClosestPoints;
using feeler::WitnessFeatures;
using feeler::test::closest_features;
using feeler::test::WidePair;
using feeler::test::WideReal;
using feeler::test::WideTool;
using feeler::test::WideVector;
using namespace feeler_test;

namespace {

constexpr double touching = 1e-12;  // far below every gap here

struct Worst {
  WideReal distance = 0, normal = 0, points = 0, features = 0;
};

/// Compares one answer with the brute force; both in the tool frame.
template <class Tool>
void check(const Tool& tool, const Eigen::Matrix3d& corners, const ClosestPoints<double>& found, const WidePair& expected, Worst& worst) {
  BOOST_TEST_REQUIRE(!found.is_touching);
  const WideTool wide_tool(tool);
  const WideReal size = 0.2L + WideReal(corners.cwiseAbs().maxCoeff());
  const WideVector normal = found.normal.cast<WideReal>();
  BOOST_TEST(std::abs(normal.norm() - 1) < 1e-15L);
  // A proof: the normal alone shows a separation of what is returned, and no separation exceeds the distance.
  const WideReal shown = wide_tool.separation_along(normal, wide(corners));
  BOOST_TEST(std::abs(WideReal(found.distance) - shown) <= 1e-15L * size);
  BOOST_TEST(WideReal(found.distance) <= expected.distance + 1e-15L * size);
  // The direction of a gap g is known to eps·size/g, and tilts a body of that size by as much.
  const WideReal rounding = WideReal(std::numeric_limits<double>::epsilon()) * size * std::max(WideReal(1), size / expected.distance);
  worst.distance = std::max(worst.distance, (expected.distance - WideReal(found.distance)) / rounding);
  // The points are as far apart as they may be, and lie in the shapes.
  const WideVector x = found.tool_point.cast<WideReal>(), y = found.triangle_point.cast<WideReal>();
  worst.points = std::max(worst.points, std::abs((x - y).norm() - expected.distance) / rounding);
  const auto t = wide(corners);
  worst.features = std::max(worst.features, (feeler::test::closest_on_wide_triangle(y, t[0], t[1], t[2]) - y).norm() / size);
  for (const auto& face : wide_tool.faces) {
    const auto at = [&](std::size_t i) { return wide_tool.vertices[std::size_t(face[i])]; };
    const WideVector outward = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    worst.features = std::max(worst.features, outward.dot(x - at(0)) / size);
  }
}

template <class MakeTool>
Worst check_random_pairs(unsigned seed, int count, const MakeTool& make_tool) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  Worst worst;
  for (int i = 0; i < count; ++i) {
    const auto tool = make_tool(bits);
    const Shape shape = random_shape(bits);
    const Eigen::Matrix3d corners = triangle_near(tool, bits, shape, magnitude(bits, -9, 0));
    const WidePair expected = closest_features(WideTool(tool), wide(corners));
    BOOST_TEST_CONTEXT("pair " << i << " shape " << int(shape) << " gap " << expected.distance) {
      const auto cold = feeler::gjk(tool, corners, {}, touching);
      check(tool, corners, cold, expected, worst);
      // From its own features and from any others: the same distance.
      check(tool, corners, feeler::gjk(tool, corners, cold.features, touching), expected, worst);
      WitnessFeatures warm;
      warm.size = 1 + below(bits, 3);
      for (std::size_t k = 0; k < 3; ++k) {
        warm.tool_vertices[k] = short(below(bits, tool.vertex_count()));
        warm.corners[k] = short(below(bits, 3));
      }
      check(tool, corners, feeler::gjk(tool, corners, warm, touching), expected, worst);
    }
  }
  BOOST_TEST_MESSAGE("worst: distance " << worst.distance << " roundings, points " << worst.points << ", outside their shapes " << worst.features);
  return worst;
}

void check_worst(const Worst& worst) {
  BOOST_TEST(worst.distance < 5000);
  BOOST_TEST(worst.points < 5000);
  BOOST_TEST(worst.features < 1e-14L);
}

}  // namespace

BOOST_AUTO_TEST_CASE(distance_of_a_segment_is_that_of_brute_force_from_any_start) { check_worst(check_random_pairs(1, 4000, random_segment)); }
BOOST_AUTO_TEST_CASE(distance_of_a_box_is_that_of_brute_force_from_any_start) { check_worst(check_random_pairs(2, 4000, random_box)); }

BOOST_AUTO_TEST_CASE(a_sphere_beside_an_edge_by_a_hair_is_as_far_from_a_large_triangle_as_its_plane) {
  const feeler::Sphere<double> ball(0.005);
  for (const double aside : {0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8}) {
    Eigen::Matrix3d corners;
    corners << -0.1 - aside, 0.1 - aside, 0.1 - aside, -0.1, -0.1, 0.1, -0.005, -0.005, -0.005;
    for (const double turn : {1.0, -1.0}) {  // of both sides of the edge
      Eigen::Matrix3d side = corners;
      side.row(0) *= turn;
      side.row(1) *= turn;
      BOOST_TEST(std::abs(feeler::gjk(ball, side, {}, 1e-8).distance) <= 1e-15);
    }
  }
}

BOOST_AUTO_TEST_CASE(closest_points_of_a_swept_tool_are_those_of_its_core_and_the_distance_is_less_by_the_radius) {
  std::mt19937 bits(7);
  for (int i = 0; i < 500; ++i) {
    const auto tool = random_rounded_box(bits);
    const Eigen::Matrix3d corners = random_triangle(bits, random_shape(bits)).colwise() + 0.3 * random_vector(bits);
    const auto core = feeler::gjk(tool.core(), corners, {}, touching), found = feeler::gjk(tool, corners, {}, touching);
    // Where a face is nearest it says so more exactly than the core's squares.
    BOOST_TEST(found.distance >= core.distance - tool.swept_radius());
    BOOST_TEST(found.distance <= core.distance - tool.swept_radius() + 1e-12);
    BOOST_TEST((found.normal - core.normal).norm() <= 1e-6);
    BOOST_TEST(std::abs(WideTool(tool).separation_along(found.normal.cast<WideReal>(), wide(corners)) - WideReal(found.distance)) <= 1e-15L);
    BOOST_TEST(found.tool_point == core.tool_point);
    BOOST_TEST(found.is_touching == core.is_touching);
  }
}
BOOST_AUTO_TEST_CASE(distance_of_a_hull_is_that_of_brute_force_from_any_start) {
  check_worst(check_random_pairs(3, 2000, [](std::mt19937& bits) { return random_hull(bits, 4 + below(bits, 28)); }));
}

BOOST_AUTO_TEST_CASE(faces_flat_on_each_other_keep_the_normal_of_the_face) {
  const feeler::Box<double> box(Vector(0.03, 0.02, 0.01));
  Eigen::Matrix3d corners;
  for (const double gap : {1e-6, 1e-3, 1.0}) {
    corners << -0.1, 0.1, 0.01, -0.1, -0.1, 0.1, -0.01 - gap, -0.01 - gap, -0.01 - gap;
    const auto found = feeler::gjk(box, corners, {}, touching);
    BOOST_TEST((found.normal - Vector::UnitZ()).norm() < 1e-15 / gap);
    BOOST_TEST(std::abs(found.distance - gap) < 1e-16 / gap);
  }
}

BOOST_AUTO_TEST_CASE(shapes_that_overlap_are_touching_from_any_start) {
  constexpr unsigned seed = 4;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int overlapping = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto box = random_box(bits);
    const Eigen::Matrix3d corners = random_triangle(bits, Shape::ordinary);
    if (!feeler::test::intersect(WideTool(box), wide(corners))) continue;
    ++overlapping;
    WitnessFeatures warm;
    warm.size = below(bits, 4);
    for (std::size_t k = 0; k < 3; ++k) {
      warm.tool_vertices[k] = short(below(bits, 8));
      warm.corners[k] = short(below(bits, 3));
    }
    const auto found = feeler::gjk(box, corners, warm, 1e-8);
    // Touching, or at least no separation claimed that there is none of.
    BOOST_TEST((found.is_touching || found.distance <= 0));
    BOOST_TEST(feeler::separation(box, corners, warm, 1e-8).distance <= 1e-16);
  }
  BOOST_TEST(overlapping > 500);
}

namespace {

struct CountingBox : feeler::Box<double> {
  using feeler::Box<double>::Box;
  static inline int supports = 0;
  int support(const Eigen::Vector3d& direction) const noexcept {
    ++supports;
    return Box::support(direction);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(shapes_that_overlapped_start_from_there_though_they_overlap_no_more) {
  constexpr unsigned seed = 6;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const CountingBox box(Eigen::Vector3d(0.01, 0.02, 0.03));
  const auto supports_of = [&box](const Eigen::Matrix3d& corners, const WitnessFeatures& warm) {
    CountingBox::supports = 0;
    feeler::gjk(box, corners, warm, touching);
    return CountingBox::supports;
  };
  int overlapping = 0, apart = 0, cold = 0, warm = 0, cold_apart = 0, warm_apart = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Matrix3d corners = 0.03 * random_triangle(bits, Shape::ordinary);
    const auto found = feeler::gjk(box, corners, {}, touching);
    if (!found.is_touching || found.features.size < 3) continue;
    ++overlapping;
    cold += supports_of(corners, {});
    warm += supports_of(corners, found.features);
    // Out of it along the axis that parts them.
    const auto away = feeler::separation(box, corners, {}, touching);
    const Eigen::Matrix3d moved = corners.colwise() + (away.distance - 1e-5) * away.normal;
    if (feeler::gjk(box, moved, {}, touching).is_touching) continue;
    ++apart;
    cold_apart += supports_of(moved, {});
    warm_apart += supports_of(moved, found.features);
  }
  BOOST_TEST_MESSAGE("support calls, cold and warm: " << double(cold) / overlapping << ", " << double(warm) / overlapping
                                                      << "; no longer overlapping " << double(cold_apart) / apart << ", "
                                                      << double(warm_apart) / apart);
  BOOST_TEST(overlapping > 300);
  BOOST_TEST(apart > 300);
  BOOST_TEST(warm * 3 < cold * 2);
  BOOST_TEST(warm_apart < cold_apart);
}

BOOST_AUTO_TEST_CASE(an_answer_does_not_change_with_the_unit_if_that_is_a_power_of_two) {
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 500; ++i) {
    const auto box = random_box(bits);
    const feeler::Box<double> larger(box.half_extents() * 1024);
    const Eigen::Matrix3d corners = triangle_near(box, bits, Shape::ordinary, magnitude(bits, -9, -1));
    const auto a = feeler::gjk(box, corners, {}, touching);
    const auto b = feeler::gjk(larger, Eigen::Matrix3d(corners * 1024), {}, touching * 1024);
    BOOST_TEST(a.distance * 1024 == b.distance);
    BOOST_TEST(a.normal == b.normal);
  }
}

BOOST_AUTO_TEST_CASE(a_capsule_over_the_inside_of_a_triangle_is_as_far_from_it_as_from_its_plane_to_the_last_digits) {
  constexpr unsigned seed = 31;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const double radius = 0.01;
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    const feeler::Capsule<double> tool({0.05 * random_vector(bits), 0.05 * random_vector(bits)}, radius);
    const double size = magnitude(bits, -0.5, 1), gap = magnitude(bits, -7, -3);
    const Vector normal = random_direction(bits), x = size * normal.unitOrthogonal(), y = normal.cross(x);
    const double lowest = std::min(normal.dot(tool.vertex(0)), normal.dot(tool.vertex(1)));
    Eigen::Matrix3d corners;
    corners << -x - y, x - y, 1.5 * y;
    corners.colwise() += Vector((lowest - radius - gap) * normal);
    const double exact = lowest - radius - normal.dot(corners.col(0));
    worst = std::max(worst, std::abs(feeler::gjk(tool, corners, {}, 1e-8).distance - exact));
  }
  BOOST_TEST(worst < 2e-14);
}

BOOST_AUTO_TEST_SUITE_END()
