// Which rows of the start of a motion are kept, and where they are.
#include "feeler/render/constraints/kept_contacts.hpp"

#include <boost/test/unit_test.hpp>

#include <cstddef>
#include <vector>

BOOST_AUTO_TEST_SUITE(kept_contacts)

using namespace feeler;

namespace {

using Row = ContactRow<double>;
constexpr double margin = 1e-6;

/// A problem that takes the rows of floors.
struct Problem {
  std::vector<double> gaps, required;
  std::size_t room = 100;
  bool keep(const Row& row, double required_gap) {
    if (gaps.size() == room) return false;
    gaps.push_back(row.gap);
    required.push_back(required_gap);
    return true;
  }
};

Twist<double> down(double way) { return {{0, 0, -way}, Vector3<double>::Zero()}; }

/// Whether the row of a floor so far below is kept on a motion so far down.
bool is_kept(double gap, double way) {
  KeptContacts<Row, 4> contacts;
  Row floor;
  floor.gap = gap;
  contacts.add(floor, 0.0);
  Problem problem;
  return contacts.keep_broken([] { return down(0); }, down(way), margin, problem);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_row_is_kept_where_a_motion_leaves_less_than_a_tenth_of_its_gap_or_of_the_margin) {
  for (const double gap : {0.1 * margin, 0.5 * margin, margin}) {
    BOOST_TEST(!is_kept(gap, 0.89 * gap));
    BOOST_TEST(is_kept(gap, 0.91 * gap));
  }
  BOOST_TEST(!is_kept(5 * margin, 4.89 * margin));
  BOOST_TEST(is_kept(5 * margin, 4.91 * margin));
}

BOOST_AUTO_TEST_CASE(a_row_is_kept_once_until_it_is_released_and_as_it_is_where_the_motion_has_come) {
  KeptContacts<Row, 4> contacts;
  Row floor;
  floor.gap = margin;
  contacts.add(floor, 0.25 * margin);
  Problem problem;
  const auto so_far = [] { return down(0.75 * margin); };
  BOOST_TEST(contacts.keep_broken(so_far, down(margin), margin, problem));
  BOOST_TEST(!contacts.keep_broken(so_far, down(margin), margin, problem));
  contacts.release();
  BOOST_TEST(contacts.keep_broken(so_far, down(margin), margin, problem));
  BOOST_TEST_REQUIRE(problem.gaps.size() == 2u);
  BOOST_TEST(problem.gaps[0] == 0.25 * margin, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(problem.required[0] == 0.25 * margin);
  contacts.clear();
  BOOST_TEST(!contacts.keep_broken(so_far, down(margin), margin, problem));
}

BOOST_AUTO_TEST_CASE(what_there_is_no_room_for_is_not_kept_and_takes_nothing_back_of_what_is) {
  for (const std::size_t room : {std::size_t(0), std::size_t(1), std::size_t(2)}) {
    KeptContacts<Row, 4> contacts;
    Row floor;
    floor.gap = margin;
    for (int i = 0; i < 2; ++i) contacts.add(floor, 0.0);
    Problem problem;
    problem.room = room;
    BOOST_TEST(contacts.keep_broken([] { return down(0); }, down(margin), margin, problem) == (room > 0));
    BOOST_TEST(problem.gaps.size() == room);
  }
}

BOOST_AUTO_TEST_SUITE_END()
