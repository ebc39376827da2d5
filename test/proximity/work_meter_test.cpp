#include "feeler/proximity/work_meter.hpp"

#include <boost/test/unit_test.hpp>

#include <random>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(work_meter)

using namespace feeler_test;

BOOST_AUTO_TEST_CASE(efforts_make_whole_units_however_they_come_and_what_is_left_is_not_lost) {
  std::mt19937 bits(1);
  feeler::WorkMeter<16> meter;
  int work = 0, efforts = 0;
  for (int i = 0; i < 1000; ++i) {
    const int some = below(bits, 40);
    efforts += some;
    if (i % 3 == 0) {
      meter.note(some);
      continue;
    }
    meter.add(some, work);
    BOOST_TEST(work == efforts / 16);
  }
}

BOOST_AUTO_TEST_CASE(a_cleared_meter_begins_anew) {
  feeler::WorkMeter<4> meter;
  int work = 5;
  meter.add(3, work);
  meter.clear();
  meter.add(3, work);
  BOOST_TEST(work == 5);
  meter.add(1, work);
  BOOST_TEST(work == 6);
}

BOOST_AUTO_TEST_SUITE_END()
