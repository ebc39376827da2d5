// A newer task need not wait for an older one.
#include <boost/test/unit_test.hpp>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "live/workshop.hpp"

BOOST_AUTO_TEST_SUITE(workshop)

using feeler::demo::go_on_unless;
using feeler::demo::Workshop;

namespace {

int result_of(Workshop<int>& workshop) {
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < std::chrono::seconds(20)) {
    if (const auto result = workshop.result()) return *result;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return -1;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_newer_task_is_done_while_an_older_one_cannot_end) {
  std::atomic<bool> may_end = false;
  {
    Workshop<int> workshop;
    workshop.begin([&](const std::stop_token&) {
      while (!may_end) std::this_thread::yield();
      return 1;
    });
    workshop.begin([](const std::stop_token&) { return 2; });
    BOOST_TEST(result_of(workshop) == 2);
    BOOST_TEST(!workshop.is_busy());
    may_end = true;
  }
}

BOOST_AUTO_TEST_CASE(an_older_task_ends_at_its_next_step_and_is_forgotten) {
  std::atomic<int> ended = 0;
  const auto endless = [&](const std::stop_token& stop) -> int {
    try {
      for (;;) go_on_unless(stop), std::this_thread::yield();
    } catch (...) {
      ++ended;
      throw;
    }
  };
  Workshop<int> workshop;
  for (int i = 0; i < 20; ++i) workshop.begin(endless);
  workshop.abandon();
  BOOST_TEST(!workshop.is_busy());
  workshop.begin([](const std::stop_token&) { return 3; });
  BOOST_TEST(result_of(workshop) == 3);
  BOOST_TEST(ended >= 1);
}

BOOST_AUTO_TEST_CASE(what_the_wanted_task_throws_is_thrown_once) {
  Workshop<int> workshop;
  workshop.begin([](const std::stop_token&) -> int { throw std::runtime_error("no"); });
  BOOST_CHECK_THROW(result_of(workshop), std::runtime_error);
  BOOST_TEST(!workshop.result().has_value());
}

BOOST_AUTO_TEST_SUITE_END()
