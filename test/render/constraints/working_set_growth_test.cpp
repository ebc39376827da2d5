// What a blocked motion teaches the working set.
#include "feeler/render/constraints/working_set_growth.hpp"

#include <boost/test/unit_test.hpp>

#include "feeler/object/triangle_mesh.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/tool/box.hpp"

BOOST_AUTO_TEST_SUITE(working_set_growth)

using namespace feeler;

namespace {

/// A floor of two triangles and, a metre higher, a triangle alone.
struct Room {
  TriangleMesh<double> mesh{(Points<double>(7, 3) << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 5, 0, 1, 6, 0, 1, 5, 1, 1).finished(),
                            (Triangles(3, 3) << 0, 1, 2, 0, 2, 3, 4, 5, 6).finished()};
  RenderedScene<Box<double>> scene{mesh, Box<double>({0.01, 0.01, 0.01}), Settings<double>()};
  WorkingSet<double> pairs;

  /// A pair of a triangle that has rows, with a separation [m].
  auto& add(int triangle, double slack) {
    auto& pair = take_in(pairs, scene, 0, triangle, {});
    pair.set_plane(Vector3<double>::UnitZ(), slack);
    pair.state = PairState::has_rows;
    return pair;
  }
  bool meet(int triangle) {
    SweepResult<double> result;
    result.time = 0;
    result.add({.triangle = triangle});
    return take_in_blockers(pairs, scene, result);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(an_unknown_blocker_is_taken_in) {
  Room room;
  BOOST_TEST(room.meet(1));
  BOOST_TEST(room.pairs.find(0, 1) == 0);
}

BOOST_AUTO_TEST_CASE(a_known_one_without_clearance_asks_for_the_rim_of_its_wall) {
  Room room;
  BOOST_TEST_REQUIRE((room.mesh.walls().of_triangle(0) >= 0 && room.mesh.walls().of_triangle(0) == room.mesh.walls().of_triangle(1)));
  room.add(0, 0.0);
  BOOST_TEST(!room.meet(0));  // the motion is shortened all the same
  BOOST_TEST(room.pairs[0].wants_rim);
  BOOST_TEST((room.pairs[0].state == PairState::left_out));
}

BOOST_AUTO_TEST_CASE(a_known_one_that_touches_teaches_nothing_where_there_is_clearance_or_no_wall) {
  Room room;
  room.add(0, 1e-7);
  BOOST_TEST(!room.meet(0));
  BOOST_TEST(!room.pairs[0].wants_rim);
  Room other;
  BOOST_TEST_REQUIRE(other.mesh.walls().of_triangle(2) < 0);
  other.add(2, 0.0);
  BOOST_TEST(!other.meet(2));
}

BOOST_AUTO_TEST_CASE(what_was_left_out_is_new_if_nothing_that_touches_was_met) {
  Room room;
  room.add(0, 1e-3).state = PairState::left_out;
  BOOST_TEST(room.meet(0));
  Room other;
  other.add(0, 1e-3).state = PairState::has_rows;
  BOOST_TEST(!other.meet(0));
}

BOOST_AUTO_TEST_CASE(a_ghost_that_blocks_keeps_its_row) {
  Room room;
  room.add(0, 1e-3).state = PairState::ghost;
  BOOST_TEST(room.meet(0));
  BOOST_TEST(room.pairs[0].keeps_ghost);
}

BOOST_AUTO_TEST_CASE(what_was_noticed_is_taken_in_once_for_each_piece_of_the_tool) {
  Room room;
  room.add(0, 1e-3);
  NoticedTriangles all;
  all.push_back({0, 0, {}});
  BOOST_TEST(!take_in_noticed(room.pairs, room.scene, all));
  WitnessFeatures features;
  features.size = 2;
  all.push_back({1, 0, features});
  all.push_back({0, 2, {}});
  BOOST_TEST(take_in_noticed(room.pairs, room.scene, all));
  BOOST_TEST(room.pairs.size() == 3);
  BOOST_TEST_REQUIRE(room.pairs.find(0, 1) >= 0);
  BOOST_TEST(room.pairs[room.pairs.find(0, 1)].features.size == 2);
  BOOST_TEST((room.pairs[room.pairs.find(0, 1)].corners_world == room.mesh.corners(1)));
  BOOST_TEST(room.pairs.find(2, 0) >= 0);
  BOOST_TEST(!take_in_noticed(room.pairs, room.scene, all));
}

BOOST_AUTO_TEST_CASE(a_blocker_that_touches_and_repeats_others_is_to_be_measured) {
  Room room;
  room.add(0, 1e-7).state = PairState::repeats;
  BOOST_TEST(!room.meet(0));
  BOOST_TEST((room.pairs[0].state == PairState::left_out));
  room.pairs[0].unused_ticks = 5;
  BOOST_TEST(!room.meet(0));
  BOOST_TEST(room.pairs[0].unused_ticks == 0);
}

BOOST_AUTO_TEST_CASE(what_was_left_out_is_not_new_where_something_that_touches_was_met_too) {
  for (const bool is_touching_first : {true, false}) {
    Room room;
    room.add(0, 1e-7);
    room.add(2, 1e-3).state = PairState::left_out;
    SweepResult<double> result;
    result.add({.triangle = is_touching_first ? 0 : 2});
    result.add({.triangle = is_touching_first ? 2 : 0});
    BOOST_TEST(!take_in_blockers(room.pairs, room.scene, result));
  }
}

BOOST_AUTO_TEST_SUITE_END()
