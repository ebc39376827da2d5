#include "feeler/contact/swept_contact_row.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "feeler/contact/contact_patch.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/sphere_swept.hpp"
#include "feeler/tool/tool_incidence.hpp"
#include "support/finite_differences.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(swept_contact_row)

using feeler::SweptContactRow;
using namespace feeler_test;

namespace {

using Real = WideNumber;
using Wide = WidePoint;
using Wide6 = WideStep;

/// A point or a line of the core and a point or a line of the object, and the radius of the ball.
struct Pair {
  Wide on_tool, tool_edge, on_object, object_edge;  // directions are zero for points
  Real radius;

  /// Distance of the two after a step of the tool, less the radius: by the shortest vector across both directions.
  Real separation(const Wide6& step) const {
    const Wide w = step.tail<3>();
    Wide between = step.head<3>() + turned(w, on_tool) - on_object;
    const Wide v = turned(w, tool_edge), u = object_edge;
    if (!v.isZero(0) && !u.isZero(0)) {
      const Wide normal = v.cross(u).normalized();
      return std::abs(normal.dot(between)) - radius;
    }
    const Wide along = v + u;
    if (!along.isZero(0)) between -= along * (along.dot(between) / along.squaredNorm());
    return between.norm() - radius;
  }

  /// Its row, with the arm anywhere along the edge's normal plane: at the closest points.
  SweptContactRow<double> row() const {
    SweptContactRow<double> result;
    Wide x = on_tool, y = on_object;
    const Wide &v = tool_edge, &u = object_edge;
    if (!v.isZero(0) && !u.isZero(0)) {
      const Real c = u.dot(v), s = 1 - c * c;
      const Wide between = on_object - on_tool;
      x += v * ((between.dot(v) - c * between.dot(u)) / s);
      y += u * ((c * between.dot(v) - between.dot(u)) / s);
    } else if (!v.isZero(0)) {
      x += v * v.dot(on_object - on_tool);
    } else if (!u.isZero(0)) {
      y += u * u.dot(on_tool - on_object);
    }
    result.normal = (x - y).normalized().cast<double>();
    result.arm = x.cast<double>();
    result.tool_edge = v.cast<double>();
    result.object_edge = u.cast<double>();
    result.core_distance = double((x - y).norm());
    result.gap = double((x - y).norm() - radius);
    return result;
  }
};

Pair random_pair(std::mt19937& bits, bool has_tool_edge, bool has_object_edge) {
  const auto wide = [](const Vector& v) { return Wide(v.cast<Real>()); };
  Pair pair;
  do {
    pair = {wide(random_vector(bits)), Wide::Zero(), wide(random_vector(bits)), Wide::Zero(), 0.3L};
    if (has_tool_edge) pair.tool_edge = wide(random_direction(bits)).normalized();
    if (has_object_edge) pair.object_edge = wide(random_direction(bits)).normalized();
  } while (pair.separation(Wide6::Zero()) < -0.1L || (has_tool_edge && has_object_edge && pair.tool_edge.cross(pair.object_edge).norm() < 0.3L));
  return pair;
}

}  // namespace

BOOST_AUTO_TEST_CASE(gradient_and_curvature_of_points_and_lines_are_derivatives_of_their_distance) {
  constexpr unsigned seed = 1;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int kind = 0; kind < 4; ++kind) {
    Real worst_gradient = 0, worst_curvature = 0;
    for (int i = 0; i < 300; ++i) {
      const Pair pair = random_pair(bits, (kind & 1) != 0, (kind & 2) != 0);
      const SweptContactRow<double> row = pair.row();
      const auto separation = [&](const Wide6& step) { return pair.separation(step); };
      const auto curvature = curvature_of(row);
      BOOST_TEST((curvature - curvature.transpose()).norm() < 1e-12);
      worst_gradient = std::max(worst_gradient, largest_difference(gradient_by_differences(separation), row.gradient()));
      worst_curvature = std::max(worst_curvature, largest_difference(curvature_by_differences(separation), curvature));
    }
    BOOST_TEST_CONTEXT("tool edge " << (kind & 1) << ", object edge " << (kind & 2)) {
      BOOST_TEST(worst_gradient < 1e-6L);
      BOOST_TEST(worst_curvature < 1e-4L);  // of up to 1e2
    }
  }
}

BOOST_AUTO_TEST_CASE(a_carried_row_is_the_row_where_a_motion_ends) {
  constexpr unsigned seed = 3;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int kind = 0; kind < 4; ++kind)
    for (int i = 0; i < 100; ++i) {
      const Pair pair = random_pair(bits, (kind & 1) != 0, (kind & 2) != 0);
      const feeler::Twist<double> motion{0.01 * random_vector(bits), 0.01 * random_vector(bits)};
      const Wide6 step = motion.vector().cast<Real>();
      const SweptContactRow<double> carried = pair.row().carried(motion);
      const auto separation = [&](const Wide6& d) { return pair.separation(composed(step, d)); };
      BOOST_TEST(std::abs(separation(Wide6::Zero()) - Real(carried.gap)) < 1e-14L);
      BOOST_TEST(std::abs(Real(carried.gap - carried.core_distance) + pair.radius) < 1e-14L);
      BOOST_TEST(largest_difference(gradient_by_differences(separation), carried.gradient()) < 1e-6L);
    }
}

BOOST_AUTO_TEST_CASE(the_closest_points_of_parallel_lines_bend_as_a_point_and_a_line_and_of_a_face_turn_with_the_tool) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const Vector reference(0.001, 0.002, 0.003);
  feeler::ClosestPoints<double> closest;
  closest.distance = 1e-5;
  closest.tool_point = {0, 0.005, 0.01 + 1e-5};
  closest.triangle_point = {0, 0.005, 0};
  closest.features.size = 2;
  closest.features.tool_vertices = {0, 1, 0};
  closest.features.corners = {0, 1, 0};
  Eigen::Matrix3d triangle;
  triangle << 0, 0, 1, -1, 1, 0, 0, 0, -1;
  const feeler::Capsule<double> capsule({{0, -0.02, 0.01 + 1e-5}, {0, 0.03, 0.01 + 1e-5}}, 0.01);
  const auto row = feeler::PatchRowMaker<feeler::Capsule<double>>(capsule, axes, reference, 1e-9).row_of_closest(closest, triangle);
  BOOST_TEST(row.tool_edge.isZero(0));
  BOOST_TEST((row.object_edge - Vector::UnitY()).norm() < 1e-15);
  BOOST_TEST(row.core_distance == 0.01 + 1e-5, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(curvature_of(row).allFinite());

  const feeler::RoundedBox<double> box(feeler::Box<double>(Vector(0.1, 0.1, 0.1)), 0.01);
  closest.tool_point = {0, 0.005, -0.1};
  closest.triangle_point = {0, 0.005, -0.11 - 1e-5};
  closest.features.size = 3;
  closest.features.tool_vertices = {0, 1, 2};
  closest.features.corners = {0, 0, 0};
  const auto on_face = feeler::PatchRowMaker<feeler::RoundedBox<double>>(box, axes, reference, 1e-9).row_of_closest(closest, triangle);
  BOOST_TEST((on_face.kind == feeler::FeaturePair::face_vertex));
  BOOST_TEST((on_face.arm - (closest.triangle_point - reference)).norm() < 1e-15);
  BOOST_TEST(on_face.core_distance == 0);
}

BOOST_AUTO_TEST_CASE(a_row_about_a_point_lasts_for_an_eightieth_of_its_distance_and_bends_no_more_than_half_of_the_radius_allows) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const double radius = 0.01;
  const feeler::Sphere<double> ball(radius);
  Eigen::Matrix3d triangle;
  triangle << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  feeler::ClosestPoints<double> closest;
  closest.features.size = 1;
  const auto row_at = [&](double gap) {
    closest.distance = gap;
    return feeler::PatchRowMaker<feeler::Sphere<double>>(ball, axes, Vector::Zero(), 1e-9).row_of_closest(closest, triangle);
  };
  const auto outlasts = [](const SweptContactRow<double>& row, double way) { return row.outlasts(way * feeler::Vector6<double>::Unit(0)); };
  for (const double gap : {1e-6, 1e-3}) {
    BOOST_TEST(outlasts(row_at(gap), 0.99 * (radius + gap) / 80));
    BOOST_TEST(!outlasts(row_at(gap), 1.01 * (radius + gap) / 80));
    // Beside the point the distance grows as a circle bends.
    BOOST_TEST(curvature_of(row_at(gap))(0, 0) == 1 / (radius + gap), boost::test_tools::tolerance(1e-9));
  }
  for (const double gap : {-0.6 * radius, -radius}) BOOST_TEST(curvature_of(row_at(gap))(0, 0) == 2 / radius, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_face_is_not_bent_by_the_radius) {
  SweptContactRow<double> row;
  row.normal = Vector(1, 2, 3).normalized();
  row.arm = Vector(0.1, -0.2, 0.3);
  const feeler::ContactRow<double>& sharp = row;
  BOOST_TEST((curvature_of(row) == curvature_of(sharp)));
  static_assert(std::is_same_v<feeler::ContactRowOf<feeler::Box<double>>, feeler::ContactRow<double>>);
}

BOOST_AUTO_TEST_CASE(rows_of_a_round_tool_predict_its_separation_to_third_order) {
  // Lone triangles: every feature is in its cone. The step is 1e-4 of the radius and of a radian.
  constexpr unsigned seed = 2;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const auto check = [&](const auto& make_tool, int count) {
    int kinds_seen[3] = {0, 0, 0};
    double worst = 0;
    for (int i = 0; i < count; ++i) {
      const auto tool = make_tool(bits);
      using Tool = std::remove_cvref_t<decltype(tool)>;
      const double gap = 1e-6 * fraction(bits);
      const Eigen::Matrix3d corners = triangle_near(tool, bits, Shape::ordinary, gap);
      const feeler::Points<double> vertices = corners.transpose();
      const feeler::TriangleMesh<double> mesh(vertices, feeler::Triangles{{0, 1, 2}});
      const auto closest = feeler::gjk(tool, corners, {}, 1e-8);
      const feeler::FeatureIncidence incidence = feeler::incidence_of(tool);
      feeler::VertexSet near(tool.vertex_count());
      feeler::ContactPatch<Tool, double> patch(tool, incidence, mesh, Eigen::Matrix3d::Identity(), Vector::Zero(), 1e-4, false, near);
      typename feeler::ContactPatch<Tool, double>::Rows rows;
      BOOST_TEST_REQUIRE(patch.find(0, corners, closest, true, rows));
      const auto row = *std::min_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
      BOOST_TEST(std::abs(row.gap - gap) <= 1e-9);
      ++kinds_seen[int(row.kind)];
      const double size = 1e-4 * tool.swept_radius();
      feeler::Vector6<double> step;
      step << size * random_direction(bits), size * random_direction(bits);
      const feeler::Pose<double> moved{step.head<3>(), feeler::exp_rotation<double>(step.tail<3>())};
      const Eigen::Matrix3d seen = moved.rotation.toRotationMatrix().transpose() * (corners.colwise() - moved.translation);
      const feeler::test::WideTool wide_tool(tool);
      const double separation = double(feeler::test::closest_features(wide_tool, wide(seen)).distance - wide_tool.radius);
      const double predicted = row.gap + row.gradient().dot(step) + step.dot(curvature_of(row) * step) / 2;
      // Another feature may take over within the step: its curvature is unlike by as much as the radius allows.
      worst = std::max(worst, std::abs(predicted - separation) / size);
    }
    BOOST_TEST_MESSAGE("vertex or edge " << kinds_seen[0] << ", face " << kinds_seen[1] << ", edges " << kinds_seen[2] << "; worst error per step "
                                         << worst);
    BOOST_TEST(worst <= 1e-7);  // without the curvature of points and lines 5e-5
  };
  check(random_sphere, 500);
  check(random_capsule, 500);
  check(random_rounded_box, 500);
}

BOOST_AUTO_TEST_SUITE_END()
