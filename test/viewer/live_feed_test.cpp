// The hand-off between the servo loop and its watcher.
#include <boost/test/unit_test.hpp>

#include <atomic>
#include <thread>
#include <vector>

#include "feeler/viewer/live_feed.hpp"

BOOST_AUTO_TEST_SUITE(live_feed)

using feeler::viewer::HandMode;
using feeler::viewer::HandRequest;
using feeler::viewer::LiveFeed;
using feeler::viewer::Snapshot;
using feeler::viewer::TickSample;

namespace {

Snapshot snapshot_of(std::int64_t tick) {
  Snapshot snapshot;
  snapshot.tick = tick;
  return snapshot;
}
TickSample sample_of(std::int64_t tick) {
  TickSample sample;
  sample.time = double(tick);
  return sample;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_watcher_gets_the_latest_snapshot_and_every_sample_in_order) {
  LiveFeed feed;
  for (int i = 0; i < 100; ++i) feed.tell(snapshot_of(i), sample_of(i));
  Snapshot snapshot;
  BOOST_TEST(feed.fetch(snapshot));
  BOOST_TEST(snapshot.tick == 99);
  std::vector<double> times;
  feed.drain([&](const TickSample& sample) { times.push_back(sample.time); });
  BOOST_REQUIRE(times.size() == 100);
  for (std::size_t i = 0; i < times.size(); ++i) BOOST_TEST(times[i] == double(i));
  BOOST_TEST(feed.lost() == 0);
  BOOST_TEST(!feed.fetch(snapshot));
}

BOOST_AUTO_TEST_CASE(samples_that_nobody_takes_are_lost_and_counted_and_the_loop_goes_on) {
  LiveFeed feed;
  const int told = int(LiveFeed::sample_capacity) + 50;
  for (int i = 0; i < told; ++i) feed.tell(snapshot_of(i), sample_of(i));
  int taken = 0;
  feed.drain([&](const TickSample&) { ++taken; });
  BOOST_TEST(taken + feed.lost() == told);
  BOOST_TEST(feed.lost() == 50);
}

BOOST_AUTO_TEST_CASE(under_two_threads_no_sample_is_torn_doubled_or_out_of_order) {
  constexpr int told = 200000;
  LiveFeed feed;
  std::atomic<bool> is_done = false;
  std::thread loop([&] {
    for (int i = 0; i < told; ++i) {
      feed.tell(snapshot_of(i), sample_of(i));
      if (i % 64 == 0) std::this_thread::yield();
    }
    is_done = true;
  });
  int taken = 0, out_of_order = 0;
  double last = -1;
  const auto drain = [&] {
    feed.drain([&](const TickSample& sample) {
      out_of_order += sample.time <= last;
      last = sample.time;
      ++taken;
    });
  };
  while (!is_done) {
    drain();
    std::this_thread::yield();
  }
  loop.join();
  drain();
  BOOST_TEST(out_of_order == 0);
  BOOST_TEST(taken + feed.lost() == told);
}

BOOST_AUTO_TEST_CASE(the_loop_sees_the_latest_request_once) {
  LiveFeed feed;
  HandRequest request;
  BOOST_TEST(!feed.fetch(request));
  feed.ask({HandMode::motion, 1, {}});
  feed.ask({HandMode::person, 2, {}});
  BOOST_TEST(feed.fetch(request));
  BOOST_TEST((request.mode == HandMode::person));
  BOOST_TEST(request.stage == 2);
  BOOST_TEST(!feed.fetch(request));
}

BOOST_AUTO_TEST_SUITE_END()
