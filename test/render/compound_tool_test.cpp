// Tools of several convex pieces: the same as a convex one where their union is, and a splined shaft in its hole.
#include "feeler/tool/compound_tool.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scenes/cavity.hpp"
#include "scenes/rod.hpp"
#include "scenes/spline.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(compound_tools)

using namespace feeler;
using namespace feeler::test;

namespace {

using Hull = ConvexPolytope<double>;
using Compound = CompoundTool<Hull>;

Points<double> cuboid(const Vector3<double>& low, const Vector3<double>& high) {
  Points<double> points(8, 3);
  for (int i = 0; i < 8; ++i) {
    points.row(i) << ((i & 1) != 0 ? high : low).x(), ((i & 2) != 0 ? high : low).y(), ((i & 4) != 0 ? high : low).z();
  }
  return points;
}

/// The cube of the cavity, cut into eight unequal cuboids.
Compound cut_cube(double half) {
  std::vector<Points<double>> sets;
  const Vector3<double> cut(0.3 * half, -0.2 * half, 0.1 * half);
  for (int i = 0; i < 8; ++i) {
    Vector3<double> low = Vector3<double>::Constant(-half), high = cut;
    for (int k = 0; k < 3; ++k) {
      if ((i >> k & 1) == 0) continue;
      low[k] = cut[k];
      high[k] = half;
    }
    sets.push_back(cuboid(low, high));
  }
  return Compound::hulls_of(sets);
}

/// A hull that counts how often it is asked for a vertex.
class Counted : public Hull {
 public:
  inline static thread_local long calls = 0;

  explicit Counted(Hull hull) : Hull(std::move(hull)) {}
  int support(const Vector3<double>& direction) const noexcept {
    ++calls;
    return Hull::support(direction);
  }
};
static_assert(ConvexTool<Counted>);

struct PiecewiseWitness {
  std::vector<Witness> pieces;

  PiecewiseWitness(const scenes::Setting& scene, const Compound& tool) {
    for (int i = 0; i < tool.piece_count(); ++i) pieces.emplace_back(scene.vertices, scene.triangles, tool.piece(i));
  }
  double depth_on_way(const Pose<double>& from, const Tick<double>& tick, int samples) const {
    double deepest = 0;
    for (const Witness& piece : pieces) deepest = std::max(deepest, piece.depth_on_way(from, tick, samples));
    return deepest;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(one_piece_is_rendered_bit_by_bit_like_the_convex_tool) {
  const auto scene = scenes::cavity(1e-3);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  const Hull cube = Hull::hull_of(cuboid(Vector3<double>::Constant(-0.01), Vector3<double>::Constant(0.01)));
  HapticRenderer convex(object, cube, scene.settings());
  HapticRenderer compound(object, Compound({cube}), scene.settings());
  BOOST_TEST((convex.reset(scene.start) == Status::converged));
  BOOST_TEST((compound.reset(scene.start) == Status::converged));
  bool is_equal = true;
  for (int i = 1; i <= ticks_to_run(1500); ++i) {
    const Pose<double> haptic = scene.motion(i * 1e-3);
    is_equal = is_equal && is_same(convex.update(haptic).graphic_pose, compound.update(haptic).graphic_pose);
  }
  BOOST_TEST(is_equal);
}

BOOST_AUTO_TEST_CASE(a_cube_cut_into_eight_pieces_is_rendered_like_the_whole_one) {
  for (const double clearance : {1e-3, 1e-4}) {
    BOOST_TEST_CONTEXT("clearance " << clearance) {
      const auto scene = scenes::cavity(clearance);
      const TriangleMesh<double> object(scene.vertices, scene.triangles);
      const Compound pieces = cut_cube(0.01);
      HapticRenderer whole(object, Box<double>(Vector3<double>::Constant(0.01)), scene.settings());
      HapticRenderer cut(object, pieces, scene.settings());
      const PiecewiseWitness witness(scene, pieces);
      BOOST_TEST((whole.reset(scene.start) == Status::converged));
      BOOST_TEST((cut.reset(scene.start) == Status::converged));
      double farthest = 0, deepest = 0;
      int converged = 0, in_other_pieces = 0;
      const int ticks = ticks_to_run(1500);
      for (int i = 1; i <= ticks; ++i) {
        const Pose<double> haptic = scene.motion(i * 1e-3), before = cut.tick().graphic_pose;
        const auto& tick = cut.update(haptic);
        BOOST_TEST(is_valid(tick, object.triangle_count()));
        converged += tick.converged() ? 1 : 0;
        for (const auto& contact : tick.contacts) in_other_pieces += contact.piece > 0 ? 1 : 0;
        farthest = std::max(farthest, pose_error(whole.update(haptic).graphic_pose, tick.graphic_pose).at(0.02));
        if (i % 10 == 0) deepest = std::max(deepest, witness.depth_on_way(before, tick, 2));
      }
      BOOST_TEST(farthest < 2e-6);  // both keep a margin of 1 µm
      BOOST_TEST(deepest <= touching_depth);
      BOOST_TEST(converged > 0.99 * ticks);
      BOOST_TEST(in_other_pieces > 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rod_cut_into_sixty_four_is_rendered_like_the_whole_one_and_its_far_pieces_are_left_alone) {
  const auto scene = scenes::rod(22, 64);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  const auto rod_of = [](const scenes::CompoundScene& cut) {
    std::vector<Counted> pieces;
    for (const Points<double>& corners : cut.pieces) pieces.emplace_back(Hull::hull_of(corners));
    return CompoundTool<Counted>(std::move(pieces));
  };
  HapticRenderer whole(object, rod_of(scenes::rod(22, 1)), scene.settings());
  HapticRenderer cut(object, rod_of(scene), scene.settings());
  BOOST_TEST((whole.reset(scene.start) == Status::converged));
  BOOST_TEST((cut.reset(scene.start) == Status::converged));
  double farthest = 0;
  long calls_of_whole = 0, calls_of_cut = 0;
  int converged = 0, touching = 0;
  constexpr int ticks = 1000;
  for (int i = 1; i <= ticks; ++i) {
    const Pose<double> haptic = scene.motion(2e-3 * i);
    Counted::calls = 0;
    const Pose<double> expected = whole.update(haptic).graphic_pose;
    calls_of_whole += Counted::calls;
    Counted::calls = 0;
    const auto& tick = cut.update(haptic);
    calls_of_cut += Counted::calls;
    BOOST_TEST(is_valid(tick, object.triangle_count()));
    touching += tick.contacts.empty() ? 0 : 1;
    if (!whole.tick().converged() || !tick.converged()) continue;
    ++converged;
    farthest = std::max(farthest, pose_error(expected, tick.graphic_pose).at(0.06));
  }
  BOOST_TEST_MESSAGE("support calls: " << calls_of_whole << " of the whole, " << calls_of_cut << " of the pieces; " << farthest << " m apart");
  BOOST_TEST(farthest < 2e-6);
  BOOST_TEST(converged > 0.98 * ticks);
  BOOST_TEST(touching > ticks / 2);
  BOOST_TEST(calls_of_cut < 2 * calls_of_whole);  // each piece by itself: 27 times as many
}

BOOST_AUTO_TEST_CASE(a_splined_shaft_slides_along_its_axis_like_the_device_and_turns_by_its_play) {
  // A tooth of half width w and tip radius R turns until R sin φ + w cos φ = w + c, less the margin that is kept.
  const scenes::SplineProfile profile;
  for (const double clearance : {2e-4, 2e-5}) {
    BOOST_TEST_CONTEXT("clearance " << clearance) {
      const auto scene = scenes::spline(clearance);
      const TriangleMesh<double> object(scene.vertices, scene.triangles);
      const Compound shaft = Compound::hulls_of(scene.pieces);
      HapticRenderer renderer(object, shaft, scene.settings());
      BOOST_TEST((renderer.reset(scenes::pose_of(Vector3<double>::Zero(), {0, 0, 0.016})) == Status::converged));
      const double margin = renderer.settings().margin;
      double low = 0, high = 0.2;
      for (int i = 0; i < 60; ++i) {
        const double angle = (low + high) / 2;
        const double reach = profile.tip_radius * std::sin(angle) + profile.half_width * std::cos(angle);
        (reach < profile.half_width + clearance - margin ? low : high) = angle;
      }
      double off_axis = 0, off_play = 0;
      int late = 0;
      for (int i = 1; i <= 400; ++i) {
        const double z = 0.016 - 0.00002 * i, twist = i < 200 ? 0.0 : 0.001 * (i - 200);
        const auto& tick = renderer.update(scenes::pose_of({0, 0, twist}, {0, 0, z}));
        late += tick.converged() ? 0 : 1;
        if (tick.converged()) off_axis = std::max(off_axis, std::abs(tick.graphic_pose.translation.z() - z));
        const double angle = 2 * tick.graphic_pose.rotation.z();
        if (twist > 1.1 * low) off_play = std::max(off_play, std::abs(angle - low));
      }
      BOOST_TEST(off_axis < 1e-9);
      BOOST_TEST(late <= 1);  // where it first touches all around
      BOOST_TEST(off_play < 1e-5 * clearance / 2e-5);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_splined_shaft_never_penetrates_its_hole_and_hostile_devices_do_not_make_it) {
  for (const double clearance : {2e-4, 2e-5, 0.0}) {
    BOOST_TEST_CONTEXT("clearance " << clearance) {
      const auto scene = scenes::spline(clearance);
      const TriangleMesh<double> object(scene.vertices, scene.triangles);
      const Compound shaft = Compound::hulls_of(scene.pieces);
      const PiecewiseWitness witness(scene, shaft);
      for (const bool is_hostile : {false, true}) {
        const auto motion = is_hostile ? scenes::hostile(scene.motion, 4) : scene.motion;
        HapticRenderer renderer(object, shaft, scene.settings());
        BOOST_TEST((renderer.reset(scene.start) == Status::converged));
        double deepest = 0;
        for (int i = 1; i <= ticks_to_run(300); ++i) {
          const Pose<double> before = renderer.tick().graphic_pose;
          const auto& tick = renderer.update(motion(i * 2e-3));
          BOOST_TEST(is_valid(tick, object.triangle_count()));
          if (i % 6 == 0) deepest = std::max(deepest, witness.depth_on_way(before, tick, 2));
        }
        BOOST_TEST(deepest <= (clearance > 0 ? touching_depth : no_clearance_depth));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
