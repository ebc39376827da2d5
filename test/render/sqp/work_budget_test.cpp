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

BOOST_AUTO_TEST_CASE(an_iteration_is_begun_where_half_of_what_the_last_one_took_is_left) {
  WorkBudget budget;
  budget.begin_tick(100);
  budget.begin_iteration(0);
  BOOST_TEST(!budget.is_spent(66));
  BOOST_TEST(budget.is_spent(68));
  budget.begin_iteration(66);
  BOOST_TEST(!budget.is_spent(88));
  BOOST_TEST(budget.is_spent(90));
}

BOOST_AUTO_TEST_CASE(the_second_iteration_is_begun_where_any_work_is_left) {
  WorkBudget budget;
  budget.begin_tick(100);
  budget.begin_iteration(0);
  BOOST_TEST(budget.allows_another(66));
  BOOST_TEST(budget.allows_another(99));
  BOOST_TEST(!budget.allows_another(100));
  budget.begin_iteration(66);
  BOOST_TEST(budget.allows_another(88));
  BOOST_TEST(!budget.allows_another(90));
}

BOOST_AUTO_TEST_CASE(the_first_motion_of_a_tick_may_have_two_linearisations_and_half_a_budget_to_be_certified) {
  WorkBudget budget;
  budget.begin_tick(100);
  budget.begin_iteration(0);
  BOOST_TEST(!budget.ends_motion(250, 0));
  BOOST_TEST(!budget.ends_motion(250, 1));
  BOOST_TEST(budget.ends_motion(250, 2));
  BOOST_TEST(!budget.ends_motion(99, 3));
  BOOST_TEST(budget.limit_of_certificate(20) == 100);
  BOOST_TEST(budget.limit_of_certificate(250) == 300);
  budget.begin_iteration(50);
  BOOST_TEST(budget.ends_motion(100, 1));
  BOOST_TEST(budget.limit_of_certificate(100) == 112);
}

BOOST_AUTO_TEST_CASE(a_tool_that_starves_gets_half_as_much_again_from_the_third_tick_on_and_gives_it_back) {
  WorkBudget budget;
  const auto tick = [&](int work, bool has_moved) {
    budget.begin_tick(100);
    budget.begin_iteration(0);
    const bool is_spent = budget.is_spent(work);
    budget.end_tick(work, has_moved);
    return is_spent;
  };
  BOOST_TEST(tick(100, false));
  BOOST_TEST(tick(100, false));
  BOOST_TEST(tick(101, false));  // of 150
  BOOST_TEST(!tick(149, true));  // of 225
  BOOST_TEST(!tick(70, true));   // and now of 150 again
  BOOST_TEST(tick(101, true));
  for (int i = 0; i < 100; ++i) tick(100'000, false);
  BOOST_TEST(!tick(1130, false));  // at most 17 times as much
  BOOST_TEST(tick(1150, false));
  budget.reset();
  BOOST_TEST(tick(100, true));
}

BOOST_AUTO_TEST_CASE(a_small_budget_grows_by_an_iteration_at_least) {
  WorkBudget budget;
  for (const int allowed : {10, 10, 30, 50, 75}) {
    budget.begin_tick(10);
    budget.begin_iteration(0);
    BOOST_TEST(budget.allows_another(allowed - 1));
    BOOST_TEST(!budget.allows_another(allowed));
    budget.end_tick(allowed, false);
  }
}

BOOST_AUTO_TEST_CASE(a_tick_takes_little_more_work_than_its_budget) {
  const auto check = [](const auto& scene, const auto& tool, double most) {
    const TriangleMesh<double> object(scene.vertices, scene.triangles);
    for (const int allowed : {100, 200}) {
      BOOST_TEST_CONTEXT(scene.name << ", budget " << allowed) {
        auto settings = scene.settings();
        settings.work_budget = allowed;
        HapticRenderer renderer(object, tool, settings);
        BOOST_TEST((renderer.reset(scene.start) == Status::converged));
        int largest = 0, beyond = 0, moving = 0;
        const int ticks = ticks_to_run(3000);
        for (int i = 1; i <= ticks; ++i) {
          const auto& tick = renderer.update(scene.motion(i * 1e-3));
          largest = std::max(largest, tick.work);
          beyond += tick.work > allowed + allowed / 4;
          moving += !tick.path.empty();
        }
        BOOST_TEST_MESSAGE(scene.name << ", budget " << allowed << ": at most " << largest << ", " << beyond << " ticks of more than 5/4 of it");
        BOOST_TEST(largest <= most * allowed);
        BOOST_TEST(beyond <= ticks / 100);
        BOOST_TEST(moving > ticks * 9 / 10);
      }
    }
  };
  const auto terrain = scenes::terrain(71);
  check(terrain, std::get<ConvexPolytope<double>>(terrain.tool), 1.5);
  const auto sulcus = scenes::sulcus();
  std::visit([&](const auto& tool) { check(sulcus, tool, 1.5); }, sulcus.tool);
  const auto spline = scenes::spline(2e-5);  // nine pieces in a fit all around: a linearisation may take more than half of a hundred
  check(spline, CompoundTool<ConvexPolytope<double>>::hulls_of(spline.pieces), 8);
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
      const bool creeps = !tick.converged() && (tick.graphic_pose.translation - from.translation).norm() < 1e-6;
      creeping = creeps ? creeping + 1 : 0;
      longest = std::max(longest, creeping);
    }
    BOOST_TEST_MESSAGE("budget " << allowed << ": at most " << longest << " ticks in a row without a micrometre of the way left");
    BOOST_TEST(longest <= 4, "budget " << allowed << ": crept for " << longest << " ticks");
  }
}

BOOST_AUTO_TEST_SUITE_END()
