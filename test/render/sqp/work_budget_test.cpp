#include "feeler/render/sqp/work_budget.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>

#include "scenes/spline.hpp"
#include "scenes/sulcus.hpp"
#include "scenes/terrain.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(work_budget)

using namespace feeler;
using namespace feeler::test;

BOOST_AUTO_TEST_CASE(an_iteration_is_begun_where_half_of_what_the_last_one_took_is_left_and_the_second_where_any_is) {
  WorkBudget budget;
  budget.begin_tick(100);
  budget.begin_iteration(0);
  BOOST_TEST(budget.allows_another(99));
  BOOST_TEST(!budget.allows_another(100));
  budget.begin_iteration(66);
  BOOST_TEST(budget.allows_another(88));
  BOOST_TEST(!budget.allows_another(90));
}

BOOST_AUTO_TEST_CASE(a_step_is_solved_for_where_there_is_work_for_it) {
  WorkBudget budget;
  budget.begin_tick(100);
  BOOST_TEST(budget.limit() == 100);
  BOOST_TEST(budget.allows_step(89));
  BOOST_TEST(!budget.allows_step(90));
  BOOST_TEST(budget.allows_solve(96));
  BOOST_TEST(!budget.allows_solve(97));
  BOOST_TEST(!budget.is_spent(99));
  BOOST_TEST(budget.is_spent(100));
  budget.note_step(20);  // the next may take twice as much
  BOOST_TEST(budget.allows_step(59));
  BOOST_TEST(!budget.allows_step(60));
  budget.note_step(40);  // or half of a budget
  BOOST_TEST(budget.allows_step(49));
  BOOST_TEST(!budget.allows_step(50));
  budget.begin_tick(4);  // a tick that begins with one has work for it
  BOOST_TEST(budget.allows_step(0));
}

BOOST_AUTO_TEST_CASE(a_tick_takes_a_fifth_more_work_than_its_budget_at_most) {
  const auto check = [](const auto& scene, const auto& tool) {
    const TriangleMesh<double> object(scene.vertices, scene.triangles);
    for (const int allowed : {20, 100, 200}) {
      BOOST_TEST_CONTEXT(scene.name << ", budget " << allowed) {
        auto settings = scene.settings();
        settings.work_budget = allowed;
        HapticRenderer renderer(object, tool, settings);
        BOOST_TEST((renderer.reset(scene.start) == Status::converged));
        int largest = 0, moving = 0;
        const int ticks = ticks_to_run(3000);
        for (int i = 1; i <= ticks; ++i) {
          const auto& tick = renderer.update(scene.motion(i * 1e-3));
          largest = std::max(largest, tick.work);
          moving += !tick.path.empty();
        }
        BOOST_TEST_MESSAGE(scene.name << ", budget " << allowed << ": at most " << largest << ", moved in " << moving << " of " << ticks);
        BOOST_TEST(keeps_budget(largest, allowed));
        if (allowed >= 100) BOOST_TEST(moving > ticks * 9 / 10);
      }
    }
  };
  const auto terrain = scenes::terrain(71);
  check(terrain, std::get<ConvexPolytope<double>>(terrain.tool));
  const auto sulcus = scenes::sulcus();
  std::visit([&](const auto& tool) { check(sulcus, tool); }, sulcus.tool);
  const auto spline = scenes::spline(2e-5);  // nine pieces in a fit all around: a linearisation may take more than half of a hundred
  check(spline, CompoundTool<ConvexPolytope<double>>::hulls_of(spline.pieces));
}

BOOST_AUTO_TEST_CASE(a_tool_that_has_far_to_go_does_not_creep_however_little_work_a_tick_may_take) {
  const auto scene = scenes::terrain(224);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  for (const int allowed : {20, 25, 40}) {
    auto settings = scene.settings();
    settings.work_budget = allowed;
    HapticRenderer renderer(object, std::get<ConvexPolytope<double>>(scene.tool), settings);
    BOOST_TEST((renderer.reset(scene.start) == Status::converged));
    int creeping = 0, longest = 0;  // ticks in a row
    for (int i = 1; i <= ticks_to_run(15000); ++i) {
      const Pose<double> from = renderer.tick().graphic_pose;
      const auto& tick = renderer.update(scene.motion(i * 1e-4));
      const auto way = [&](const Pose<double>& to) { return (to.translation - from.translation).norm(); };
      bool creeps = !tick.converged() && way(tick.graphic_pose) < 1e-6;
      if (creeps) {  // unless there is nowhere to go
        auto held = renderer;
        for (int k = 0; k < 300 && !held.tick().converged(); ++k) held.update(scene.motion(i * 1e-4));
        creeps = way(held.tick().graphic_pose) > 2e-5;
      }
      creeping = creeps ? creeping + 1 : 0;
      longest = std::max(longest, creeping);
    }
    BOOST_TEST_MESSAGE("budget " << allowed << ": at most " << longest << " ticks in a row without a micrometre of the way left");
    BOOST_TEST(longest <= 4, "budget " << allowed << ": crept for " << longest << " ticks");
  }
}

BOOST_AUTO_TEST_CASE(a_copy_of_a_renderer_that_has_no_work_left_goes_on_as_the_renderer_does) {
  const auto scene = scenes::spline(2e-5);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  auto settings = scene.settings();
  settings.work_budget = 20;
  HapticRenderer renderer(object, CompoundTool<ConvexPolytope<double>>::hulls_of(scene.pieces), settings);
  BOOST_TEST((renderer.reset(scene.start) == Status::converged));
  auto copy = renderer;
  int unconverged = 0;
  const int ticks = ticks_to_run(2000);
  for (int i = 1; i <= ticks; ++i) {
    const Pose<double> hand = scene.motion(2.0 * i / ticks);
    if (!renderer.tick().converged()) {
      copy = renderer;
      ++unconverged;
    }
    const auto& tick = renderer.update(hand);
    copy.update(hand);
    BOOST_TEST(is_same(copy.tick().graphic_pose, tick.graphic_pose));
    BOOST_TEST(copy.tick().work == tick.work);
  }
  BOOST_TEST(unconverged > ticks / 20);
}

BOOST_AUTO_TEST_SUITE_END()
