#include "support/penetration_checker.hpp"

#include <boost/test/unit_test.hpp>

#include <random>

#include "scenes/rotation_between.hpp"

BOOST_AUTO_TEST_SUITE(penetration_checker)

using namespace feeler::test;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

using Vertices = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using Indices = Eigen::Matrix<int, Eigen::Dynamic, 3>;

const CheckedPose at_rest(Vector3d::Zero(), Quaterniond::Identity());

CheckedPose shifted(double x, double y, double z) { return {Vector3d(x, y, z), Quaterniond::Identity()}; }

CheckedObject triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Vertices vertices(3, 3);
  vertices << a.transpose(), b.transpose(), c.transpose();
  return {vertices, Eigen::RowVector3i(0, 1, 2)};
}

/// The square |x|, |y| ≤ 8 at z = 0, in two triangles.
CheckedObject plane() {
  Vertices vertices(4, 3);
  vertices << -8, -8, 0, 8, -8, 0, 8, 8, 0, -8, 8, 0;
  Indices triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  return {vertices, triangles};
}

/// The box |x| ≤ h.x, |y| ≤ h.y, |z| ≤ h.z, turned in its own frame.
CheckedTool box(const Vector3d& h, const Quaterniond& turn = Quaterniond::Identity()) {
  Vertices vertices(8, 3);
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner(i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(), i & 4 ? h.z() : -h.z());
    vertices.row(i) = turn * corner;
  }
  return {vertices,
          {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
          {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
}

CheckedTool segment(const Vector3d& a, const Vector3d& b) {
  Vertices vertices(2, 3);
  vertices << a.transpose(), b.transpose();
  return {vertices, {{0, 1}}, {}};
}

double depth_of(const CheckedObject& object, const CheckedTool& tool, const CheckedPose& pose) {
  return static_cast<double>(deepest_penetration(object, tool, pose).depth);
}

/// Uniform in [-1, 1], the same with every standard library.
double random_unit(std::mt19937& bits) { return double(bits()) / 2147483647.5 - 1; }
Vector3d random_vector(std::mt19937& bits) { return {random_unit(bits), random_unit(bits), random_unit(bits)}; }
Quaterniond random_rotation(std::mt19937& bits) {
  return Quaterniond(random_unit(bits), random_unit(bits), random_unit(bits), random_unit(bits)).normalized();
}

const double depths[] = {1e-3, 1e-6, 1e-9, 1e-12};

}  // namespace

BOOST_AUTO_TEST_CASE(cube_in_a_plane_is_as_deep_as_it_is_pushed) {
  const CheckedTool cube = box(Vector3d::Constant(0.5));
  for (const double depth : depths) {
    const Penetration p = deepest_penetration(plane(), cube, shifted(0.25, -0.125, 0.5 - depth));
    BOOST_TEST(std::abs(double(p.depth) - depth) < 1e-16);  // 0.5 − depth is rounded
    BOOST_TEST(p.triangle >= 0);
    BOOST_TEST(std::abs(depth_of(plane(), cube, shifted(0, 0, -0.5 + depth)) - depth) < 1e-16);  // from below
  }
}

BOOST_AUTO_TEST_CASE(corner_in_a_face_is_as_deep_as_its_tip) {
  const CheckedTool cube = box(Vector3d::Constant(0.5));
  const Quaterniond on_its_corner = feeler::scenes::rotation_between(Vector3d(-1, -1, -1), Vector3d(0, 0, -1));
  for (const double depth : depths) {
    const CheckedPose pose(Vector3d(1, -2, std::sqrt(0.75) - depth), on_its_corner);
    BOOST_TEST(std::abs(depth_of(plane(), cube, pose) - depth) < 5e-16);
  }
}

BOOST_AUTO_TEST_CASE(corner_of_the_object_is_as_deep_as_it_pierces_a_face_of_the_tool) {
  const Quaterniond turn = Quaterniond(1, 2, 3, 4).normalized();
  const CheckedTool cube = box(Vector3d::Constant(0.5), turn);
  for (const double depth : depths) {
    const CheckedObject spike = triangle({0.1, 0.1, 0.5 - depth}, {1, 0.25, 3}, {-0.25, 1, 2});
    BOOST_TEST(std::abs(depth_of(spike, cube, {Vector3d::Zero(), turn.conjugate()}) - depth) < 5e-16);
  }
}

BOOST_AUTO_TEST_CASE(crossing_edges_are_as_deep_as_they_overlap) {
  const CheckedTool bar = box(Vector3d(0.5, 4, 0.5));
  const CheckedObject wall = triangle({-2, 0, 0}, {2, 0, 0}, {0, 0, -2});  // its edge along x points up
  const Quaterniond on_its_edge(Eigen::AngleAxisd(std::acos(0.0) / 2, Vector3d::UnitY()));
  for (const double depth : depths) {
    const CheckedPose pose(Vector3d(0.25, 0.5, std::sqrt(0.5) - depth), on_its_edge);
    BOOST_TEST(std::abs(depth_of(wall, bar, pose) - depth) < 5e-16);
  }
}

BOOST_AUTO_TEST_CASE(segment_through_a_triangle_is_as_deep_as_its_shorter_part) {
  for (const double depth : depths) {
    const CheckedTool needle = segment({0, 0, -depth}, {0.1, 0.2, 1});
    BOOST_TEST(std::abs(depth_of(plane(), needle, shifted(1, 2, 0)) - depth) < 1e-18);
  }
  // The nearest way out may be past an edge: an upright segment 0.01 from the side of the square.
  BOOST_TEST(std::abs(depth_of(plane(), segment({0, 0, -1}, {0, 0, 1}), shifted(8 - 0.0078125, 0, 0)) - 0.0078125) < 1e-18);
}

BOOST_AUTO_TEST_CASE(a_sphere_is_as_deep_as_its_centre_is_nearer_than_the_radius) {
  const CheckedTool ball = CheckedTool(Vertices::Zero(1, 3), {}, {}).swept_by(0.5L);
  for (const double depth : depths) {
    BOOST_TEST(std::abs(depth_of(plane(), ball, shifted(1, 2, 0.5 - depth)) - depth) < 1e-16);   // over a face
    BOOST_TEST(std::abs(depth_of(plane(), ball, shifted(8.5 - depth, 2, 0)) - depth) < 2e-15);   // beside the rim
    const double aside = (0.5 - depth) / std::sqrt(3.0);  // off a corner of the square
    BOOST_TEST(std::abs(depth_of(plane(), ball, shifted(8 + aside, 8 + aside, aside)) - depth) < 2e-15);
  }
  BOOST_TEST(depth_of(plane(), ball, shifted(0, 0, 0)) == 0.5);  // the centre in the plane
  BOOST_TEST(depth_of(plane(), ball, shifted(0, 0, 0.5)) == 0);
  BOOST_TEST(depth_of(plane(), ball, shifted(8.5, 0, 0)) == 0);
  BOOST_TEST(depth_of(plane(), ball, shifted(8.36, 8.36, 0)) == 0);  // its bounds reach over the corner
}

BOOST_AUTO_TEST_CASE(a_rounded_cube_is_as_far_from_a_triangle_as_its_nearest_features_less_the_radius) {
  const CheckedTool cube = box(Vector3d::Constant(0.5)).swept_by(0.25L);
  const auto distance_of = [&](const CheckedObject& object, const CheckedPose& pose) {
    return double(distance_from_triangle(object, 0, cube, pose));
  };
  const CheckedObject floor = triangle({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
  const Quaterniond on_its_corner = feeler::scenes::rotation_between(Vector3d(-1, -1, -1), Vector3d(0, 0, -1));
  BOOST_TEST(std::abs(distance_of(floor, shifted(0, 0, 1)) - 0.25) < 1e-16);                                                    // face over face
  BOOST_TEST(std::abs(distance_of(floor, {Vector3d(0, 0, 2), on_its_corner}) - (1.75 - std::sqrt(0.75))) < 1e-15);              // a corner over it
  BOOST_TEST(std::abs(distance_of(triangle({0.1, 0.1, 2}, {1, 0.25, 3}, {-0.25, 1, 4}), at_rest) - 1.25) < 1e-16);              // its corner
  BOOST_TEST(std::abs(distance_of(triangle({1.5, -3, 1.5}, {1.5, 3, 1.5}, {4, 0, 4}), at_rest) - (std::sqrt(2.0) - 0.25)) < 1e-15);  // its edge
}

BOOST_AUTO_TEST_CASE(a_rounded_cube_is_as_deep_as_its_core_and_the_radius) {
  const CheckedTool cube = box(Vector3d::Constant(0.5)).swept_by(0.25L);
  const Quaterniond on_its_corner = feeler::scenes::rotation_between(Vector3d(-1, -1, -1), Vector3d(0, 0, -1));
  for (const double depth : depths) {
    BOOST_TEST(std::abs(depth_of(plane(), cube, shifted(1, 2, 0.75 - depth)) - depth) < 2e-16);
    const CheckedPose tilted(Vector3d(1, -2, std::sqrt(0.75) + 0.25 - depth), on_its_corner);
    BOOST_TEST(std::abs(depth_of(plane(), cube, tilted) - depth) < 5e-16);
    // The object's corner in a face, and edge over edge.
    const CheckedObject spike = triangle({0.1, 0.1, 0.75 - depth}, {1, 0.25, 3}, {-0.25, 1, 2});
    BOOST_TEST(std::abs(depth_of(spike, cube, at_rest) - depth) < 5e-16);
    const CheckedObject wall = triangle({-2, 0, 0}, {2, 0, 0}, {0, 0, -2});
    const Quaterniond on_its_edge(Eigen::AngleAxisd(std::acos(0.0) / 2, Vector3d::UnitY()));
    BOOST_TEST(std::abs(depth_of(wall, cube, {Vector3d(0.25, 0.25, std::sqrt(0.5) + 0.25 - depth), on_its_edge}) - depth) < 5e-16);
  }
  // Deeper than the radius, the core is in it.
  BOOST_TEST(std::abs(depth_of(plane(), cube, shifted(0, 0, 0.25)) - 0.5) < 1e-16);
}

BOOST_AUTO_TEST_CASE(touching_is_silent) {
  const CheckedTool cube = box(Vector3d::Constant(0.5));
  BOOST_TEST(depth_of(plane(), cube, shifted(0, 0, 0.5)) == 0);
  BOOST_TEST(depth_of(plane(), cube, shifted(0, 0, -0.5)) == 0);
  BOOST_TEST(depth_of(plane(), cube, shifted(8.5, 0, 0.25)) == 0);   // side face against the rim
  BOOST_TEST(depth_of(plane(), cube, shifted(8.5, 8.5, 0.5)) == 0);  // corner against corner
  BOOST_TEST(depth_of(plane(), segment({0, 0, 0}, {0, 0, 1}), at_rest) == 0);
  BOOST_TEST(depth_of(plane(), segment({-1, 0, 0}, {1, 0.5, 0}), at_rest) == 0);  // lies in the plane
  BOOST_TEST(depth_of(plane(), segment({8, -1, -1}, {8, 1, 1}), at_rest) == 0);   // crosses the rim
}

BOOST_AUTO_TEST_CASE(a_gap_of_a_picometre_is_silent_and_the_same_overlap_is_not) {
  std::mt19937 bits(1);
  const CheckedTool cube = box(Vector3d::Constant(0.5));
  for (int i = 0; i < 100; ++i) {
    const Quaterniond rotation = random_rotation(bits);
    const Eigen::Matrix3d r = rotation.toRotationMatrix();
    const double height = 0.5 * r.row(2).cwiseAbs().sum();  // of the centre when the lowest corner touches
    BOOST_TEST(depth_of(plane(), cube, {Vector3d(1, 2, height + 1e-12), rotation}) == 0);
    BOOST_TEST(std::abs(depth_of(plane(), cube, {Vector3d(1, 2, height - 1e-12), rotation}) - 1e-12) < 2e-15);
  }
}

BOOST_AUTO_TEST_CASE(depth_is_invariant_under_a_rigid_motion_of_everything) {
  std::mt19937 bits(2);
  const CheckedTool tool = box(Vector3d(0.5, 0.25, 1));
  int penetrating = 0;
  for (int i = 0; i < 300; ++i) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = random_vector(bits);
    const Vector3d p = random_vector(bits);
    const Quaterniond q = random_rotation(bits), motion = random_rotation(bits);
    const Vector3d shift = random_vector(bits);
    const double before = depth_of(triangle(corners.col(0), corners.col(1), corners.col(2)), tool, {p, q});
    const auto moved = [&](const Vector3d& v) -> Vector3d { return motion * v + shift; };
    const double after = depth_of(triangle(moved(corners.col(0)), moved(corners.col(1)), moved(corners.col(2))), tool, {moved(p), motion * q});
    BOOST_TEST(std::abs(before - after) < 5e-15);
    penetrating += before > 0;
  }
  BOOST_TEST((penetrating > 30 && penetrating < 270));
}

/// The definition itself, by brute force: no direction separates better than the depth says, and the depth is
/// nearly reached.
BOOST_AUTO_TEST_CASE(depth_is_the_best_separation_over_all_directions) {
  std::mt19937 bits(3);
  const CheckedTool tool = box(Vector3d(0.5, 0.25, 1));
  int penetrating = 0;
  for (int i = 0; i < 60; ++i) {
    std::array<WideVector, 3> y;
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = random_vector(bits), y[std::size_t(k)] = corners.col(k).cast<WideReal>();
    const double depth = depth_of(triangle(corners.col(0), corners.col(1), corners.col(2)), tool, at_rest);
    WideReal best = -1e9L;
    WideVector best_direction = WideVector::UnitX();
    const auto consider = [&](const Vector3d& direction) {
      const WideVector n = direction.cast<WideReal>().normalized();
      WideReal low = 1e9L, high = -1e9L;
      for (const WideVector& v : tool.vertices) low = std::min(low, n.dot(v));
      for (const WideVector& corner : y) high = std::max(high, n.dot(corner));
      if (low - high > best) best = low - high, best_direction = n;
    };
    for (int k = 0; k < 20000; ++k) consider(random_vector(bits));
    for (double radius = 0.1; radius > 1e-7; radius *= 0.7)
      for (int k = 0; k < 60; ++k) consider(best_direction.cast<double>() + radius * random_vector(bits));
    if (depth == 0) {
      BOOST_TEST(best > -1e-5L);
    } else {
      ++penetrating;
      BOOST_TEST(double(-best) >= depth - 1e-15);
      BOOST_TEST(double(-best) < depth + 2e-2);  // the search is local
    }
  }
  BOOST_TEST(penetrating > 10);
}

BOOST_AUTO_TEST_CASE(degenerate_triangles_are_segments_and_points) {
  const CheckedTool cube = box(Vector3d::Constant(0.5));
  // A segment that enters the cube from above by 2⁻⁶, an upright sliver around it, and a point inside.
  const double depth = 0.015625;
  BOOST_TEST(depth_of(triangle({0, 0, 0.5 - depth}, {0, 0, 3}, {0, 0, 1}), cube, at_rest) == depth);
  BOOST_TEST(std::abs(depth_of(triangle({0, 0, 0.5 - depth}, {0, 0, 3}, {1e-15, 0, 1}), cube, at_rest) - depth) < 1e-18);
  BOOST_TEST(depth_of(triangle({0, 0, 0.25}, {0, 0, 0.25}, {0, 0, 0.25}), cube, at_rest) == 0.25);
  BOOST_TEST(depth_of(triangle({0, 0, 0.5}, {0, 0, 3}, {0, 0, 1}), cube, at_rest) == 0);
  BOOST_TEST(depth_of(triangle({0, 0, 0.5}, {0, 0, 0.5}, {0, 0, 0.5}), cube, at_rest) == 0);
  // Two segments, crossing, collinear or apart, have no interior in common.
  const CheckedTool needle = segment({-1, 0, 0}, {1, 0, 0});
  BOOST_TEST(depth_of(triangle({0, -1, 0}, {0, 1, 0}, {0, 0, 0}), needle, at_rest) == 0);
  BOOST_TEST(depth_of(triangle({-0.5, 0, 0}, {0.5, 0, 0}, {0, 0, 0}), needle, at_rest) == 0);
  BOOST_TEST(depth_of(triangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0}), needle, at_rest) == 0);
  BOOST_TEST(depth_of(triangle({0, -1, 0}, {0, 1, 0}, {0, 0, 0}), needle, {Vector3d::Zero(), Quaterniond(1, 2, 3, 4)}) == 0);
}

BOOST_AUTO_TEST_CASE(nearly_parallel_edges_are_no_blind_spot_and_no_false_alarm) {
  // A knife edge along x over a bar that is turned by the angle: apart by the gap, or overlapping by as much.
  const CheckedObject wall = triangle({-2, 0, 0}, {2, 0, 0}, {0, 0, -2});
  std::mt19937 bits(4);
  for (int i = 0; i < 20; ++i) {
    const Quaterniond turn = random_rotation(bits);  // so that no product is exact
    const CheckedTool bar = box(Vector3d::Constant(0.5), turn);
    for (const double angle : {1e-3, 1e-8, 1e-12, 1e-16, 0.0})
      for (const double gap : {1e-9, -1e-9}) {
        const Quaterniond on_its_edge(Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * Eigen::AngleAxisd(std::acos(0.0) / 2, Vector3d::UnitX()));
        const CheckedPose pose(Vector3d(0, 0, std::sqrt(0.5) + gap), on_its_edge * turn.conjugate());
        // Out it goes upwards, or along a face of the bar, past the ends of its edge.
        const double depth = std::min(-gap, std::sqrt(0.5) * (-gap + 0.5 * std::sin(angle)));
        BOOST_TEST(std::abs(depth_of(wall, bar, pose) - std::max(0.0, depth)) < 1e-15);
      }
  }
}

BOOST_AUTO_TEST_CASE(path_finds_the_thin_plate_that_both_ends_miss) {
  const CheckedTool cube = box(Vector3d::Constant(0.5));
  const Penetration p = deepest_penetration_on_path(plane(), cube, shifted(0, 0, 1), shifted(0, 0, -1), 65);
  BOOST_TEST(double(p.depth) == 0.5);
  BOOST_TEST(p.time == 0.5);
  BOOST_TEST(depth_of(plane(), cube, shifted(0, 0, 1)) == 0);
}

BOOST_AUTO_TEST_CASE(path_turns_the_short_way_at_constant_speed) {
  const Quaterniond quarter(Eigen::AngleAxisd(std::acos(0.0), Vector3d::UnitZ()));
  const Quaterniond third(Eigen::AngleAxisd(std::acos(0.0) / 3, Vector3d::UnitZ()));
  const CheckedPose end(Vector3d(3, 0, 0), Quaterniond(-quarter.coeffs()));
  const CheckedPose pose = pose_on_path(at_rest, end, WideReal(1) / 3);
  BOOST_TEST(double((pose.translation - WideVector(1, 0, 0)).norm()) < 1e-18);
  BOOST_TEST(pose.rotation.cast<double>().angularDistance(third) < 1e-15);
}

BOOST_AUTO_TEST_CASE(a_pose_that_is_not_finite_is_never_called_free) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const CheckedTool cube = box(Vector3d::Constant(0.5));
  BOOST_TEST(std::isinf(depth_of(plane(), cube, shifted(nan, 0, 9))));
  BOOST_TEST(std::isinf(depth_of(plane(), cube, {Vector3d(0, 0, 9), Quaterniond(nan, 0, 0, 0)})));
  BOOST_TEST(std::isinf(depth_of(plane(), cube, {Vector3d(0, 0, 9), Quaterniond(0, 0, 0, 0)})));
}

BOOST_AUTO_TEST_CASE(deepest_piece_of_a_compound_counts) {
  const std::vector<CheckedTool> pieces{box(Vector3d::Constant(0.25)), box(Vector3d(0.125, 0.125, 0.5))};
  BOOST_TEST(double(deepest_penetration(plane(), pieces, shifted(1, 2, 0.375)).depth) == 0.125);
}

BOOST_AUTO_TEST_SUITE_END()
