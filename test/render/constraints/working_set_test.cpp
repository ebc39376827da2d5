#include "feeler/render/constraints/working_set.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(working_set)

using Set = feeler::WorkingSet<double>;
using Corners = Eigen::Matrix3d;

BOOST_AUTO_TEST_CASE(a_triangle_is_found_where_it_was_added_and_starts_with_nothing_known) {
  Set set;
  BOOST_TEST(set.size() == 0);
  BOOST_TEST(set.find(0, 3) == -1);
  for (int i = 0; i < 10; ++i) set.add(0, 100 + i, Corners::Constant(i));
  BOOST_TEST(set.size() == 10);
  for (int i = 0; i < 10; ++i) {
    const int place = set.find(0, 100 + i);
    BOOST_TEST_REQUIRE(place >= 0);
    const auto& pair = set[place];
    BOOST_TEST(pair.triangle == 100 + i);
    BOOST_TEST((pair.corners_world == Corners::Constant(i)));
    BOOST_TEST(pair.normal.isZero(0));
    BOOST_TEST(pair.features.size == 0);
    BOOST_TEST(pair.unused_ticks == 0);
    BOOST_TEST((pair.state == feeler::PairState::left_out));
    BOOST_TEST(!pair.has_plane());
    BOOST_TEST(!pair.keeps_ghost);
  }
  BOOST_TEST(set.find(0, 110) == -1);
  set.clear();
  BOOST_TEST(set.size() == 0);
  BOOST_TEST(set.find(0, 100) == -1);
}

BOOST_AUTO_TEST_CASE(pieces_of_a_tool_have_pairs_of_their_own_with_the_same_triangle) {
  Set set;
  set.add(0, 7, Corners::Zero());
  set.add(2, 7, Corners::Ones());
  BOOST_TEST(set[set.find(2, 7)].piece == 2);
  BOOST_TEST((set[set.find(2, 7)].corners_world == Corners::Ones()));
  BOOST_TEST(set.find(0, 7) != set.find(2, 7));
  BOOST_TEST(set.find(1, 7) == -1);
}

BOOST_AUTO_TEST_CASE(a_full_set_gives_up_the_triangle_that_has_been_unused_longest) {
  Set set;
  for (int i = 0; i < Set::capacity; ++i) {
    set.add(0, i, Corners::Zero());
    set[i].unused_ticks = i == 17 ? 9 : i % 5;
  }
  set.add(0, 1000, Corners::Ones());
  BOOST_TEST(set.size() == int(Set::capacity));
  BOOST_TEST(set.find(0, 17) == -1);
  BOOST_TEST(set.find(0, 1000) >= 0);
  for (int i = 0; i < Set::capacity; ++i)
    if (i != 17) BOOST_TEST(set.find(0, i) >= 0);
}

BOOST_AUTO_TEST_CASE(a_triangle_leaves_after_a_tick_in_which_it_was_neither_used_nor_touched) {
  Set set;
  set.add(0, 1, Corners::Zero()).slack = 1e-7;  // touches
  set.add(0, 2, Corners::Zero()).slack = 1e-4;
  set.add(0, 3, Corners::Zero()).slack = 1e-4;
  set.age(4e-6, 0, false);
  BOOST_TEST(set.size() == 3);  // new in the tick that ends
  for (int tick = 0; tick < 5; ++tick) {
    set[set.find(0, 3)].note_use();
    set.age(4e-6, 0, false);
    BOOST_TEST(set.find(0, 1) >= 0);
    BOOST_TEST(set.find(0, 2) == -1);
    BOOST_TEST(set.find(0, 3) >= 0);
  }
  set.age(4e-6, 0, false);
  BOOST_TEST(set.find(0, 3) == -1);
  BOOST_TEST(set.size() == 1);
}

BOOST_AUTO_TEST_CASE(a_touching_pair_that_repeats_others_leaves_like_one_that_does_not_touch) {
  Set set;
  set.add(0, 1, Corners::Zero()).state = feeler::PairState::has_rows;
  set.add(0, 2, Corners::Zero()).state = feeler::PairState::repeats;
  set.age(4e-6, 0, false);
  BOOST_TEST(set.size() == 2);
  set.age(4e-6, 0, false);
  BOOST_TEST(set.size() == 1);
  BOOST_TEST(set[0].triangle == 1);
}

BOOST_AUTO_TEST_CASE(a_ghost_that_was_kept_is_kept_on_only_as_long_as_asked) {
  Set set;
  set.add(0, 1, Corners::Zero());
  set[0].keeps_ghost = true;
  set.age(1, 0, true);
  BOOST_TEST(set[0].keeps_ghost);
  set.age(1, 0, false);
  BOOST_TEST(!set[0].keeps_ghost);
}

BOOST_AUTO_TEST_CASE(what_touches_but_never_holds_leaves_in_the_end) {
  Set set;
  for (int triangle = 0; triangle < 2; ++triangle) set.add(0, triangle, Corners::Zero()).state = feeler::PairState::has_rows;
  for (int tick = 0; tick < Set::longest_unused; ++tick) {
    if (tick % 100 == 0) set[set.find(0, 1)].note_use();
    set.age(4e-6, 0, false);
    BOOST_TEST(set.size() == 2);
  }
  set.age(4e-6, 0, false);
  BOOST_TEST(set.find(0, 0) == -1);
  BOOST_TEST(set.find(0, 1) == 0);
}

BOOST_AUTO_TEST_CASE(a_separation_is_known_for_less_with_every_motion_until_it_is_measured_again) {
  Set set;
  auto& pair = set.add(0, 1, Corners::Zero());
  BOOST_TEST(!pair.is_beyond(0));
  for (int round = 0; round < 2; ++round) {
    pair.set_plane(Eigen::Vector3d::UnitZ(), 1e-4);
    BOOST_TEST(pair.is_beyond(9e-5));
    for (int motion = 1; motion <= 3; ++motion) {
      set.approach(2e-5);
      BOOST_TEST(!pair.is_beyond(1.1e-4 - 2e-5 * motion));
      BOOST_TEST(pair.is_beyond(0.9e-4 - 2e-5 * motion));
    }
  }
}

BOOST_AUTO_TEST_CASE(what_would_be_noticed_again_stays_and_a_filler_leaves_soon) {
  Set set;
  for (int triangle = 0; triangle < 3; ++triangle) set.add(0, triangle, Corners::Zero()).state = feeler::PairState::has_rows;
  set[0].slack = 5e-5;
  set[1].slack = set[2].slack = 1e-6;
  set[1].is_filler = true;
  for (int tick = 0; tick < Set::longest_unused_filler; ++tick) set.age(4e-6, 1e-4, false);
  BOOST_TEST(set.size() == 3);
  for (int tick = 0; tick < 2 * Set::longest_unused; ++tick) set.age(4e-6, 1e-4, false);
  BOOST_TEST(set.size() == 3);
  set[set.find(0, 2)].note_use();
  set.age(4e-6, 0, false);
  BOOST_TEST(set.size() == 1);
  BOOST_TEST(set.find(0, 2) == 0);
  set.add(0, 3, Corners::Zero()).is_filler = true;
  for (int tick = 0; tick < Set::longest_unused_filler; ++tick) set.age(4e-6, 0, false);
  BOOST_TEST(set.size() == 2);
  set.age(4e-6, 0, false);
  BOOST_TEST(set.find(0, 3) == -1);
}

BOOST_AUTO_TEST_CASE(a_pair_that_was_not_measured_says_nothing_of_the_clearance) {
  feeler::WorkingSet<double> set;
  auto& pair = set.add(0, 1, feeler::Matrix3<double>::Zero());
  BOOST_TEST(!set.has_no_clearance(1e-10));
  pair.set_plane(feeler::Vector3<double>::UnitZ(), 1e-9);
  BOOST_TEST(!set.has_no_clearance(1e-10));
  pair.set_plane(feeler::Vector3<double>::UnitZ(), -1e-13);
  BOOST_TEST(set.has_no_clearance(1e-10));
}

BOOST_AUTO_TEST_CASE(the_rim_of_a_wall_is_wanted_only_as_long_as_motion_is_left) {
  Set set;
  set.add(0, 1, Corners::Zero()).wants_rim = true;
  set.age(1, 0, true);
  BOOST_TEST(set[0].wants_rim);
  set.age(1, 0, false);
  BOOST_TEST(!set[0].wants_rim);
}

BOOST_AUTO_TEST_CASE(a_pair_that_has_not_held_the_tool_for_more_than_a_hundred_ticks_is_spare) {
  Set set;
  set.add(0, 1, Corners::Zero()).state = feeler::PairState::has_rows;
  for (int round = 0; round < 2; ++round) {
    for (int tick = 0; tick <= 100; ++tick) {
      BOOST_TEST(!set[0].is_spare());
      set.age(4e-6, 0, false);
    }
    BOOST_TEST(set[0].is_spare());
    set[0].note_use();
  }
}

BOOST_AUTO_TEST_SUITE_END()
