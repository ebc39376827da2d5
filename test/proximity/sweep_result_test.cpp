#include "feeler/proximity/sweep_result.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <initializer_list>
#include <random>
#include <vector>

#include "feeler/tool/box.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(sweep_result)

using namespace feeler_test;
using Result = feeler::SweepResult<double>;
using Box = feeler::Box<double>;

namespace {
Result with_blockers(std::initializer_list<double> times) {
  Result result;
  for (const double time : times) {
    result.add({.triangle = result.blockers.size(), .time = time});
    result.time = std::min(result.time, time);
  }
  return result;
}
}  // namespace

BOOST_AUTO_TEST_CASE(of_more_blockers_than_there_is_room_for_the_earliest_are_kept) {
  std::mt19937 bits(1);
  for (int round = 0; round < 50; ++round) {
    Result result;
    std::vector<double> times;
    for (int i = 0; i < 3 * Result::blocker_capacity; ++i) {
      times.push_back(fraction(bits));
      result.add({.triangle = i, .time = times.back()});
      std::vector<double> kept, expected = times;
      for (const auto& blocker : result.blockers) {
        BOOST_TEST(times[std::size_t(blocker.triangle)] == blocker.time);
        kept.push_back(blocker.time);
      }
      std::sort(kept.begin(), kept.end());
      std::sort(expected.begin(), expected.end());
      if (expected.size() > std::size_t(Result::blocker_capacity)) expected.resize(std::size_t(Result::blocker_capacity));
      BOOST_TEST(kept == expected, boost::test_tools::per_element());
      BOOST_TEST(result.latest()->time == expected.back());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_motion_is_whole_where_nothing_blocks_it_and_over_where_as_much_as_there_is_room_for_blocks_its_start) {
  BOOST_TEST(Result().is_whole());
  Result shortened;
  shortened.time = 0.5;
  BOOST_TEST(!shortened.is_whole());
  BOOST_TEST(!with_blockers({1.0}).is_whole());
  Result full;
  for (int i = 0; i < Result::blocker_capacity; ++i) {
    BOOST_TEST(!full.is_over());
    full.add({.triangle = i, .time = 0.0});
  }
  full.time = 1e-3;
  BOOST_TEST(!full.is_over());
  full.time = 0;
  BOOST_TEST(full.is_over());
}

BOOST_AUTO_TEST_CASE(a_blocked_motion_is_looked_at_for_some_time_past_its_first_blocker_and_for_the_length_of_the_probe) {
  const Box box(Eigen::Vector3d(0.01, 0.01, 0.01));
  const feeler::Clearance<double> clearance;
  const auto until = [&](const Result& result, double length) {
    const feeler::MovingTool<Box> moving(box, Eigen::Vector3d::Zero(), 0.02, {}, {Eigen::Vector3d(0, 0, -length), Eigen::Vector3d::Zero()});
    return worth_certifying(result, clearance, moving);
  };
  const double slow = clearance.probe / 0.125, fast = 1e3 * clearance.probe;
  BOOST_TEST(until(with_blockers({0.5}), fast) > 0.5);
  BOOST_TEST(until(with_blockers({0.5}), fast) < 0.6);
  BOOST_TEST(until(with_blockers({0.01}), slow) == 0.125, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(until(with_blockers({0.25, 0.5}), slow) > 0.25);
  BOOST_TEST(until(with_blockers({0.25, 0.5}), slow) < 0.35);
  BOOST_TEST(until(with_blockers({0.999}), fast) == 1);
  BOOST_TEST(until(with_blockers({0.0}), clearance.probe / 2) == 1);
  Result full;
  for (int i = 0; i < Result::blocker_capacity; ++i) full.add({.triangle = i, .time = 0.2 + 1e-3 * i});
  full.time = 0.2;
  BOOST_TEST(until(full, fast) == full.latest()->time);
}

BOOST_AUTO_TEST_SUITE_END()
