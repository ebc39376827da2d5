#include "feeler/render/free_pose_search.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <random>

#include "feeler/object/mesh_assembly.hpp"
#include "fuzz/laws/prismatic_fits.hpp"
#include "scenes/cavity.hpp"
#include "scenes/terrain.hpp"
#include "support/allocation_count.hpp"
#include "support/closed_meshes.hpp"
#include "support/random_geometry.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(free_pose_search)

using namespace feeler;
using namespace feeler::test;
using feeler_test::ball;
using feeler_test::block;
using feeler_test::ClosedMesh;
using feeler_test::random_direction;

namespace {

constexpr double margin = 1e-6;

/// A mesh, a tool and the renderer of the two.
template <class Tool>
struct Scene {
  TriangleMesh<double> object;
  HapticRenderer<Tool> renderer;

  Scene(const ClosedMesh& mesh, const Tool& tool, const Settings<double>& settings = {})
      : object(mesh.vertices, mesh.triangles), renderer(object, tool, settings) {}
};

Box<double> cube(double half) { return Box<double>(Vector3<double>::Constant(half)); }

/// Counts how many of its directions are asked for.
struct CountedHull : ConvexPolytope<double> {
  explicit CountedHull(const ConvexPolytope<double>& hull) : ConvexPolytope<double>(hull) {}
  inline static long directions = 0;

  Vector3<double> face_axis(int i) const noexcept { return ++directions, ConvexPolytope<double>::face_axis(i); }
  Vector3<double> edge_direction(int i) const noexcept { return ++directions, ConvexPolytope<double>::edge_direction(i); }
};

/// A square of n × n squares at height 0, 1 m wide.
ClosedMesh ground(int n) {
  ClosedMesh mesh{Points<double>((n + 1) * (n + 1), 3), Triangles(2 * n * n, 3)};
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const int row = i * (n + 1) + j;
      mesh.vertices.row(row) << double(i) / n - 0.5, double(j) / n - 0.5, 0;
      if (i == n || j == n) continue;
      mesh.triangles.row(2 * (i * n + j)) << row, row + n + 1, row + n + 2;
      mesh.triangles.row(2 * (i * n + j) + 1) << row, row + n + 2, row + 1;
    }
  }
  return mesh;
}

/// The longest way of a tool point between two poses [m].
template <class Tool>
double longest_way(const Tool& tool, const Pose<double>& from, const Pose<double>& to) {
  double longest = 0;
  for (int i = 0; i < piece_count(tool); ++i)
    for (int v = 0; v < piece_of(tool, i).vertex_count(); ++v) {
      const Vector3<double> vertex = piece_of(tool, i).vertex(v);
      longest = std::max(longest, (to * vertex - from * vertex).norm());
    }
  return longest;
}

/// A peg of 3 to 8 sides in its hole.
laws::LawScene<ConvexPolytope<double>> peg_of_few_sides(std::mt19937& bits) {
  laws::Section section;
  do section = laws::random_section(bits);
  while (section.size() > 8);
  return laws::peg_in_hole(bits, "peg", section);
}

/// Starts that are caught in a fit, and how far they are off the middle of it, which is free.
struct CaughtStarts {
  int count = 0, farther = 0;

  /// From 10 nm to a millimetre off.
  template <class Tool>
  void check(std::mt19937& bits, const laws::LawScene<Tool>& fit) {
    laws::Surface placed = fit.surface;
    for (auto& vertex : placed.vertices) vertex = fit.placed * vertex;
    Scene scene({laws::points_of(placed), laws::rows_of(placed)}, fit.tool, fit.settings);
    if (scene.renderer.reset(fit.placed) != Status::converged) return;
    const CheckedObject walls(laws::points_of(placed), laws::rows_of(placed));
    const double off = feeler_test::magnitude(bits, -8, -3), turn = off / laws::radius_of(fit.tool);
    const Vector3<double> way = off * random_direction(bits), turned = turn * random_direction(bits);
    const Pose<double> asked = laws::compose(fit.placed, {way, exp_rotation<double>(turned)});
    const auto found = nearest_free_pose(scene.renderer, asked);
    if (found.status == Status::converged) return;
    ++count;
    BOOST_TEST_CONTEXT(fit.family << ' ' << count << ", play " << fit.play << ", off " << off) {
      BOOST_TEST_REQUIRE(found.is_found);
      BOOST_TEST(deepest_penetration(walls, checked_pieces(fit.tool), checked_pose(found.pose)).depth <= no_clearance_depth);
      farther += found.depth > 2 * longest_way(fit.tool, asked, fit.placed) + 4 * fit.settings.margin;
      BOOST_TEST(std::abs(found.depth - longest_way(fit.tool, asked, found.pose)) <= 1e-12);
    }
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_free_pose_is_its_own_nearest) {
  Scene scene(ground(1), cube(0.01));
  const Pose<double> pose{{0.1, 0, 0.02}, Quaternion<double>(2, 0, 0, 0)};
  const auto found = nearest_free_pose(scene.renderer, pose);
  BOOST_TEST(found.is_found);
  BOOST_TEST((found.status == Status::converged));
  BOOST_TEST(is_same(found.pose, pose.normalized()));
  BOOST_TEST(found.depth == 0);
  BOOST_TEST(found.contacts.empty());
  BOOST_TEST(scene.renderer.update(pose).converged());
}

BOOST_AUTO_TEST_CASE(a_box_in_the_ground_comes_up_by_its_depth_on_coarse_ground_and_on_fine) {
  for (const int n : {1, 7, 200}) {
    for (const double depth : {1e-7, 1e-4, 0.003, 0.009}) {
      BOOST_TEST_CONTEXT(n << " squares, " << depth << " m deep") {
        Scene scene(ground(n), cube(0.01));
        const Pose<double> pose{{0.0123, 0.0217, 0.01 - depth}, Quaternion<double>::Identity()};
        const auto found = nearest_free_pose(scene.renderer, pose);
        BOOST_TEST(found.is_found);
        BOOST_TEST((found.status == Status::penetrating));
        BOOST_TEST(std::abs(found.depth - depth) <= 3 * margin);
        BOOST_TEST((found.pose.translation - pose.translation - Vector3<double>(0, 0, depth)).norm() <= 3 * margin);
        BOOST_TEST_REQUIRE(!found.contacts.empty());
        for (const auto& contact : found.contacts) {
          BOOST_TEST(std::abs(contact.point_world.z()) <= 3 * margin);
          BOOST_TEST(contact.normal_world.z() > 0.999999);
        }
        // The renderer goes on from there.
        BOOST_TEST((scene.renderer.tick().status == Status::converged));
        BOOST_TEST(scene.renderer.tick().wrench.force.isZero(0));
        BOOST_TEST(is_same(scene.renderer.tick().graphic_pose, found.pose));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_tool_deep_in_a_solid_comes_out_of_the_nearest_face) {
  std::mt19937 bits(21);
  const Vector3<double> half(0.05, 0.04, 0.03);
  for (int i = 0; i < ticks_to_run(40); ++i) {
    const auto rotation = feeler_test::random_rotation(bits);
    Scene scene(block(-half, half).moved(rotation, {0.1, 0.2, 0.3}), cube(0.005));
    const Vector3<double> off = half.cwiseProduct(0.8 * feeler_test::random_vector(bits));
    const Pose<double> pose{Vector3<double>(0.1, 0.2, 0.3) + rotation * off, rotation};
    const auto found = nearest_free_pose(scene.renderer, pose);
    const double depth = (half - off.cwiseAbs()).minCoeff() + 0.005;
    BOOST_TEST(found.is_found);
    BOOST_TEST(found.depth <= depth + 3 * margin);
    BOOST_TEST(found.depth >= 0.9 * depth);  // a turn helps nothing, or little
    BOOST_TEST((found.status == Status::inside || found.status == Status::penetrating));
  }
}

BOOST_AUTO_TEST_CASE(a_tool_swapped_for_a_thicker_one_rises_by_the_difference) {
  const ClosedMesh mesh = ground(9);
  Scene thin(mesh, cube(0.01)), thick(mesh, cube(0.012));
  BOOST_TEST((thin.renderer.reset({.translation = {0, 0, 0.03}}) == Status::converged));
  const Pose<double> hand{.translation = {0.0, 0.01, 0.004}};
  for (int i = 0; i < 60; ++i) thin.renderer.update(hand);
  const Pose<double> last = thin.renderer.tick().graphic_pose;
  BOOST_TEST((thick.renderer.reset(last) == Status::penetrating));
  const auto found = nearest_free_pose(thick.renderer, last);
  BOOST_TEST(found.is_found);
  BOOST_TEST(std::abs(found.depth - 0.002) <= 3 * margin);
  // At the next tick the hand is pushed from there, on the same side.
  BOOST_TEST(thick.renderer.update(hand).wrench.force.z() > 5);
}

BOOST_AUTO_TEST_CASE(a_tool_that_is_caught_in_a_tight_fit_stays_in_it) {
  // A cube of 20 mm in a room of 20 µm play on all sides, shifted and turned by more than that.
  auto setting = scenes::cavity(2e-5);
  std::mt19937 bits(22);
  for (int i = 0; i < ticks_to_run(20); ++i) {
    Scene scene({setting.vertices, setting.triangles}, std::get<Box<double>>(setting.tool), setting.settings());
    const Pose<double> pose =
        scenes::pose_of(0.01 * feeler_test::random_vector(bits), Vector3<double>(1e-3, 1e-4, 1e-3).cwiseProduct(feeler_test::random_vector(bits)));
    const auto found = nearest_free_pose(scene.renderer, pose);
    BOOST_TEST(found.is_found);
    BOOST_TEST(found.depth < 5e-4);
  }
}

BOOST_AUTO_TEST_CASE(a_tool_that_is_caught_in_a_random_fit_goes_hardly_farther_than_its_middle_is) {
  std::mt19937 bits(24);
  CaughtStarts starts;
  for (int i = 0; i < ticks_to_run(60); ++i) {
    starts.check(bits, peg_of_few_sides(bits));
    starts.check(bits, laws::angle_in_hole(bits));
    starts.check(bits, laws::boxes_in_slot(bits));
  }
  BOOST_TEST(starts.count > (runs_all_ticks ? 80 : 3));
  BOOST_TEST(starts.farther <= starts.count / 30);  // of walls in many pieces, where the search is cut short
}

BOOST_AUTO_TEST_CASE(in_a_fit_without_play_a_smaller_trust_radius_may_refuse_the_last_pose_and_finds_one_next_to_it) {
  std::mt19937 bits(26);
  int refused = 0;
  for (int i = 0; i < ticks_to_run(400); ++i) {
    const auto fit = peg_of_few_sides(bits);
    if (fit.play > 0) continue;
    laws::Surface placed = fit.surface;
    for (auto& vertex : placed.vertices) vertex = fit.placed * vertex;
    const ClosedMesh mesh{laws::points_of(placed), laws::rows_of(placed)};
    Settings<double> settings;
    Scene usual(mesh, fit.tool, settings);
    if (usual.renderer.reset(fit.placed) != Status::converged) continue;
    for (int k = 0; k < 100; ++k) {
      const Vector3<double> way = 0.01 * feeler_test::random_vector(bits), turned = 0.3 * random_direction(bits);
      usual.renderer.update(laws::compose(fit.placed, {way, exp_rotation<double>(turned)}));
    }
    const Pose<double> last = usual.renderer.tick().graphic_pose;
    settings.trust_radius = 3e-6;
    Scene finer(mesh, fit.tool, settings);
    refused += finer.renderer.reset(last) == Status::penetrating;
    const auto found = nearest_free_pose(finer.renderer, last);
    BOOST_TEST_REQUIRE(found.is_found);
    BOOST_TEST(found.depth <= 1e-9);
  }
  BOOST_TEST(refused > (runs_all_ticks ? 0 : -1));
}

BOOST_AUTO_TEST_CASE(what_is_found_in_random_soups_is_free_and_no_farther_than_the_checker_says) {
  std::mt19937 bits(23);
  int freed = 0;
  for (int i = 0; i < ticks_to_run(60); ++i) {
    const int triangles = 1 + feeler_test::below(bits, 40);
    ClosedMesh soup{Points<double>(3 * triangles, 3), Triangles(triangles, 3)};
    for (int t = 0; t < triangles; ++t) {
      const Vector3<double> middle = 0.05 * feeler_test::random_vector(bits);
      for (int k = 0; k < 3; ++k) soup.vertices.row(3 * t + k) = (middle + 0.03 * feeler_test::random_vector(bits)).transpose();
      soup.triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    }
    const Box<double> tool({0.01, 0.006, 0.02});
    Scene scene(soup, tool);
    const Witness witness(soup.vertices, soup.triangles, tool);
    const Pose<double> pose{0.04 * feeler_test::random_vector(bits), feeler_test::random_rotation(bits)};
    const auto found = nearest_free_pose(scene.renderer, pose);
    BOOST_TEST_REQUIRE(found.is_found);
    BOOST_TEST(witness.depth_at(found.pose) <= no_clearance_depth);
    if (found.status == Status::converged) continue;
    ++freed;
    // Farther than out of the one triangle that it is deepest in; of one alone, as far as that, or a turn
    // less.
    const double depth = witness.depth_at(pose);
    if (triangles == 1) BOOST_TEST(found.depth <= depth + 3 * margin);
    // No nearer pose is hit by chance.
    for (int k = 0; k < 300; ++k) {
      const Pose<double> near{pose.translation + 0.7 * found.depth * feeler_test::random_direction(bits), pose.rotation};
      BOOST_TEST((witness.depth_at(near) > 0), "soup " << i << ": a free pose at 0.7 of " << found.depth);
    }
  }
  BOOST_TEST(freed > (runs_all_ticks ? 20 : 1));
}

BOOST_AUTO_TEST_CASE(out_of_rough_ground_a_pebble_comes_up) {
  const auto scene = scenes::terrain(71);
  const auto& tool = std::get<ConvexPolytope<double>>(scene.tool);
  Scene pebble({scene.vertices, scene.triangles}, tool, scene.settings());
  const Witness witness(scene.vertices, scene.triangles, tool);
  for (const double height : {0.0075, 0.005, 0.003}) {
    const auto found = nearest_free_pose(pebble.renderer, {.translation = {0.02, 0.01, height}});
    BOOST_TEST(found.is_found);
    BOOST_TEST(witness.depth_at(found.pose) <= no_clearance_depth);
    BOOST_TEST(found.pose.translation.z() > height);
    BOOST_TEST(found.depth < 0.015 - height);
  }
}

BOOST_AUTO_TEST_CASE(a_compound_tool_comes_free_with_all_its_pieces) {
  const std::array pieces{block({-0.02, -0.005, 0}, {0.02, 0.005, 0.01}).vertices, block({-0.005, -0.005, -0.03}, {0.005, 0.005, 0}).vertices};
  Scene scene(ground(20), CompoundTool<ConvexPolytope<double>>::hulls_of(pieces));
  const auto found = nearest_free_pose(scene.renderer, {.translation = {0.003, 0.001, 0.028}});
  BOOST_TEST(found.is_found);
  BOOST_TEST(std::abs(found.depth - 0.002) <= 3 * margin);
  BOOST_TEST_REQUIRE(!found.contacts.empty());
  BOOST_TEST(found.contacts[0].piece == 1);
}

BOOST_AUTO_TEST_CASE(out_of_an_overlap_a_hull_of_a_thousand_points_tries_some_of_its_directions) {
  std::mt19937 bits(31);
  Points<double> points(1000, 3);
  for (int i = 0; i < points.rows(); ++i) points.row(i) = 0.02 * random_direction(bits).transpose();
  Scene scene(ball(0.05, 10), CountedHull(ConvexPolytope<double>::hull_of(points)));
  CountedHull::directions = 0;
  const auto found = nearest_free_pose(scene.renderer, {.translation = {0.03, 0.02, 0.01}});
  BOOST_TEST((found.status == Status::penetrating));
  BOOST_TEST_REQUIRE(found.is_found);
  const double depth = 0.07 - Vector3<double>(0.03, 0.02, 0.01).norm();
  BOOST_TEST(found.depth > 0.9 * depth);
  BOOST_TEST(found.depth < 1.15 * depth);
  BOOST_TEST(CountedHull::directions < 1'100'000);
}

BOOST_AUTO_TEST_CASE(where_nothing_is_free_within_the_bound_it_says_so) {
  Scene scene(block(Vector3<double>::Constant(-0.05), Vector3<double>::Constant(0.05)), cube(0.005));
  const Pose<double> pose{.translation = {0.03, 0, 0}};
  const auto none = nearest_free_pose(scene.renderer, pose, 0.02);
  BOOST_TEST(!none.is_found);
  BOOST_TEST((none.status == Status::inside));
  BOOST_TEST(is_same(none.pose, pose));
  BOOST_TEST((scene.renderer.update(pose).status == Status::not_reset));
  BOOST_TEST(nearest_free_pose(scene.renderer, pose, 0.0251).is_found);
  BOOST_TEST(nearest_free_pose(scene.renderer, pose).is_found);

  const double nan = std::nan("");
  BOOST_TEST(!nearest_free_pose(scene.renderer, pose, nan).is_found);
  const auto no_pose = nearest_free_pose(scene.renderer, {.translation = {nan, 0, 0}});
  BOOST_TEST(!no_pose.is_found);
  BOOST_TEST((no_pose.status == Status::not_finite));
  BOOST_TEST(no_pose.pose.is_finite());
}

BOOST_AUTO_TEST_CASE(where_none_is_found_the_renderer_holds_no_pose) {
  for (const double farthest : {1e-4, 1e-9, 0.0, -1.0}) {
    Scene scene(ground(1), Sphere<double>(0.002));
    const Pose<double> pose{.translation = {0, 0, 0.0005}};
    BOOST_TEST(!nearest_free_pose(scene.renderer, pose, farthest).is_found);
    BOOST_TEST((scene.renderer.update(pose).status == Status::not_reset));
    BOOST_TEST(scene.renderer.tick().wrench.force.isZero(0));
  }
}

BOOST_AUTO_TEST_CASE(what_is_free_straight_up_within_the_bound_is_found_whatever_the_metric_prefers) {
  std::mt19937 bits(25);
  const auto check = [&](const auto& tool, double round) {
    const Pose<double> pose{0.01 * feeler_test::random_vector(bits), feeler_test::random_rotation(bits)};
    double depth = round - pose.translation.z();
    for (int v = 0; v < tool.vertex_count(); ++v) depth = std::max(depth, round - (pose * Vector3<double>(tool.vertex(v))).z());
    Settings<double> settings;
    if (feeler_test::below(bits, 2) == 0) settings.reference_point = 0.15 * feeler_test::random_vector(bits);
    Scene scene(ground(1), tool, settings);
    const double farthest = depth * (1 + feeler_test::magnitude(bits, -3, 0)) + 4 * margin;
    const auto found = nearest_free_pose(scene.renderer, pose, farthest);
    if (found.status == Status::converged) return;
    BOOST_TEST_CONTEXT("reference point " << settings.reference_point.transpose() << ", up " << depth << ", farthest " << farthest) {
      BOOST_TEST_REQUIRE(found.is_found);
      BOOST_TEST(found.depth <= farthest);
      BOOST_TEST(longest_way(tool, pose, found.pose) <= farthest);
      const double side = (found.pose * Vector3<double>(tool.vertex(0))).z() < 0 ? -1 : 1;
      for (int v = 0; v < tool.vertex_count(); ++v) BOOST_TEST(side * (found.pose * Vector3<double>(tool.vertex(v))).z() >= round);
    }
  };
  for (int i = 0; i < ticks_to_run(60); ++i) {
    check(Box<double>(Vector3<double>(0.02, 0.02, 0.02) + 0.015 * feeler_test::random_vector(bits)), 0);
    check(Capsule<double>({{0, 0, -0.03}, {0, 0, 0.03}}, 0.005), 0.005);
    Points<double> points(12, 3);
    for (int k = 0; k < points.rows(); ++k) points.row(k) = 0.03 * feeler_test::random_vector(bits).transpose();
    check(ConvexPolytope<double>::hull_of(points), 0);
  }
}

#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE(a_search_allocates_nothing) {
  Scene scene(ball(0.05, 8), cube(0.005));
  bool is_found = false;
  BOOST_TEST(feeler_test::allocations_during([&] { is_found = nearest_free_pose(scene.renderer, {.translation = {0.03, 0, 0.01}}).is_found; }) == 0);
  BOOST_TEST(is_found);
}
#endif

BOOST_AUTO_TEST_SUITE_END()
