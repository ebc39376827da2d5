// A start inside and a search for the nearest free pose with every kind of tool, in float too, and after a change of settings or object.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <vector>

#include "feeler/render/free_pose_search.hpp"
#include "feeler/tool/sphere_swept.hpp"
#include "support/closed_meshes.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(free_pose_of_tools)

using namespace feeler;
using namespace feeler::test;
using feeler_test::block;
using feeler_test::ClosedMesh;

namespace {

const Vector3<double> half(0.05, 0.04, 0.03);  // of a block

template <class Scalar>
TriangleMesh<Scalar> mesh_of(const ClosedMesh& mesh) {
  return {mesh.vertices.cast<Scalar>(), mesh.triangles};
}

/// A tool deep in a block comes out of its nearest face, by as far as it reaches beyond that.
/// @param extents    of the tool along the axes of the block, whose middle is its origin [m]
/// @param tolerance  of the depth, for the margin [m]
template <class Tool>
void comes_out(const Tool& tool, const Vector3<double>& extents, double tolerance) {
  using Scalar = typename Tool::Scalar;
  const TriangleMesh<Scalar> object = mesh_of<Scalar>(block(-half, half));
  HapticRenderer<Tool> renderer(object, tool);
  for (const Vector3<double>& off : {Vector3<double>(0.01, 0.02, -0.01), Vector3<double>(-0.01, -0.02, 0.005)}) {
    const Pose<Scalar> pose{.translation = off.cast<Scalar>()};
    BOOST_TEST((renderer.reset(pose) == Status::inside));
    BOOST_TEST((renderer.update({.translation = {2, 0, 0}}).status == Status::not_reset));
    BOOST_TEST(renderer.tick().wrench.force.isZero(0));
    const auto found = nearest_free_pose(renderer, pose);
    BOOST_TEST_REQUIRE(found.is_found);
    BOOST_TEST((found.status == Status::inside));
    const double depth = (half - off.cwiseAbs() + extents).minCoeff();
    BOOST_TEST(double(found.depth) <= depth + tolerance);
    BOOST_TEST(double(found.depth) >= 0.9 * depth);
    BOOST_TEST((renderer.reset(found.pose) == Status::converged));
    const Vector3<double> way = (found.pose.translation - pose.translation).template cast<double>();
    BOOST_TEST(way.dot(off) > 0);  // outwards
    BOOST_TEST(!found.contacts.empty());
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_sphere_deep_in_a_solid_comes_out) { comes_out(Sphere<double>(0.005), Vector3<double>::Constant(0.005), 3e-6); }

BOOST_AUTO_TEST_CASE(a_capsule_deep_in_a_solid_comes_out) {
  comes_out(Capsule<double>({{-0.01, 0, 0}, {0.01, 0, 0}}, 0.003), {0.013, 0.003, 0.003}, 3e-6);
}

BOOST_AUTO_TEST_CASE(a_point_and_a_segment_deep_in_a_solid_come_out) {
  comes_out(Point<double>(), {0, 0, 0}, 3e-6);
  comes_out(Segment<double>({-0.01, 0, 0}, {0.01, 0, 0}), {0.01, 0, 0}, 3e-6);
}

BOOST_AUTO_TEST_CASE(a_compound_tool_deep_in_a_solid_comes_out_with_all_its_pieces) {
  const std::vector pieces{block({-0.01, -0.002, -0.002}, {0.01, 0.002, 0.002}).vertices,
                           block({-0.002, -0.002, -0.004}, {0.002, 0.002, 0.004}).vertices};
  comes_out(CompoundTool<ConvexPolytope<double>>::hulls_of(pieces), {0.01, 0.002, 0.004}, 3e-6);
}

BOOST_AUTO_TEST_CASE(a_box_of_float_deep_in_a_solid_comes_out) {
  comes_out(Box<float>(Vector3<float>::Constant(0.005f)), Vector3<double>::Constant(0.005), 2e-5);
}

BOOST_AUTO_TEST_CASE(with_other_settings_the_last_graphic_pose_is_taken_and_the_margin_comes_with_the_ticks) {
  const TriangleMesh<double> object = mesh_of<double>(block(-half, half));
  const Box<double> tool(Vector3<double>::Constant(0.005));
  HapticRenderer<Box<double>> before(object, tool);
  const Pose<double> hand{.translation = {0.01, 0.005, 0.033}};
  BOOST_TEST((before.reset({.translation = {0.01, 0.005, 0.05}}) == Status::converged));
  for (int i = 0; i < 50; ++i) before.update(hand);
  const Pose<double> last = before.tick().graphic_pose;
  for (const double margin : {1e-7, 1e-5, 1e-4}) {
    Settings<double> settings;
    settings.margin = margin;
    settings.stiffness = Stiffness<double>::uniform(500, 0.1);
    HapticRenderer<Box<double>> after(object, tool, settings);
    BOOST_TEST((after.reset(last) == Status::converged));
    for (int i = 0; i < 50; ++i) after.update(hand);
    BOOST_TEST(after.tick().converged());
    BOOST_TEST(std::abs(after.tick().graphic_pose.translation.z() - 0.035 - margin) < 1e-9, after.tick().graphic_pose.translation.z());
    BOOST_TEST(after.tick().wrench.force.z() == 500 * (0.002 + margin), boost::test_tools::tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(an_object_that_grew_into_the_tool_lifts_it_by_the_overlap) {
  const TriangleMesh<double> small_block = mesh_of<double>(block(-half, half));
  const TriangleMesh<double> large_block = mesh_of<double>(block(-half, half + Vector3<double>(0, 0, 0.001)));
  const Box<double> tool(Vector3<double>::Constant(0.005));
  HapticRenderer<Box<double>> before(small_block, tool), after(large_block, tool);
  const Pose<double> hand{.translation = {0.01, 0.005, 0.033}};
  BOOST_TEST((before.reset({.translation = {0.01, 0.005, 0.05}}) == Status::converged));
  for (int i = 0; i < 50; ++i) before.update(hand);
  const Pose<double> last = before.tick().graphic_pose;
  BOOST_TEST((after.reset(last) == Status::penetrating));
  const auto found = nearest_free_pose(after, last);
  BOOST_TEST(found.is_found);
  BOOST_TEST(std::abs(found.depth - 0.001) <= 3e-6);
  BOOST_TEST(after.update(hand).wrench.force.z() > 0);
}

BOOST_AUTO_TEST_SUITE_END()
