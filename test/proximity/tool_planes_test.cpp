#include "feeler/proximity/tool_planes.hpp"

#include <boost/test/unit_test.hpp>

#include <random>

#include "support/random_motions.hpp"

BOOST_AUTO_TEST_SUITE(tool_planes)

using namespace feeler_test;
using feeler::test::WideReal;
using feeler::test::WideTool;
using feeler::test::WideVector;

namespace {
/// Planes of random tools, and triangles about a point just below them in the middle of a motion or so.
template <class MakeTool>
void check_parted(unsigned seed, const MakeTool& make_tool) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  constexpr double kept = 1e-7;
  int parted = 0, near = 0;
  for (int i = 0; i < 3000; ++i) {
    const RandomMotion<decltype(make_tool(bits))> random(bits, make_tool(bits));
    const auto moving = random.moving();
    const double swept = feeler::swept_radius(random.tool), until = i % 3 == 0 ? 1.0 : fraction(bits);
    const auto start = moving.frame_at(0), end = moving.frame_at(until);
    const Vector normal = i % 2 == 0 ? Vector(Vector::UnitZ()) : random_direction(bits);
    feeler::ToolPlanes<double> planes;
    planes.add(normal, moving, start, end, kept);
    const auto middle = moving.frame_at(until * fraction(bits));
    const double height = moving.lowest_in_tool(normal) - swept;
    const Vector across = random_vector(bits);
    const Vector below = (height - kept - magnitude(bits, -9, -2)) * normal + 0.5 * moving.radius() * (across - normal.dot(across) * normal);
    const Vector centre = middle.rotation * below + middle.shift;
    const Eigen::Matrix3d corners = (magnitude(bits, -6, -2) * random_triangle(bits, random_shape(bits))).colwise() + centre;
    if (planes.parting(corners) < 0) continue;
    ++parted;
    const WideTool tool(random.tool);
    for (int k = 0; k <= 100; ++k) {
      const auto pose = random.wide().pose_at(WideReal(until) * WideReal(k) / 100);
      const WideVector up = pose.rotation * normal.cast<WideReal>();
      const WideVector reference = pose.translation + pose.rotation * random.reference.template cast<WideReal>() - random.wide().start;
      WideReal lowest = std::numeric_limits<WideReal>::infinity();
      for (const WideVector& v : tool.vertices) lowest = std::min(lowest, up.dot(pose.translation + pose.rotation * v - random.wide().start));
      lowest -= tool.radius;
      for (int c = 0; c < 3; ++c) {
        const WideVector corner = corners.col(c).cast<WideReal>();
        if ((corner - reference).norm() > WideReal(moving.radius() + swept + kept)) continue;
        ++near;
        BOOST_TEST(lowest - up.dot(corner) >= WideReal(kept) - 1e-14L);
      }
    }
  }
  BOOST_TEST(parted > 300);
  BOOST_TEST(near > 10000);
}
}  // namespace

BOOST_AUTO_TEST_CASE(what_a_plane_parts_stays_below_it_on_the_whole_way_wherever_the_tool_may_come_near) {
  check_parted(11, random_box);
  check_parted(12, random_rounded_box);
}

BOOST_AUTO_TEST_CASE(a_face_that_turns_parts_what_a_plane_of_the_world_does_not) {
  // A box stands 2 µm above a floor and turns about its lower edge by 1 mrad: the face leaves no plane of the world below it, but what it turned from.
  const feeler::Box<double> box({0.01, 0.01, 0.01});
  const Vector reference(-0.01, 0, -0.01);  // in the edge
  feeler::Pose<double> pose;
  pose.translation = Vector(0, 0, 2e-6);
  const feeler::MovingTool<feeler::Box<double>> moving(box, reference, feeler::radius_about(box, reference), pose,
                                                       {Vector::Zero(), Vector(0, -1e-3, 0)});
  const auto start = moving.frame_at(0), end = moving.frame_at(1);
  feeler::ToolPlanes<double> planes;
  planes.add(Vector::UnitZ(), moving, start, end, 1e-7);
  Eigen::Matrix3d floor;
  floor << 0.001, 0.004, 0.002, 0, 0, 0.002, -2e-6, -2e-6, -2e-6;
  BOOST_TEST(planes.parting(floor) == 0);
  const Vector at_end = planes.normal_at_end(0);
  BOOST_TEST(moving.lowest(at_end, start) - 1e-7 < (at_end.transpose() * floor).maxCoeff());  // the plane at the end does not part them at the start
  Eigen::Matrix3d higher = floor;
  higher.row(2).array() += 2.5e-6;
  BOOST_TEST(planes.parting(higher) == -1);
}

BOOST_AUTO_TEST_CASE(planes_that_part_nothing_are_forgotten_and_each_is_lent_once_between) {
  const feeler::Box<double> box({0.01, 0.01, 0.01});
  const feeler::MovingTool<feeler::Box<double>> moving(box, Vector::Zero(), 0.02, {}, {Vector(0, 0, -1e-4), Vector::Zero()});
  const auto start = moving.frame_at(0), end = moving.frame_at(1);
  feeler::ToolPlanes<double> planes;
  planes.add(Vector::UnitZ(), moving, start, end, 1e-7);
  BOOST_TEST(planes.size() == 1);
  BOOST_TEST(!planes.lend(0));  // it is new
  planes.age();
  BOOST_TEST(planes.lend(0));
  BOOST_TEST(!planes.lend(0));
  for (int i = 0; i < 3; ++i) planes.age();
  BOOST_TEST(planes.size() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
