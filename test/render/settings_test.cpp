// Settings that are refused, and those at the ends of what is taken.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>

#include "feeler/recognition/contact_recogniser.hpp"
#include "feeler/render/wrench_derivative.hpp"
#include "scenes/motions.hpp"
#include "support/refusal.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(settings_of_a_renderer)

using namespace feeler;
using namespace feeler::test;
using feeler_test::contains;
using feeler_test::refusal;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();
const Box<double> cube(Vector3<double>::Constant(0.01));
const SphereSwept<Point<double>> ball(Point<double>(), 0.01);

/// Corners of a square of ±side in the plane x = 0, moved along x.
template <class Scalar>
Points<Scalar> wall_at(Scalar x, Scalar side = Scalar(1)) {
  Points<Scalar> vertices(4, 3);
  vertices << x, -side, -side, x, side, -side, x, side, side, x, -side, side;
  return vertices;
}
const Triangles wall_triangles{{0, 1, 2}, {0, 2, 3}};

template <class Tool>
std::string refusal_of(const Tool& tool, const std::function<void(Settings<double>&)>& change) {
  const TriangleMesh<double> object(wall_at(0.0), wall_triangles);
  Settings<double> settings;
  change(settings);
  return refusal([&] { HapticRenderer(object, tool, settings); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_no_length_or_no_count_is_refused_by_name) {
  using Length = double Settings<double>::*;
  for (const auto& [name, field] : {std::pair<const char*, Length>{"margin", &Settings<double>::margin},
                                    {"trust_radius", &Settings<double>::trust_radius},
                                    {"step_tolerance", &Settings<double>::step_tolerance}}) {
    const Length length = field;
    for (const double bad : {not_a_number, -infinity, -1e-6, -0.0, 0.0})
      BOOST_TEST(contains(refusal_of(cube, [&](auto& settings) { settings.*length = bad; }), name), name << " = " << bad);
  }
  for (const int bad : {0, -1, std::numeric_limits<int>::min()}) {
    BOOST_TEST(contains(refusal_of(cube, [&](auto& settings) { settings.maximum_iterations = bad; }), "maximum_iterations"));
    BOOST_TEST(contains(refusal_of(cube, [&](auto& settings) { settings.work_budget = bad; }), "work_budget"));
  }
  for (const int bad : {100'000'001, std::numeric_limits<int>::max()})
    BOOST_TEST(contains(refusal_of(cube, [&](auto& settings) { settings.work_budget = bad; }), "work_budget"));
  BOOST_TEST(refusal_of(cube, [](auto& settings) { settings.maximum_iterations = settings.work_budget = 1; }) == "accepted");
}

BOOST_AUTO_TEST_CASE(a_margin_that_rounding_can_cross_is_refused) {
  const auto with_margin = [](double margin) { return refusal_of(cube, [&](auto& settings) { settings.margin = margin; }); };
  BOOST_TEST(contains(with_margin(0.99e-10), "not a length of 1e-10 to 0.001 m"));
  BOOST_TEST(contains(with_margin(0.99e-10), "leave the default of 1 µm"));
  for (const double large : {1.01e-3, 1e6, infinity}) BOOST_TEST(contains(with_margin(large), "more is felt as a cushion"));
  BOOST_TEST(with_margin(1.01e-10) == "accepted");
  BOOST_TEST(with_margin(1e-3) == "accepted");
  // Rounding grows with the object.
  const TriangleMesh<double> country(wall_at(0.0, 1e6), wall_triangles);
  Settings<double> settings;
  BOOST_TEST(contains(refusal([&] { HapticRenderer(country, cube, settings); }), "margin"));
  BOOST_TEST(!contains(refusal([&] { HapticRenderer(country, cube, settings); }), "leave the default"));
  settings.margin = 1e-5;
  BOOST_TEST(refusal([&] { HapticRenderer(country, cube, settings); }) == "accepted");
}

BOOST_AUTO_TEST_CASE(lengths_with_which_the_tool_would_stay_where_it_is_or_never_converge_are_refused) {
  const auto with = [](double Settings<double>::* length, double value) {
    return refusal_of(cube, [&](auto& settings) { settings.*length = value; });
  };
  for (const double bad : {1e-300, 1e-13, 1.1e-3, 1e300, infinity})
    BOOST_TEST(contains(with(&Settings<double>::step_tolerance, bad), "step_tolerance"), bad);
  for (const double bad : {1e-300, 1e-12, 0.9e-6, 1.01, 1e300, infinity})
    BOOST_TEST(contains(with(&Settings<double>::trust_radius, bad), "trust_radius"), bad);
  for (const double good : {1e-12, 1e-10, 1e-3}) BOOST_TEST(with(&Settings<double>::step_tolerance, good) == "accepted");
  for (const double good : {1e-6, 1.0}) BOOST_TEST(with(&Settings<double>::trust_radius, good) == "accepted");
}

BOOST_AUTO_TEST_CASE(ticks_at_each_end_of_what_is_taken_leave_the_tool_outside_and_follow_in_free_air) {
  const auto with = [](auto field, auto value) { return [=](Settings<double>& settings) { settings.*field = value; }; };
  using Change = std::function<void(Settings<double>&)>;
  for (const auto& [name, change] :
       {std::pair<const char*, Change>{"trust_radius 1e-6", with(&Settings<double>::trust_radius, 1e-6)},
        {"trust_radius 1", with(&Settings<double>::trust_radius, 1.0)},
        {"step_tolerance 1e-12", with(&Settings<double>::step_tolerance, 1e-12)},
        {"step_tolerance 1e-3", with(&Settings<double>::step_tolerance, 1e-3)},
        {"maximum_iterations 1", with(&Settings<double>::maximum_iterations, 1)},
        {"maximum_iterations of any number", with(&Settings<double>::maximum_iterations, std::numeric_limits<int>::max())},
        {"work_budget 1", with(&Settings<double>::work_budget, 1)},
        {"work_budget 1e8", with(&Settings<double>::work_budget, 100'000'000)}}) {
    BOOST_TEST_CONTEXT(name) {
      const TriangleMesh<double> object(wall_at(0.0), wall_triangles);
      const Witness witness(wall_at(0.0), wall_triangles, cube);
      Settings<double> settings;
      change(settings);
      HapticRenderer renderer(object, cube, settings);
      BOOST_TEST_REQUIRE((renderer.reset({{0.013, 0, 0}, Quaternion<double>::Identity()}) == Status::converged));
      double deepest = 0;
      const auto go = [&](const Vector3<double>& hand, const Vector3<double>& turn) {
        const auto& tick = renderer.update({hand, exp_rotation<double>(turn)});
        deepest = std::max(deepest, witness.depth_at(tick.graphic_pose));
        BOOST_TEST(is_valid(tick, 2));
      };
      for (int i = 0; i < 100; ++i) go({0.013 - 1e-4 * i, 0, 0}, {0, 0, 0});            // a press of 7 mm
      for (int i = 0; i < 100; ++i) go({0.003, 1e-4 * i, 0}, {0.002 * i, 0.004 * i, 0});  // a slide with a turn
      for (int i = 0; i < 50; ++i) go({-0.5, 0.3, 0}, {0, 0, 3});                       // thrown through the wall
      for (int i = 0; i < 50; ++i) go({0.5, 0.3, 0}, {1, 2, 0});                        // and back
      BOOST_TEST(deepest <= touching_depth);
      // Out of reach of the wall, a way of 2 mm.
      BOOST_TEST_REQUIRE((renderer.reset({{0.2, 0, 0}, Quaternion<double>::Identity()}) == Status::converged));
      const Pose<double> hand{{0.201, -0.001, 0.0015}, exp_rotation<double>({0.01, 0.02, 0})};
      int ticks = 0;
      while (!renderer.update(hand).converged() && ticks < 5000) ++ticks;
      BOOST_TEST(ticks < 5000);
      BOOST_TEST(pose_error(renderer.tick().graphic_pose, hand).at(0.02) <= settings.step_tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(scenes_that_are_too_large_or_too_far_off_are_refused_and_told_how_large_and_how_far) {
  const TriangleMesh<double> object(wall_at(0.0), wall_triangles);
  for (const double half : {1e10, 1e200, 1e308}) {
    const std::string sentence = refusal([&] { HapticRenderer(object, Box<double>({half, 1, 1})); });
    BOOST_TEST(contains(sentence, "m across, and rounding could carry the tool through a surface whatever the margin"), sentence);
    BOOST_TEST(!contains(sentence, "-9"));
    BOOST_TEST(!contains(sentence, "inf"));
  }
  Settings<double> lever;
  lever.reference_point.x() = 1e200;
  BOOST_TEST(contains(refusal([&] { HapticRenderer(object, cube, lever); }), "m across, and rounding"));

  const auto off = [](auto distance) {
    using Scalar = decltype(distance);
    const TriangleMesh<Scalar> far(wall_at(distance), wall_triangles);
    return refusal([&] { HapticRenderer(far, Box<Scalar>(Vector3<Scalar>::Constant(Scalar(0.01)))); });
  };
  BOOST_TEST(contains(
      off(1e6f), "the object reaches 1e+06 m from the origin, where poses are rounded to 0.0596 m; move the scene to the origin, or use double"));
  BOOST_TEST(contains(off(1e10), "move the scene to the origin, or give a larger margin"));
  BOOST_TEST(off(1e13).ends_with("move the scene to the origin"));  // no margin is large enough
  Settings<float> beside;
  beside.reference_point.x() = 1e5F;
  BOOST_TEST(
      contains(refusal([&] {
                 const TriangleMesh<float> wall(wall_at(0.0F), wall_triangles);
                 HapticRenderer(wall, Box<float>({0.01F, 0.01F, 0.01F}), beside);
               }),
               "its reference point so far from the origin of its frame, that poses are rounded to 0.0596 m; give a reference point on the tool"));
  BOOST_TEST(off(1e3f) == "accepted");
  BOOST_TEST(off(1e8) == "accepted");
}

BOOST_AUTO_TEST_CASE(weights_whose_wrench_overflows_or_of_which_rounding_leaves_nothing_are_refused) {
  const auto with = [](const Vector3<double>& translational, const Vector3<double>& rotational, bool is_metric = false) {
    return refusal_of(cube, [&](auto& settings) {
      if (is_metric) settings.metric = Metric<double>{translational, rotational};
      else settings.stiffness = {translational, rotational};
    });
  };
  const Vector3<double> ones = Vector3<double>::Ones();
  BOOST_TEST(contains(with(1e300 * ones, ones), "whose wrench would overflow"));
  BOOST_TEST(contains(with(ones, 1e160 * ones), "whose wrench would overflow"));
  BOOST_TEST(contains(with(1e150 * ones, 1e-200 * ones), "Settings::stiffness has weights that differ"));  // the ratio underflows
  BOOST_TEST(contains(with(5e-324 * ones, ones), "Settings::stiffness has weights that differ"));          // or overflows
  BOOST_TEST(contains(with({1, 1, 1e20}, ones), "Settings::stiffness has weights that differ"));
  BOOST_TEST(contains(with(ones, {1e20, 1, 1}), "Settings::stiffness has weights that differ"));
  BOOST_TEST(contains(with({1, 1e20, 1}, ones, true), "Settings::metric has weights that differ"));
  BOOST_TEST(contains(with({0, 1, 1}, ones), "has a zero"));
  BOOST_TEST(with(1e20 * ones, ones) == "accepted");
  BOOST_TEST(with({1, 1e14, 1}, ones) == "accepted");
  const TriangleMesh<float> narrow(wall_at(0.0f), wall_triangles);
  Settings<float> stiff;
  stiff.stiffness = Stiffness<float>::uniform(1e30f, 1e30f);
  BOOST_TEST(contains(refusal([&] { HapticRenderer(narrow, Box<float>({1, 1, 1}), stiff); }), "whose wrench would overflow"));
  BOOST_TEST(refusal_of(ball, [](auto& settings) { settings.stiffness.rotational = {1e100, 0, 1e-300}; }) == "accepted");
}

BOOST_AUTO_TEST_CASE(what_is_referred_to_must_outlive_who_refers_to_it) {
  using Mesh = TriangleMesh<double>;
  using Renderer = HapticRenderer<Box<double>>;
  using Recogniser = ContactRecogniser<Box<double>>;
  using Surface = SurfaceFeatures<double>;
  static_assert(std::is_constructible_v<Renderer, const Mesh&, const Box<double>&> && std::is_constructible_v<Renderer, Mesh&, const Box<double>&>);
  static_assert(!std::is_constructible_v<Renderer, Mesh, const Box<double>&> && !std::is_constructible_v<Renderer, const Mesh, const Box<double>&>);
  static_assert(!std::is_constructible_v<Renderer, const Mesh, const Box<double>&, const Settings<double>&>);
  using Scene = RenderedScene<Box<double>>;
  static_assert(std::is_constructible_v<Scene, Mesh&, const Box<double>&, const Settings<double>&>);
  static_assert(!std::is_constructible_v<Scene, Mesh, const Box<double>&, const Settings<double>&>);
  static_assert(std::is_constructible_v<Recogniser, const Mesh&, const Surface&, const Box<double>&>);
  static_assert(!std::is_constructible_v<Recogniser, const Mesh, const Surface&, const Box<double>&>);
  static_assert(!std::is_constructible_v<Recogniser, const Mesh&, const Surface, const Box<double>&, double>);
}

BOOST_AUTO_TEST_CASE(a_reference_point_or_a_weight_that_is_not_finite_is_refused) {
  for (const double bad : {not_a_number, infinity, -infinity, -1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (bad != -1.0) BOOST_TEST(contains(refusal_of(cube, [&](auto& settings) { settings.reference_point[axis] = bad; }), "reference_point"));
      BOOST_TEST(contains(refusal_of(cube, [&](auto& settings) { settings.stiffness.translational[axis] = bad; }), "stiffness"));
      BOOST_TEST(contains(refusal_of(cube, [&](auto& settings) { settings.stiffness.rotational[axis] = bad; }), "stiffness"));
      BOOST_TEST(contains(refusal_of(cube, [&](auto& settings) { settings.metric.emplace().translational[axis] = bad; }), "metric"));
      BOOST_TEST(contains(refusal_of(cube, [&](auto& settings) { settings.metric.emplace().rotational[axis] = bad; }), "metric"));
    }
  }
}

BOOST_AUTO_TEST_CASE(no_stiffness_needs_a_metric_which_moves_the_tool_without_a_force) {
  const auto without_torque = [](Settings<double>& settings) { settings.stiffness.rotational.setZero(); };
  const auto without_force = [](Settings<double>& settings) { settings.stiffness.translational.z() = 0; };
  BOOST_TEST(contains(refusal_of(cube, without_torque), "metric"));
  BOOST_TEST(contains(refusal_of(cube, without_force), "metric"));
  BOOST_TEST(contains(refusal_of(ball, without_force), "metric"));
  BOOST_TEST(contains(refusal_of(cube, [](auto& settings) { settings.metric = Metric<double>::with_length(0); }), "metric"));

  const TriangleMesh<double> object(wall_at(0.0), wall_triangles);
  Settings<double> settings;
  settings.stiffness = Stiffness<double>::uniform(0, 0);
  settings.metric = Metric<double>::with_length(0.02);
  HapticRenderer renderer(object, cube, settings);
  BOOST_TEST_REQUIRE((renderer.reset({{0.02, 0, 0}, Quaternion<double>::Identity()}) == Status::converged));
  const auto& tick = renderer.update({{-0.005, 0.01, 0}, Quaternion<double>::Identity()});
  BOOST_TEST(std::abs(tick.graphic_pose.translation.x() - 0.01) <= 2e-6);
  BOOST_TEST(std::abs(tick.graphic_pose.translation.y() - 0.01) <= 1e-12);
  BOOST_TEST(tick.wrench.force.isZero(0));
  BOOST_TEST(tick.wrench.torque.isZero(0));
}

BOOST_AUTO_TEST_CASE(a_sphere_needs_no_weight_of_turns) {
  // Devices that push no torque give none.
  const TriangleMesh<double> object(wall_at(0.0), wall_triangles);
  Settings<double> settings;
  settings.stiffness = Stiffness<double>::uniform(1000, 0);
  HapticRenderer renderer(object, ball, settings), weighing(object, ball);
  for (auto* r : {&renderer, &weighing}) BOOST_TEST_REQUIRE((r->reset({{0.03, 0, 0}, Quaternion<double>::Identity()}) == Status::converged));
  for (int i = 0; i < 50; ++i) {
    const Pose<double> haptic{{0.02 * std::cos(0.2 * i), 0.001 * i, 0}, rotation_by({0.1 * i, 0, 0.05 * i}).cast<double>()};
    BOOST_TEST(pose_error(renderer.update(haptic).graphic_pose, weighing.update(haptic).graphic_pose).at(0) <= 1e-12);
    BOOST_TEST(renderer.tick().wrench.torque.isZero(0));
    BOOST_TEST(wrench_derivative(renderer).matrix.topLeftCorner(3, 3).isApprox(wrench_derivative(weighing).matrix.topLeftCorner(3, 3)));
  }
}

BOOST_AUTO_TEST_CASE(weights_of_any_ratio_leave_the_tool_outside) {
  const TriangleMesh<double> object(wall_at(0.0), wall_triangles);
  const Witness witness(wall_at(0.0), wall_triangles, cube);
  for (const double rotational : {1e-15, 1e-9, 1e-3, 1e3, 1e9}) {
    for (const Vector3<double>& translational : {Vector3<double>(1000, 1000, 1000), Vector3<double>(1e-6, 1, 1e6), Vector3<double>(1e6, 1, 1e-6)}) {
      Settings<double> settings;
      settings.stiffness = {translational, {rotational, 2 * rotational, 100 * rotational}};
      HapticRenderer renderer(object, cube, settings);
      BOOST_TEST_REQUIRE((renderer.reset({{0.03, 0, 0}, Quaternion<double>::Identity()}) == Status::converged));
      const int ticks = ticks_to_run(500);
      int converged = 0;
      double deepest = 0;
      for (int i = 0; i < ticks; ++i) {
        const double t = i * 4e-3;
        const WideVector turn(std::sin(t), 0.7 * std::cos(2 * t), 0.5 * std::sin(3 * t));
        const auto& tick =
            renderer.update({{0.012 * std::cos(7 * t), 0.02 * std::sin(3 * t), 0.02 * std::sin(5 * t)}, rotation_by(turn).cast<double>()});
        converged += tick.converged();
        deepest = std::max(deepest, witness.depth_at(tick.graphic_pose));
      }
      BOOST_TEST(deepest <= touching_depth, "rotational " << rotational);
      BOOST_TEST(converged >= ticks * 9 / 10,
                 converged << " of " << ticks << ", rotational " << rotational << ", translational " << translational.transpose());
    }
  }
}

BOOST_AUTO_TEST_CASE(of_a_metric_the_ratios_alone_matter) {
  const TriangleMesh<double> object(wall_at(0.0), wall_triangles);
  const auto last_tick = [&](int exponent) {
    Settings<double> settings;
    const double unit = std::ldexp(1.0, exponent);
    settings.stiffness = Stiffness<double>::uniform(1024, 0.25);
    settings.metric = Metric<double>{Vector3<double>::Constant(unit), Vector3<double>::Constant(unit / 4096)};
    HapticRenderer renderer(object, cube, settings);
    renderer.reset({{0.03, 0, 0}, Quaternion<double>::Identity()});
    for (int i = 0; i < 50; ++i) renderer.update({{0.02 - 0.0005 * i, 0.001 * i, 0}, rotation_by({0.004 * i, 0.01 * i, 0.002 * i}).cast<double>()});
    return renderer.tick();
  };
  const auto expected = last_tick(0);
  for (const int exponent : {-1060, -500, -10, 10, 500, 1000}) {
    const auto tick = last_tick(exponent);
    BOOST_TEST(tick.graphic_pose.translation == expected.graphic_pose.translation, "2^" << exponent);
    Vector3<double> sum = Vector3<double>::Zero();
    for (const auto& contact : tick.contacts) sum += contact.force * contact.normal_world;
    BOOST_TEST((sum - tick.wrench.force).norm() < 1e-2 * tick.wrench.force.norm(), "2^" << exponent);
  }
}

BOOST_AUTO_TEST_CASE(poses_of_float_are_as_far_from_the_object_as_their_rounding_asks) {
  const Box<float> tool(Vector3<float>::Constant(0.01f));
  for (const float margin : {1e-6f, 1e-7f}) {
    for (const float x : {0.0f, 0.3f, 1.0f, 3.0f, 10.0f, 100.0f}) {
      const TriangleMesh<float> object(wall_at(x), wall_triangles);
      const Witness witness(wall_at(double(x)), wall_triangles, tool.cast<double>());
      Settings<float> settings;
      settings.margin = margin;
      settings.reference_point = {0.005f, 0, 0};
      HapticRenderer renderer(object, tool, settings);
      BOOST_TEST_REQUIRE((renderer.reset({{x + 0.03f, 0, 0}, Quaternion<float>::Identity()}) == Status::converged));
      scenes::RandomBits random(5);
      double deepest = 0, nearest = 1;
      for (int i = 0; i < ticks_to_run(1000); ++i) {
        const auto symmetric = [&] { return float(2 * random.unit() - 1); };
        const Pose<float> haptic{{x - 0.01f * symmetric(), 0.2f * symmetric(), 0.2f * symmetric()},
                                 Quaternion<float>(1, 0.3f * symmetric(), 0.3f * symmetric(), 0.3f * symmetric()).normalized()};
        const auto& tick = renderer.update(haptic);
        deepest = std::max(deepest, witness.depth_at(tick.graphic_pose));
        for (const auto& contact : tick.contacts) nearest = std::min(nearest, double(contact.gap));
      }
      BOOST_TEST(deepest <= touching_depth, deepest << " m at " << x << " m, margin " << margin);
      BOOST_TEST(nearest <= std::max(2.0 * margin, 1.5e-6 * (1 + x)));  // and no farther than that
    }
  }
}

BOOST_AUTO_TEST_CASE(a_tool_comes_to_rest_at_every_margin_that_is_taken) {
  const TriangleMesh<double> object(wall_at(0.0), wall_triangles);
  const Box<double> tool({0.01, 0.006, 0.004});
  for (const double margin : {1e-9, 1e-7, 1e-6, 1e-5, 3e-5, 1e-4, 1e-3}) {
    Settings<double> settings;
    settings.margin = margin;
    HapticRenderer renderer(object, tool, settings);
    BOOST_TEST_REQUIRE((renderer.reset({{0.03, 0, 0}, Quaternion<double>::Identity()}) == Status::converged));
    const Pose<double> hand{{-0.005, 0.002, 0.01}, exp_rotation<double>({0.3, 2, 0.1})};
    for (int i = 0; i < 50; ++i) renderer.update(hand);
    const auto& tick = renderer.update(hand);
    BOOST_TEST(tick.converged());
    double nearest = 1;
    for (int k = 0; k < 8; ++k) nearest = std::min(nearest, (tick.graphic_pose * tool.vertex(k)).x());
    BOOST_TEST(std::abs(nearest - margin) < 1e-10, "at " << nearest << " m, not at the margin of " << margin);
  }
}

BOOST_AUTO_TEST_SUITE_END()
