#include "feeler/render/sqp/linearisation.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cstddef>
#include <utility>

#include "feeler/qp/dual_active_set.hpp"
#include "feeler/tool/box.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(linearisation)

using namespace feeler;

namespace {

using Lines = Linearisation<Box<double>, DualActiveSet<double>>;
using Vector = Vector3<double>;

constexpr double half = 0.01;      // of a side of the cube [m]
constexpr double reach = 4.01e-4;  // [m]

/// A floor at z = 0, and a wall before the cube's side at some distance; two triangles each, and the first row of the wall is 2.
TriangleMesh<double> floor_and_wall(double distance) {
  const double x = half + distance;
  Points<double> vertices(8, 3);
  vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, x, -1, -1, x, 1, -1, x, 1, 1, x, -1, 1;
  Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6;
  return {vertices, triangles};
}

struct Room {
  TriangleMesh<double> object;
  Box<double> tool{Vector::Constant(half)};
  RenderedScene<Box<double>> scene;
  Tick<double> tick;
  Lines lines;

  /// The cube stands a margin above the floor, and knows the triangles named.
  Room(double distance, std::initializer_list<int> triangles) : Room(floor_and_wall(distance), triangles) {}
  Room(TriangleMesh<double> mesh, std::initializer_list<int> triangles)
      : object(std::move(mesh)), scene(object, tool, Settings<double>{}), lines(scene) {
    for (const int t : triangles) lines.pairs().add(0, t, object.corners(t));
  }
  static Pose<double> stand(double x = 0) { return {{x, 0, half + 1e-6}, Eigen::Quaterniond::Identity()}; }
  PairState state(int triangle) { return lines.pairs()[lines.pairs().find(0, triangle)].state; }
  static Twist<double> along_x(double x) { return {{x, 0, 0}, Vector::Zero()}; }
};

/// Separate triangles at z = 0 under the cube, in a square of so many a side.
TriangleMesh<double> chips(int side) {
  const double pitch = 2 * half / (side + 1);
  Points<double> vertices(3 * side * side, 3);
  Triangles triangles(side * side, 3);
  for (int t = 0; t < side * side; ++t) {
    const double x = (t % side + 1) * pitch - half, y = (t / side + 1) * pitch - half;
    for (int k = 0; k < 3; ++k) {
      vertices.row(3 * t + k) << x + (k == 1 ? pitch / 3 : 0), y + (k == 2 ? pitch / 3 : 0), 0;
      triangles(t, k) = 3 * t + k;
    }
  }
  return {vertices, triangles};
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_new_pair_is_measured_and_then_left_out_while_its_plane_parts_it_by_some_margins) {
  Room room(1e-4, {0, 1, 2, 3});
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  BOOST_TEST(room.tick.work == 4);
  for (int t = 0; t < 4; ++t) BOOST_TEST((room.state(t) == PairState::has_rows));
  const int all = room.lines.problem().row_count();
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  BOOST_TEST(room.tick.work == 6);
  BOOST_TEST((room.state(0) == PairState::has_rows));
  BOOST_TEST((room.state(1) == PairState::has_rows));
  BOOST_TEST((room.state(2) == PairState::left_out));
  BOOST_TEST((room.state(3) == PairState::left_out));
  BOOST_TEST(room.lines.problem().row_count() < all);
  BOOST_TEST(room.tick.rows == room.lines.problem().row_count());
  BOOST_TEST(!room.lines.is_empty());
  const auto& left_out = room.lines.pairs()[room.lines.pairs().find(0, 2)];
  BOOST_TEST(left_out.slack == 1e-4, boost::test_tools::tolerance(1e-7));  // the direction between points at a distance is known to √ε
}

BOOST_AUTO_TEST_CASE(a_pair_left_out_joins_when_a_step_crosses_its_plane) {
  Room room(1e-4, {0, 1, 2, 3});
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  const int before = room.lines.problem().row_count();
  BOOST_TEST(!room.lines.add_crossed(room.scene, Room::along_x(9.8e-5), room.tick));
  BOOST_TEST(room.lines.problem().row_count() == before);
  BOOST_TEST(room.lines.add_crossed(room.scene, Room::along_x(9.95e-5), room.tick));  // nearer than the margin
  BOOST_TEST((room.state(2) == PairState::has_rows));
  BOOST_TEST((room.state(3) == PairState::has_rows));
  BOOST_TEST(room.lines.problem().row_count() > before);
  for (int k = before; k < room.lines.problem().row_count(); ++k) {
    BOOST_TEST((room.lines.problem().row(k).normal + Vector::UnitX()).norm() < 1e-9);
    BOOST_TEST(room.lines.problem().row(k).gap == 1e-4, boost::test_tools::tolerance(1e-7));
  }
  BOOST_TEST(!room.lines.add_crossed(room.scene, Room::along_x(1e-3), room.tick));
}

BOOST_AUTO_TEST_CASE(where_nothing_but_pairs_left_out_is_near_it_is_not_empty) {
  Room room(1e-4, {2, 3});
  BOOST_TEST(room.lines.is_empty());
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  BOOST_TEST(room.lines.problem().row_count() == 0);
  BOOST_TEST(!room.lines.is_empty());
  room.lines.clear();
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  BOOST_TEST(room.lines.is_empty());
}

BOOST_AUTO_TEST_CASE(rows_carried_a_little_way_are_those_that_would_be_measured_there) {
  Room carried(2e-6, {0, 1, 2, 3}), measured(2e-6, {0, 1, 2, 3});
  BOOST_TEST(!carried.lines.start_carried(carried.scene, Room::stand(), reach, carried.tick));  // nothing to carry
  carried.lines.start_measured(carried.scene, Room::stand(), reach, carried.tick);
  Pose<double> there = Room::stand(4e-7);
  there.translation.z() += 3e-7;
  there.rotation = Eigen::AngleAxisd(2e-5, Vector(1, 2, 3).normalized());
  const int work = carried.tick.work;
  BOOST_TEST(carried.lines.start_carried(carried.scene, there, reach, carried.tick));
  BOOST_TEST(carried.tick.work == work);
  measured.lines.start_measured(measured.scene, there, reach, measured.tick);
  const auto &ours = carried.lines.problem(), &theirs = measured.lines.problem();
  BOOST_TEST(theirs.row_count() > 4);
  for (int i = 0; i < theirs.row_count(); ++i) {
    const auto& row = theirs.row(i);
    bool is_found = false;
    for (int k = 0; k < ours.row_count(); ++k) {
      // Either triangle of the floor, or of the wall, may have the row of a corner over both.
      is_found = is_found || (ours.row(k).triangle / 2 == row.triangle / 2 && std::abs(ours.row(k).gap - row.gap) < 1e-13 &&
                              (ours.row(k).gradient() - row.gradient()).norm() < 1e-7);
    }
    BOOST_TEST(is_found, "triangle " << row.triangle << ", gap " << row.gap);
  }
}

BOOST_AUTO_TEST_CASE(rows_are_not_carried_far_nor_across_a_plane_of_theirs_nor_after_a_clear) {
  Room room(2e-6, {0, 1, 2, 3});
  const auto carries_to = [&room](const Pose<double>& pose) {
    room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
    return room.lines.start_carried(room.scene, pose, reach, room.tick);
  };
  BOOST_TEST(carries_to(Room::stand(1e-6)));
  BOOST_TEST(!carries_to(Room::stand(-6e-6)));    // more than a step tolerance
  BOOST_TEST(!carries_to(Room::stand(1.95e-6)));  // the wall is nearer than what is kept
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  room.lines.clear();
  BOOST_TEST(!room.lines.start_carried(room.scene, Room::stand(), reach, room.tick));
}

BOOST_AUTO_TEST_CASE(rows_of_a_pair_that_left_leave_and_the_others_are_carried_but_where_they_repeat_them) {
  // Two corners of the cube are over the seam of the floor: rows of the second triangle repeat those of the first.
  for (const int leaver : {2, 0}) {
    Room room(2e-6, {0, 1, 2, 3});
    room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
    const int rows = room.lines.problem().row_count(), work = room.tick.work;
    for (int tick = 0; tick < 2; ++tick) {
      for (auto& pair : room.lines.pairs()) {
        if (pair.triangle != leaver) pair.note_use();
      }
      room.lines.pairs().age(0, 0, true);
    }
    BOOST_TEST_REQUIRE(room.lines.pairs().size() == 3);
    BOOST_TEST(room.lines.start_carried(room.scene, Room::stand(), reach, room.tick) == (leaver == 2));
    BOOST_TEST(room.tick.work == work);
    BOOST_TEST(room.lines.problem().row_count() < rows);
  }
}

BOOST_AUTO_TEST_CASE(rows_are_carried_without_clearance_too_but_not_into_the_object) {
  Room room(1e-4, {0, 1});
  const auto carries_by = [&room](double x, double z) {
    const Pose<double> touching{{0, 0, half}, Eigen::Quaterniond::Identity()};
    room.lines.start_measured(room.scene, touching, reach, room.tick);
    const int work = room.tick.work;
    const bool is_carried = room.lines.start_carried(room.scene, {{x, 0, half + z}, touching.rotation}, reach, room.tick);
    BOOST_TEST(room.tick.work == work);
    return is_carried;
  };
  BOOST_TEST(carries_by(1e-6, 0));
  BOOST_TEST(carries_by(1e-6, -4e-12));   // rounding
  BOOST_TEST(!carries_by(1e-6, -6e-12));  // more than what is allowed for it
}

BOOST_AUTO_TEST_CASE(what_stopped_a_step_can_be_kept_where_it_ended_though_nothing_is_measured_there) {
  Room room(1e-4, {0, 1, 2, 3});
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  auto& problem = room.lines.problem();
  const Twist<double> from_hand{Vector(-2e-4, 0, 0), Vector::Zero()};  // the hand is in the wall
  problem.solve_gauss_newton(room.scene.metric(), from_hand, room.scene.margin());
  problem.solve_newton(room.scene.metric(), from_hand);
  BOOST_TEST_REQUIRE(!problem.is_free());
  const Twist<double> back = Room::along_x(-5e-5);
  room.lines.stops().remember(back, room.lines.problem());
  room.lines.move_to(room.scene, Room::stand(back.linear.x()), true, room.tick);
  const int measured = problem.row_count();
  for (int k = 0; k < measured; ++k) BOOST_TEST(problem.row(k).normal.z() == 1, boost::test_tools::tolerance(1e-9));  // the wall is left out
  BOOST_TEST(room.lines.keep_stops(room.scene));
  BOOST_TEST(problem.row_count() > measured);
  for (int k = measured; k < problem.row_count(); ++k) {
    BOOST_TEST((problem.row(k).normal + Vector::UnitX()).norm() < 1e-7);
    BOOST_TEST(problem.row(k).gap == 1.5e-4, boost::test_tools::tolerance(1e-6));
  }
  BOOST_TEST(!room.lines.keep_stops(room.scene));  // they are there
}

BOOST_AUTO_TEST_CASE(of_pairs_with_the_same_rows_one_has_them_and_when_it_leaves_another_is_measured) {
  Points<double> vertices(8, 3);  // of two floors, one on the other
  vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7;
  Room room(TriangleMesh<double>(vertices, triangles), {0, 1, 2, 3});
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  BOOST_TEST((room.state(0) == PairState::has_rows));
  BOOST_TEST((room.state(1) == PairState::has_rows));  // of one corner of the cube: two are over the diagonal
  BOOST_TEST((room.state(2) == PairState::repeats));
  BOOST_TEST((room.state(3) == PairState::repeats));
  BOOST_TEST(room.lines.problem().row_count() == 4);
  BOOST_TEST(room.lines.start_carried(room.scene, Room::stand(1e-6), reach, room.tick));
  room.lines.pairs()[room.lines.pairs().find(0, 0)].slack = 1;
  for (int tick = 0; tick < 2; ++tick) {
    for (const int used : {2, 3}) room.lines.pairs()[room.lines.pairs().find(0, used)].note_use();
    room.lines.pairs().age(4e-6, 0, false);
  }
  BOOST_TEST(room.lines.pairs().find(0, 0) == -1);
  BOOST_TEST(!room.lines.start_carried(room.scene, Room::stand(1e-6), reach, room.tick));
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  BOOST_TEST((room.state(2) == PairState::has_rows));
  BOOST_TEST(room.lines.problem().row_count() == 4);
}

BOOST_AUTO_TEST_CASE(what_blocks_is_new_unless_it_has_rows_and_only_a_ghost_is_kept_against_the_cone) {
  Room room(1e-4, {0, 1, 2, 3});
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  const auto blocked_by = [&room](int triangle) {
    SweepResult<double> result;
    result.blockers.push_back({triangle, 0.5, 0});
    return take_in_blockers(room.lines.pairs(), room.scene, result);
  };
  BOOST_TEST(!blocked_by(0));
  BOOST_TEST(blocked_by(2));
  BOOST_TEST(!room.lines.pairs()[room.lines.pairs().find(0, 2)].keeps_ghost);
  room.lines.pairs()[room.lines.pairs().find(0, 3)].state = PairState::ghost;
  BOOST_TEST(blocked_by(3));
  BOOST_TEST(room.lines.pairs()[room.lines.pairs().find(0, 3)].keeps_ghost);
  Room other(1e-4, {0});
  BOOST_TEST(take_in_blockers(other.lines.pairs(), other.scene, [] {
    SweepResult<double> result;
    result.blockers.push_back({1, 0.5, 0});
    return result;
  }()));
  BOOST_TEST(other.lines.pairs().find(0, 1) >= 0);
}

BOOST_AUTO_TEST_CASE(a_pair_for_whose_rows_there_is_no_room_is_not_said_to_have_any) {
  constexpr int side = 10;  // three corners each: more rows than a problem has
  Room room(chips(side), {});
  for (int t = 0; t < side * side; ++t) room.lines.pairs().add(0, t, room.object.corners(t));
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  const auto& problem = room.lines.problem();
  BOOST_TEST(problem.row_count() == Lines::Problem::row_capacity);
  std::array<bool, side * side> has_row{};
  for (int k = 0; k < problem.row_count(); ++k) has_row[std::size_t(problem.row(k).triangle)] = true;
  BOOST_TEST(!has_row.back());
  for (int t = 0; t < side * side; ++t) BOOST_TEST((room.state(t) == PairState::has_rows) == has_row[std::size_t(t)]);
}

BOOST_AUTO_TEST_CASE(a_pair_left_out_joins_also_where_rows_were_carried) {
  Room room(1e-4, {0, 1, 2, 3});
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  BOOST_TEST_REQUIRE((room.state(2) == PairState::left_out));
  BOOST_TEST_REQUIRE(room.lines.carry_to(room.scene, Room::stand(5e-5), room.tick));
  BOOST_TEST(!room.lines.add_crossed(room.scene, Room::along_x(4.8e-5), room.tick));
  BOOST_TEST(room.lines.add_crossed(room.scene, Room::along_x(4.95e-5), room.tick));
  BOOST_TEST((room.state(2) == PairState::has_rows));
}

BOOST_AUTO_TEST_CASE(what_is_carried_to_a_start_is_a_ghost_there_only_if_it_was_one_when_it_was_last_measured) {
  Room room(2e-6, {0, 1, 2, 3});
  room.lines.start_measured(room.scene, Room::stand(), reach, room.tick);
  for (int t = 0; t < 4; ++t) {
    BOOST_TEST_REQUIRE((room.state(t) == PairState::has_rows));
    room.lines.pairs()[room.lines.pairs().find(0, t)].is_ghost = true;  // of a start before
  }
  BOOST_TEST_REQUIRE(room.lines.start_carried(room.scene, Room::stand(1e-7), reach, room.tick));
  for (const auto& pair : room.lines.pairs()) BOOST_TEST(!pair.is_ghost);
}

BOOST_AUTO_TEST_SUITE_END()
