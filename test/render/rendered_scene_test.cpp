// What a renderer knows of its scene: bounds that hold for all points of the tool, and poses of two kinds.
#include "feeler/render/rendered_scene.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "feeler/tool/compound_tool.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(rendered_scene)

using namespace feeler_test;

using feeler::RenderedScene;
using Box = feeler::Box<double>;
using Hull = feeler::ConvexPolytope<double>;
using Compound = feeler::CompoundTool<Hull>;
using Pose = feeler::Pose<double>;
using Settings = feeler::Settings<double>;
using Twist = feeler::Twist<double>;

namespace {

const feeler::TriangleMesh<double>& some_triangle() {
  static const feeler::TriangleMesh<double> mesh(feeler::Points<double>{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, feeler::Triangles{{0, 1, 2}});
  return mesh;
}
Settings held_at(const Vector& reference) {
  Settings settings;
  settings.reference_point = reference;
  return settings;
}
Compound random_pieces(std::mt19937& bits, int count) {
  std::vector<Hull> pieces;
  for (int i = 0; i < count; ++i) {
    const Hull hull = random_hull(bits, 8);
    const Vector place = 0.3 * random_vector(bits);
    feeler::Points<double> points(hull.vertex_count(), 3);
    for (int v = 0; v < hull.vertex_count(); ++v) points.row(v) = (hull.vertex(v) + place).transpose();
    pieces.push_back(Hull::hull_of(points));
  }
  return Compound(pieces);
}
Pose random_pose(std::mt19937& bits) { return {random_vector(bits), random_rotation(bits)}; }

}  // namespace

BOOST_AUTO_TEST_CASE(no_point_of_a_piece_or_of_a_group_is_farther_from_the_reference_point_than_its_motion_says) {
  std::mt19937 bits(1);
  for (int round = 0; round < 30; ++round) {
    const Compound tool = random_pieces(bits, 2 + below(bits, 7));
    const Vector reference = random_vector(bits);
    const RenderedScene<Compound> scene(some_triangle(), tool, held_at(reference));
    const Pose at = random_pose(bits);
    double farthest = 0;
    for (int i = 0; i < scene.piece_count(); ++i) {
      double radius = 0;
      for (int v = 0; v < tool.piece(i).vertex_count(); ++v) radius = std::max(radius, (tool.piece(i).vertex(v) - reference).norm());
      BOOST_TEST(scene.moving(i, at, Twist{}).radius() == radius, boost::test_tools::tolerance(1e-14));
      farthest = std::max(farthest, radius);
    }
    BOOST_TEST(scene.radius() == farthest, boost::test_tools::tolerance(1e-14));
    for (const auto& group : scene.piece_groups()) {
      // The corners of the box, and so all that is in it, by where the motion has them.
      const auto moving = scene.moving(group, at, Twist{});
      BOOST_TEST((moving.tool().half_extents() == group.box.half_extents()));
      for (int v = 0; v < 8; ++v) {
        const Vector corner = group.centre + Vector(group.box.vertex(v));
        BOOST_TEST(moving.radius() >= (corner - reference).norm() - 1e-14);
        const Vector place = at.translation + at.rotation * (corner - reference);
        BOOST_TEST((moving.origin() + moving.to_world(group.box.vertex(v), moving.frame_at_start()) - place).norm() < 1e-14);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_motion_from_or_to_far_away_keeps_the_distance_that_its_numbers_are_rounded_to) {
  const Box tool(Vector::Constant(0.01));
  const RenderedScene<Box> scene(some_triangle(), tool, Settings());
  for (const double far : {1.0, 1e3, 1e6, 1e9}) {
    const double last_bit = std::nextafter(far, 2 * far) - far;
    for (const bool is_start_far : {true, false}) {
      const Twist motion{{is_start_far ? -far : far, 0, 0}, Vector::Zero()};
      const auto clearance = scene.clearance_for(scene.moving(0, {{is_start_far ? far : 0, 0, 0}, Eigen::Quaterniond::Identity()}, motion));
      BOOST_TEST(clearance.kept >= 4 * last_bit);
      BOOST_TEST(clearance.kept >= scene.clearance().kept);
      BOOST_TEST(clearance.kept <= scene.clearance().kept + 100 * last_bit);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_motion_has_led_to_its_target_whichever_of_its_two_quaternions_that_has) {
  std::mt19937 bits(2);
  const Box tool(Vector::Constant(0.01));
  const RenderedScene<Box> scene(some_triangle(), tool, Settings());
  for (int round = 0; round < 200; ++round) {
    Pose target = random_pose(bits);
    const Pose start{target.translation + 1e-3 * random_vector(bits),
                     Eigen::Quaterniond(Eigen::AngleAxisd(unit(bits), random_direction(bits))) * target.rotation};
    const Twist motion = motion_between(start, target);
    const Pose end = moved(start, motion);
    for (const double sign : {1.0, -1.0}) {
      target.rotation.coeffs() *= sign;
      BOOST_TEST(scene.has_led_to(target, end, scene.length_of(motion)));
      for (const double off : {1e-12, 1e-6, 1.0}) {
        const Vector aside = off * random_direction(bits);
        BOOST_TEST(!scene.has_led_to({target.translation + aside, target.rotation}, end, scene.length_of(motion)));
        BOOST_TEST(!scene.has_led_to({target.translation, Eigen::Quaterniond(Eigen::AngleAxisd(off, random_direction(bits))) * target.rotation}, end,
                                     scene.length_of(motion)));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_point_of_the_tool_is_where_the_pose_of_the_frame_and_that_of_the_reference_point_have_it) {
  std::mt19937 bits(3);
  for (int round = 0; round < 100; ++round) {
    const Vector reference = random_vector(bits), point = random_vector(bits);
    const RenderedScene<Box> scene(some_triangle(), Box(Vector::Constant(0.01)), held_at(reference));
    Pose frame = random_pose(bits);
    const Vector place = frame * point;
    const Pose held = scene.reference_pose({frame.translation, Eigen::Quaterniond(frame.rotation.coeffs() * magnitude(bits, -3, 3))});
    BOOST_TEST((held.translation - frame * reference).norm() < 1e-14);
    BOOST_TEST((scene.tool_pose(held) * point - place).norm() < 1e-14);
    const Eigen::Matrix3d corners = place.replicate<1, 3>();
    BOOST_TEST((scene.in_tool(corners, held, held.rotation.toRotationMatrix()).colwise() - point).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
