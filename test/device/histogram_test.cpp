// The histogram against sorted data.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "feeler/device/histogram.hpp"

BOOST_AUTO_TEST_SUITE(histogram)

using feeler::Histogram;

BOOST_AUTO_TEST_CASE(bins_tile_all_durations_without_gap_or_overlap) {
  for (int bin = 1; bin < Histogram::bins; ++bin) {
    const std::int64_t first = Histogram::last_of(bin - 1) + 1;
    const std::int64_t last = Histogram::last_of(bin);
    BOOST_REQUIRE(first <= last);
    BOOST_REQUIRE_EQUAL(Histogram::bin_of(first), bin);
    BOOST_REQUIRE_EQUAL(Histogram::bin_of(last), bin);
    BOOST_REQUIRE(last - first <= first / 32);
  }
  BOOST_TEST(Histogram::bin_of(0) == 0);
  BOOST_TEST(Histogram::last_of(Histogram::bins - 1) == std::numeric_limits<std::int64_t>::max());
}

BOOST_AUTO_TEST_CASE(percentiles_are_those_of_the_sorted_data_rounded_up_by_at_most_a_bin) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    BOOST_TEST_CONTEXT("seed " << seed) {
      std::mt19937 bits(seed);
      auto recorded = std::make_unique<Histogram>();
      std::vector<std::int64_t> values;
      for (int i = 0; i < 10007; ++i) {
        const double decades = double(bits()) / 4294967296.0 * 9;  // 1 ns to 1 s
        values.push_back(std::int64_t(std::pow(10.0, decades)));
        recorded->add(values.back());
      }
      std::sort(values.begin(), values.end());
      BOOST_TEST(recorded->count() == 10007);
      BOOST_TEST(recorded->minimum() == values.front());
      BOOST_TEST(recorded->maximum() == values.back());
      for (const double p : {0.0, 0.1, 1.0, 25.0, 50.0, 90.0, 99.0, 99.9, 99.99, 100.0}) {
        const auto rank = std::max<std::size_t>(std::size_t(std::ceil(p / 100 * 10007)), 1);
        const std::int64_t expected = values[rank - 1];
        BOOST_TEST(recorded->percentile(p) >= expected);
        BOOST_TEST(recorded->percentile(p) <= expected + expected / 32);
      }
      BOOST_TEST(recorded->percentile(100) == values.back());
    }
  }
}

BOOST_AUTO_TEST_CASE(an_empty_histogram_and_negative_durations_are_zero) {
  Histogram recorded;
  BOOST_TEST(recorded.percentile(99) == 0);
  BOOST_TEST(recorded.maximum() == 0);
  recorded.add(-5);
  BOOST_TEST(recorded.count() == 1);
  BOOST_TEST(recorded.percentile(50) == 0);
}

BOOST_AUTO_TEST_SUITE_END()
