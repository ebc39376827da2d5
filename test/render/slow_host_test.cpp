// Hosts that ask seldom: between two frames of 1/60 s a hand goes farther than one tick follows.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scenes/terrain.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(slow_host)

using namespace feeler;
using namespace feeler::test;

namespace {

using Renderer = HapticRenderer<ConvexPolytope<double>>;

/// How far a tool is from where it comes to rest with the hand held still [m].
double distance_to_rest(Renderer renderer, const Pose<double>& haptic) {
  const Vector3<double> here = renderer.tick().graphic_pose.translation;
  for (int i = 0; i < 400 && !(renderer.update(haptic).converged() && renderer.tick().path.empty()); ++i) {}
  return (renderer.tick().graphic_pose.translation - here).norm();
}

struct Lag {
  double most = 0;  // [m]
  int most_work = 0;  // of a frame
  int frames = 0;
  int converged = 0;
};

/// The lag over frames of a rate [1/s], each of one call of `follow`.
template <class Follow>
Lag lag_of(Renderer& renderer, const scenes::Scene& scene, double rate, const Follow& follow) {
  Lag lag;
  renderer.reset(scene.start);
  for (int k = 1; k <= ticks_to_run(int(3 * rate)); ++k) {
    const Pose<double> haptic = scene.motion(k / rate);
    const auto& tick = follow(haptic);
    lag.converged += tick.converged() ? 1 : 0;
    lag.most_work = std::max(lag.most_work, tick.work);
    lag.most = std::max(lag.most, distance_to_rest(renderer, haptic));
    ++lag.frames;
  }
  return lag;
}

}  // namespace

BOOST_AUTO_TEST_CASE(at_60_frames_a_second_one_tick_a_frame_leaves_the_tool_behind_and_ticks_until_converged_do_not) {
  const auto scene = scenes::terrain(224);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  const auto make = [&](const Settings<double>& settings) { return Renderer(object, std::get<ConvexPolytope<double>>(scene.tool), settings); };
  const auto say = [](const char* how, const Lag& lag) {
    BOOST_TEST_MESSAGE(how << ": at most " << 1e3 * lag.most << " mm behind, work " << lag.most_work << " a frame, " << lag.converged << " of "
                           << lag.frames << " frames converged");
  };
  Renderer renderer = make(scene.settings());
  const Lag one = lag_of(renderer, scene, 60, [&](const auto& haptic) -> auto& { return renderer.update(haptic); });
  const Lag many = lag_of(renderer, scene, 60, [&](const auto& haptic) -> auto& { return renderer.update_until_converged(haptic, 1500); });
  auto settings = scene.settings();
  settings.work_budget = 1500;
  Renderer with_more = make(settings);
  const Lag more = lag_of(with_more, scene, 60, [&](const auto& haptic) -> auto& { return with_more.update(haptic); });
  say("one update", one);
  say("one update with a budget of 1500", more);
  say("update_until_converged with 1500", many);
  if (runs_all_ticks) BOOST_TEST(one.most > 5e-3);
  BOOST_TEST(many.most < 1e-5);
  BOOST_TEST(many.converged == many.frames);
}

BOOST_AUTO_TEST_CASE(it_does_what_as_many_updates_do_and_ends_within_one_update_of_its_work) {
  const auto scene = scenes::terrain(71);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  auto settings = scene.settings();
  settings.work_budget = 92;
  Renderer renderer(object, std::get<ConvexPolytope<double>>(scene.tool), settings), other = renderer;
  renderer.reset(scene.start);
  other.reset(scene.start);
  const int budget = renderer.settings().work_budget;
  int stopped = 0, settled = 0;
  for (int k = 1; k <= 40; ++k) {
    const Pose<double> haptic = scene.motion(k / 25.0);
    const int most_work = k % 8 * 100;
    int work = 0, iterations = 0, last = 0;
    do {
      last = other.update(haptic).work;
      work += last;
      iterations += other.tick().iterations;
    } while (!other.tick().converged() && work + budget <= most_work);
    const auto& tick = renderer.update_until_converged(haptic, most_work);
    BOOST_TEST(is_same(tick.graphic_pose, other.tick().graphic_pose));
    BOOST_TEST((tick.status == other.tick().status && tick.path.size() == other.tick().path.size()));
    BOOST_TEST(tick.work == work);
    BOOST_TEST(tick.iterations == iterations);
    BOOST_TEST(work - last <= std::max(most_work - budget, 0));
    stopped += tick.status == Status::unconverged && work > 2 * last ? 1 : 0;
    settled += tick.converged() && work > last ? 1 : 0;
  }
  BOOST_TEST(stopped > 0);
  BOOST_TEST(settled > 0);
}

BOOST_AUTO_TEST_CASE(whatever_the_work_it_may_take_it_is_one_update_at_least_and_no_sum_overflows) {
  const auto scene = scenes::terrain(22);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  for (const int budget : {20, 128, 100'000'000}) {
    auto settings = scene.settings();
    settings.work_budget = budget;
    Renderer renderer(object, std::get<ConvexPolytope<double>>(scene.tool), settings), other = renderer;
    renderer.reset(scene.start);
    other.reset(scene.start);
    for (const int most_work : {std::numeric_limits<int>::min(), -1, 0}) {
      const Pose<double> haptic = scene.motion(0.01);
      const int work = other.update(haptic).work;
      BOOST_TEST(renderer.update_until_converged(haptic, most_work).work == work);
    }
    BOOST_TEST(renderer.update_until_converged(scene.motion(0.04), std::numeric_limits<int>::max()).converged());
  }
}

BOOST_AUTO_TEST_CASE(without_a_pose_to_go_on_from_or_to_it_is_one_update) {
  const auto scene = scenes::terrain(22);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  Renderer renderer(object, std::get<ConvexPolytope<double>>(scene.tool), scene.settings());
  BOOST_TEST((renderer.update_until_converged(scene.start, 1500).status == Status::not_reset));
  renderer.reset(scene.start);
  const Pose<double> none{Vector3<double>::Constant(std::nan("")), Quaternion<double>::Identity()};
  BOOST_TEST((renderer.update_until_converged(none, 1500).status == Status::not_finite));
  BOOST_TEST(is_same(renderer.tick().graphic_pose, scene.start.normalized()));
}

BOOST_AUTO_TEST_SUITE_END()
