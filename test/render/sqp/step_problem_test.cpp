// The step to the optimum, against closed forms for one contact that bends.
#include "feeler/render/sqp/step_problem.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <optional>

#include "feeler/proximity/clearance.hpp"
#include "feeler/qp/dual_active_set.hpp"

BOOST_AUTO_TEST_SUITE(step_problem)

using namespace feeler;

namespace {

/// A contact with a floor z = 0, and any curvature.
struct BentRow : ContactRow<double> {
  Matrix6<double> bend = Matrix6<double>::Zero();
  void add_curvature(double multiple, Matrix6<double>& lower) const noexcept { lower += multiple * bend; }
};

using Problem = StepProblem<DualActiveSet<double>, 8, BentRow>;

/// Solves for the step from a contact that is `short_by` too low, with the hand at `hand` from it.
Vector6<double> step_of(Problem& problem, double short_by, const Eigen::Vector3d& hand, const Matrix6<double>& bend) {
  BentRow row;
  row.gap = -short_by;
  row.bend = bend;
  problem.clear();
  BOOST_TEST_REQUIRE(problem.add(row, {0.0}));
  const Metric<double> metric;
  const Twist<double> graphic_from_haptic{-hand, Eigen::Vector3d::Zero()};
  problem.solve_gauss_newton(metric, graphic_from_haptic, 0.0);
  return problem.solve_newton(metric, graphic_from_haptic);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_curvature_that_couples_a_slide_with_the_way_across_it_costs_no_exactness) {
  // s = gap + z + c x z. With z given by the row, the Lagrangian's optimum along it is x = hand + λ c z, whatever the sign of the whole Hessian.
  Problem problem;
  const Eigen::Vector3d hand(2e-6, 0, -1e-3);
  for (const double coupling : {0.0, 0.9, 4.0, 17.0, 28.0, -0.0, -0.9, -4.0, -17.0, -28.0}) {  // λ c
    const double short_by = std::signbit(coupling) ? -1e-4 : 1e-7;  // or above the wall by as much
    const double multiplier = short_by - hand.z();
    Matrix6<double> bend = Matrix6<double>::Zero();
    bend(0, 2) = bend(2, 0) = coupling / multiplier;
    const Vector6<double> step = step_of(problem, short_by, hand, bend);
    BOOST_TEST_CONTEXT("coupling " << coupling) {
      BOOST_TEST(problem.is_newton());
      BOOST_TEST(step[2] == short_by, boost::test_tools::tolerance(1e-9));
      BOOST_TEST(step[0] == hand.x() + coupling * short_by, boost::test_tools::tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(where_the_tool_is_about_to_slip_off_the_step_is_finite_and_no_shorter_than_without_the_bend) {
  Problem problem;
  const Eigen::Vector3d hand(2e-4, 0, -1e-3);
  for (const double falls_off : {0.99, 1.0, 3.0, 500.0}) {  // less is the Hessian along the slide than the metric's
    Matrix6<double> bend = Matrix6<double>::Zero();
    bend(0, 0) = falls_off / -hand.z();
    const Vector6<double> step = step_of(problem, 0.0, hand, bend);
    BOOST_TEST_CONTEXT("bent by " << falls_off) {
      BOOST_TEST(!problem.is_newton());
      BOOST_TEST(step.allFinite());
      BOOST_TEST(step[0] >= hand.x());
      BOOST_TEST(std::abs(step[2]) < 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(where_the_tool_is_about_to_slip_off_as_little_of_the_metric_is_mixed_in_as_leaves_an_eightieth_of_it) {
  // Along the slide the Lagrangian is 1 − f, and s of it with 1 − s of the metric 1 − s f.
  Problem problem;
  const Eigen::Vector3d hand(2e-4, 0, -1e-3);
  for (const double falls_off : {0.99, 1.0, 1.04, 1.06, 1.3, 1.4, 1.9, 2.1, 3.0, 3.9, 4.1, 500.0}) {
    double along = 1;  // the metric alone, where no share will do
    for (const double share : {1.0 / 4, 1.0 / 2, 3.0 / 4, 15.0 / 16})
      if (1 - share * falls_off > 1.0 / 80) along = 1 - share * falls_off;
    Matrix6<double> bend = Matrix6<double>::Zero();
    bend(0, 0) = falls_off / -hand.z();
    BOOST_TEST(step_of(problem, 0.0, hand, bend)[0] == hand.x() / along, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(!problem.is_newton());
  }
}

BOOST_AUTO_TEST_CASE(between_two_walls_a_step_leaves_what_its_certificate_requires_however_little_there_is) {
  // As far from the wall below as from that above, with less than two margins between them; the hand is far below.
  constexpr double margin = 1e-6, tolerance = 2.5e-13;  // the solver's
  const Clearance<double> clearance;
  for (const double gap : {-4e-12, -1e-12, 0.0, 5e-13, 1.7e-12, 4e-12, 9e-12, 1.1e-11, 5e-11, 2e-10, 1e-8}) {
    for (const bool is_spare : {false, true}) {
      Problem problem;
      BentRow floor, ceiling;
      ceiling.normal = -floor.normal;
      floor.gap = ceiling.gap = gap;
      const double required_gap = clearance.to_leave(gap);
      BOOST_TEST_REQUIRE(problem.add(floor, {required_gap, is_spare}));
      BOOST_TEST_REQUIRE(problem.add(ceiling, {required_gap}));
      problem.solve_gauss_newton(Metric<double>(), {{0, 0, 1e-3}, Eigen::Vector3d::Zero()}, margin);
      BOOST_TEST_CONTEXT("gap " << gap << (is_spare ? ", spare" : "")) {
        BOOST_TEST(problem.is_relaxed());
        BOOST_TEST(problem.gap_after(0) >= clearance.required(gap) - tolerance);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_wedge_that_costs_more_than_the_margin_is_worth_leaves_a_tenth_of_it_in_two_steps) {
  // Two walls tilted by an angle a, a margin away, and the hand straight below: the contact forces add up to that of the hand over sin a, and the price
  // is 24 times the force of the hand, which is so at 2.388 degrees. A step goes on to a fifth of the margin, the next to a tenth.
  constexpr double margin = 1e-6, degree = 0.017453292519943295;
  const Clearance<double> clearance(margin, 4e-4);
  for (const double angle : {1.0, 2.0, 2.3, 2.5, 5.0, 40.0}) {
    ContactRow<double> left, right;
    left.normal = Eigen::Vector3d(std::cos(angle * degree), 0, std::sin(angle * degree));
    right.normal = Eigen::Vector3d(-left.normal.x(), 0, left.normal.z());
    const bool is_wedged = angle < 2.4;
    double gap = margin;
    for (const double left_then : {0.2, 0.1, 0.1}) {
      StepProblem<DualActiveSet<double>, 8> problem;
      left.gap = right.gap = gap;
      BOOST_TEST_REQUIRE(problem.add(left, {clearance.to_leave(gap)}));
      BOOST_TEST_REQUIRE(problem.add(right, {clearance.to_leave(gap)}));
      problem.solve_gauss_newton(Metric<double>(), {{0, 0, 1e-3}, Eigen::Vector3d::Zero()}, margin);
      gap = problem.gap_after(0);
      BOOST_TEST_CONTEXT(angle << " degrees, to leave " << left_then) {
        BOOST_TEST(gap == (is_wedged ? left_then * margin : margin), boost::test_tools::tolerance(1e-5));
        BOOST_TEST(problem.rests_on_the_way(clearance.kept + clearance.none()) == (is_wedged && left_then > 0.1));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(an_overlap_of_rounding_is_not_won_back_where_two_walls_part_metres_away) {
  // A slot that overlaps the tool by a picometre or two, and widens by a tenth of a picometre a metre: along it there is room for the tool 20 m away.
  constexpr double margin = 1e-6;
  for (const double tilt : {1e-14, 1e-13, 1e-12, 1e-11}) {
    Problem problem;
    BentRow floor, ceiling;
    ceiling.normal = Eigen::Vector3d(tilt, 0, -1);
    floor.gap = ceiling.gap = -1.2e-12;
    BOOST_TEST_REQUIRE(problem.add(floor, {0.0}));
    BOOST_TEST_REQUIRE(problem.add(ceiling, {0.0}));
    const Eigen::Vector3d hand(1e-4, 0, -1e-3);
    const auto& step = problem.solve_gauss_newton(Metric<double>(), {-hand, Eigen::Vector3d::Zero()}, margin);
    BOOST_TEST_CONTEXT("tilt " << tilt) {
      BOOST_TEST(problem.is_optimal());
      BOOST_TEST(std::abs(step[0] - hand.x()) < 25 * margin);  // what the margin is worth
    }
  }
}

BOOST_AUTO_TEST_CASE(a_row_that_is_kept_says_that_the_step_rests_on_it_and_is_not_carried) {
  using Corner = StepProblem<DualActiveSet<double>, 8>;
  ContactRow<double> floor, wall;
  wall.normal = Eigen::Vector3d::UnitX();
  floor.gap = wall.gap = 1e-6;
  Corner problem;
  const auto rests_on_kept = [&](double x, double z) {
    problem.solve_gauss_newton(Metric<double>(), {{x, 0, z}, Eigen::Vector3d::Zero()}, 0.0);
    return problem.rests_on_kept();
  };
  BOOST_TEST_REQUIRE(problem.add(floor, {0.0}));
  BOOST_TEST_REQUIRE(problem.keep(wall, 0.0));
  BOOST_TEST(problem.row_count() == 2);
  BOOST_TEST(rests_on_kept(1e-3, 1e-3));
  BOOST_TEST(!rests_on_kept(-1e-3, 1e-3));
  const Displacement<double> down = Twist<double>{{0, 0, -1e-7}, Eigen::Vector3d::Zero()};
  problem.carry(down, [](const ContactRow<double>&) { return std::optional<Corner::Standing>{Corner::Standing{0.0}}; });
  BOOST_TEST(problem.row_count() == 1);
  BOOST_TEST(problem.row(0).gap == 9e-7, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(!rests_on_kept(1e-3, 1e-3));
}

BOOST_AUTO_TEST_CASE(rows_that_are_not_carried_leave_and_the_others_keep_their_standing) {
  using Corner = StepProblem<DualActiveSet<double>, 8>;
  Corner problem;
  for (int triangle = 0; triangle < 4; ++triangle) {
    ContactRow<double> row;
    row.triangle = triangle;
    row.gap = 1e-6 * (triangle + 1);
    BOOST_TEST_REQUIRE(problem.add(row, {0.0}));
  }
  ContactRow<double> again = problem.row(2);
  again.triangle = 7;
  BOOST_TEST(problem.repeats(again));
  const Displacement<double> down = Twist<double>{{0, 0, -1e-7}, Eigen::Vector3d::Zero()};
  problem.carry(down, [](const ContactRow<double>& row) {
    return row.triangle % 2 == 0 ? std::optional<Corner::Standing>{Corner::Standing{0.0}} : std::nullopt;
  });
  BOOST_TEST_REQUIRE(problem.row_count() == 2);
  BOOST_TEST(problem.row(0).triangle == 0);
  BOOST_TEST(!problem.row(0).is_repeated);
  BOOST_TEST(problem.row(1).triangle == 2);
  BOOST_TEST(problem.row(1).is_repeated);
  BOOST_TEST(problem.row(1).gap == 2.9e-6, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(where_there_is_no_room_for_the_margin_both_walls_share_what_there_is_and_overlaps_stay) {
  // The certified pose was far from both; the hand is far below.
  constexpr double margin = 1e-6;
  const auto step_between = [](Problem& problem, double below, double above, const Eigen::Vector3d& hand) {
    BentRow floor, ceiling;
    ceiling.normal = -floor.normal;
    floor.gap = below;
    ceiling.gap = above;
    problem.clear();
    problem.add(floor, {1.5e-6});
    problem.add(ceiling, {1.5e-6});
    return Vector6<double>(problem.solve_gauss_newton(Metric<double>(), {-hand, Eigen::Vector3d::Zero()}, margin));
  };
  Problem problem;
  const Vector6<double> shared = step_between(problem, 5e-7, 1e-7, {0, 0, -1e-3});
  BOOST_TEST(std::abs(shared[2] + 2e-7) < 1e-11);
  BOOST_TEST(problem.is_optimal());
  // Neither has a fifth of the margin: the tool slides between them, no nearer to either.
  const Vector6<double> slide = step_between(problem, -1e-7, -1e-7, {1e-4, 0, -1e-3});
  BOOST_TEST(problem.is_optimal());
  BOOST_TEST(std::abs(slide[0] - 1e-4) < 1e-12);
  BOOST_TEST(std::abs(slide[2]) < 1e-12);
}

BOOST_AUTO_TEST_CASE(with_the_forces_of_the_last_step_steps_converge_quadratically_without_a_projection) {
  // A point held by a ball, the hand inside it: it comes to rest where the ray from the middle through the hand leaves the ball.
  const double radius = 0.01;
  const Eigen::Vector3d hand(0.004, 0.001, 0.003);
  const Metric<double> metric;
  Problem problem;
  Eigen::Vector3d point = radius * Eigen::Vector3d(0.3, -0.4, 0.9).normalized();
  int steps = 0;
  for (double error = 1; error > 1e-15 && steps < 8; ++steps) {
    BentRow row;
    row.normal = point.normalized();
    row.gap = point.norm() - radius;
    row.bend.topLeftCorner<3, 3>() = (Eigen::Matrix3d::Identity() - row.normal * row.normal.transpose()) / point.norm();
    problem.clear();
    BOOST_TEST_REQUIRE(problem.add(row, {0.0}));
    const Twist<double> graphic_from_haptic{point - hand, Eigen::Vector3d::Zero()};
    if (steps == 0) {
      BOOST_TEST((problem.solve_newton_by_guess(metric, graphic_from_haptic, 0.0) == Problem::Guess::none));  // there is no last step
      problem.solve_gauss_newton(metric, graphic_from_haptic, 0.0);
      problem.solve_newton(metric, graphic_from_haptic);
    } else {
      const Problem::Guess guess = problem.solve_newton_by_guess(metric, graphic_from_haptic, 0.0);
      BOOST_TEST_REQUIRE(
          (guess == (steps == 1 ? Problem::Guess::close : Problem::Guess::right)));  // the first step is long, and the force becomes another
      if (guess == Problem::Guess::close) problem.solve_newton(metric, graphic_from_haptic);
      BOOST_TEST(!problem.is_free());
    }
    point += problem.solution().step.head<3>();
    const double last = error;
    error = (point - radius * hand.normalized()).norm();
    if (steps > 0) BOOST_TEST(error < 150 * last * last + 1e-16, "step " << steps << ": " << last << " to " << error);
  }
  BOOST_TEST(steps <= 6);
}

BOOST_AUTO_TEST_CASE(a_guess_of_the_forces_says_what_it_is_worth) {
  using Corner = StepProblem<DualActiveSet<double>, 8>;
  using Guess = Corner::Guess;
  const Metric<double> metric;
  const auto into = [](double x, double z) { return Twist<double>{{x, 0, z}, Eigen::Vector3d::Zero()}; };  // the corner between the two, or out of it
  ContactRow<double> floor, wall;
  wall.normal = Eigen::Vector3d::UnitX();
  Corner problem;
  const auto solve = [&](const Twist<double>& e) {
    problem.solve_gauss_newton(metric, e, 0.0);
    problem.solve_newton(metric, e);
  };
  problem.add(floor, {0.0});
  problem.add(wall, {0.0});
  solve(into(-1e-3, 1e-3));
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(-1e-3, 1.1e-3), 0.0) == Guess::right));
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(-1e-3, 2e-3), 0.0) == Guess::close));  // the force is another
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(1e-3, 1e-3), 0.0) == Guess::close));  // the wall holds it too
  problem.solve_newton(metric, into(1e-3, 1e-3));
  BOOST_TEST(problem.solution().step.isZero(1e-18));
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(1e-3, -1e-3), 0.0) == Guess::close));  // the floor does not
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(-1e-3, -1e-3), 0.0) == Guess::wrong));  // nothing does
  problem.restore(metric, 1e-6);  // whose forces are of another problem
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(1e-3, 1e-3), 0.0) == Guess::right));

  problem.clear();
  problem.add(floor, {0.0});
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(-1e-3, 1e-3), 0.0) == Guess::none));  // the wall is gone
  solve(into(-1e-3, 1e-3));
  problem.clear();
  problem.add(wall, {0.0});
  problem.add(floor, {0.0});
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(-1e-3, 1e-3), 0.0) == Guess::right));
  ContactRow<double> ceiling;  // with which none has the margin
  ceiling.normal = -floor.normal;
  problem.add(ceiling, {0.0});
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(-1e-3, 1e-3), 1e-6) == Guess::wrong));
  problem.clear();
  problem.add(floor, {0.0});
  solve(into(-1e-3, 1e-3));
  problem.solve_gauss_newton(metric, into(-1e-3, -1e-3), 0.0);
  BOOST_TEST(problem.is_free());
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(-1e-3, 1e-3), 0.0) == Guess::none));  // it was free
  solve(into(-1e-3, 1e-3));
  problem.forget();
  BOOST_TEST((problem.solve_newton_by_guess(metric, into(-1e-3, 1e-3), 0.0) == Guess::none));
}

BOOST_AUTO_TEST_CASE(without_clearance_spare_rows_leave_the_tool_to_others_that_ask_the_same) {
  // Between a floor and a ceiling that it touches, in four places each: the hand pushes down and turns.
  const Metric<double> metric;
  const Twist<double> graphic_from_haptic{{2e-5, -1e-5, 1e-4}, {3e-3, -2e-3, 1e-3}};
  for (unsigned spares = 0; spares < 256; ++spares) {
    StepProblem<DualActiveSet<double>, 8> problem;
    int spare_count = 0;
    for (int i = 0; i < 8; ++i) {
      ContactRow<double> row;
      const bool is_ceiling = i >= 4, is_spare = (spares >> i & 1) != 0;
      if (is_ceiling) row.normal = -row.normal;
      row.arm = {i % 2 == 0 ? 0.01 : -0.01, i / 2 % 2 == 0 ? 0.01 : -0.01, is_ceiling ? 0.002 : -0.002};
      BOOST_TEST_REQUIRE(problem.add(row, {0.0, is_spare}));
      spare_count += is_spare;
    }
    const Vector6<double> step = problem.solve_gauss_newton(metric, graphic_from_haptic, 1e-6);
    BOOST_TEST(std::abs(step[2]) < 3e-12, "spares " << spares << ": sinks by " << step[2]);
    BOOST_TEST(step.segment<2>(3).norm() < 1e-9, "spares " << spares << ": tilts");
    if (spare_count > 1) continue;  // the others might let it tilt
    for (const auto& active : problem.solution().active) {
      BOOST_TEST((spares >> active.row & 1) == 0u, "spares " << spares << ": row " << active.row << " holds the tool");
    }
  }
}

BOOST_AUTO_TEST_CASE(in_another_unit_of_length_the_solver_finds_the_same_step) {
  // Between two walls that leave less than the margin, beside a third one that the hand is pushed into.
  constexpr double margin = 1e-6;
  const Twist<double> graphic_from_haptic{{2e-4, -1e-4, 1e-3}, {1e-3, 2e-3, -1e-3}};
  const auto solve = [&](StepProblem<DualActiveSet<double>, 8>& problem) {
    ContactRow<double> floor, ceiling, wall;
    ceiling.normal = -floor.normal;
    wall.normal = Eigen::Vector3d::UnitX();
    floor.gap = 5e-7;
    ceiling.gap = 1e-7;
    wall.gap = 3e-6;
    floor.arm = {0.01, 0.02, -0.01};
    ceiling.arm = {0.01, 0.02, 0.01};
    wall.arm = {-0.01, 0.005, 0.001};
    BOOST_TEST_REQUIRE(problem.add(floor, {1.5e-6}));
    BOOST_TEST_REQUIRE(problem.add(ceiling, {1.5e-6}));
    BOOST_TEST_REQUIRE(problem.add(wall, {0.0}));
    problem.solve_gauss_newton(Metric<double>(), graphic_from_haptic, margin);
    BOOST_TEST(problem.is_optimal());
  };
  StepProblem<DualActiveSet<double>, 8> in_metres;
  solve(in_metres);
  BOOST_TEST(in_metres.relaxation() == 7e-7, boost::test_tools::tolerance(1e-4));
  for (const double unit : {0x1p-12, 0x1p-6}) {
    StepProblem<DualActiveSet<double>, 8> problem(unit);
    solve(problem);
    BOOST_TEST_CONTEXT("unit " << unit) {
      BOOST_TEST((problem.solution().step - in_metres.solution().step).norm() < 1e-9);
      BOOST_TEST(std::abs(problem.relaxation() - in_metres.relaxation()) < 1e-10);
      BOOST_TEST(problem.worth_of_margin() == in_metres.worth_of_margin(), boost::test_tools::tolerance(1e-3));
      const auto force_of = [](const auto& solved) {
        Vector6<double> force = Vector6<double>::Zero();
        for (const auto& active : solved.solution().active) force += active.multiplier * solved.row(active.row).gradient();
        return force;
      };
      BOOST_TEST((force_of(problem) - force_of(in_metres)).norm() < 1e-8);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_told_of_a_step_is_what_its_rows_leave) {
  using Corner = StepProblem<DualActiveSet<double>, 8>;
  // A floor 1 µm below and a wall 5 µm beside; the hand is far below the floor, and 2 µm towards the wall or far behind it.
  ContactRow<double> floor, wall;
  floor.gap = 1e-6;
  floor.room = 1e-3;
  wall.normal = Eigen::Vector3d::UnitX();
  wall.gap = 5e-6;
  wall.room = 1e-6;
  wall.is_assumed = true;
  Corner problem;
  BOOST_TEST_REQUIRE(problem.add(floor, {0.0}));
  BOOST_TEST_REQUIRE(problem.add(wall, {0.0}));
  const auto solve = [&](double x) { problem.solve_gauss_newton(Metric<double>(), {{x, 0, 1e-3}, Eigen::Vector3d::Zero()}, 0.0); };
  solve(2e-6);
  BOOST_TEST(std::abs(problem.gap_after(0)) < 1e-12);
  BOOST_TEST(problem.gap_after(1) == 3e-6, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(std::abs(problem.room_after(0)) < 1e-12);
  BOOST_TEST(problem.room_after(1) == 3e-6, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(!problem.rests_on_assumption());
  BOOST_TEST(problem.keeps_features());
  solve(1e-3);
  BOOST_TEST(problem.rests_on_assumption());
  BOOST_TEST(!problem.keeps_features());  // the wall is left by the way down alone
  const auto down = [](double way) { return Twist<double>{{0, 0, -way}, Eigen::Vector3d::Zero()}; };
  BOOST_TEST(problem.leaves_gaps(down(0.5e-6), 0.4e-6));
  BOOST_TEST(!problem.leaves_gaps(down(0.5e-6), 0.6e-6));
}

BOOST_AUTO_TEST_CASE(the_margin_is_won_back_without_a_force_and_is_worth_what_is_won_of_it) {
  using Corner = StepProblem<DualActiveSet<double>, 8>;
  constexpr double margin = 1e-6;
  ContactRow<double> floor, ceiling;
  floor.gap = 3e-7;
  Corner at_rest;
  BOOST_TEST_REQUIRE(at_rest.add(floor, {0.0}));
  BOOST_TEST(at_rest.solve_gauss_newton(Metric<double>(), {}, margin)[2] == 7e-7, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(!at_rest.is_relaxed());
  // All of the margin above a floor that is touched; a fifth of it between walls of which the nearer comes to have 0.3 µm, of 0.1.
  const Twist<double> pull{{0, 0, 1e-3}, Eigen::Vector3d::Zero()};
  Corner one, two;
  floor.gap = 0;
  BOOST_TEST_REQUIRE(one.add(floor, {0.0}));
  one.solve_gauss_newton(Metric<double>(), pull, margin);
  floor.gap = 5e-7;
  ceiling.normal = -floor.normal;
  ceiling.gap = 1e-7;
  BOOST_TEST_REQUIRE(two.add(floor, {1.5e-6}));
  BOOST_TEST_REQUIRE(two.add(ceiling, {1.5e-6}));
  two.solve_gauss_newton(Metric<double>(), pull, margin);
  BOOST_TEST(two.worth_of_margin() == 0.2 * one.worth_of_margin(), boost::test_tools::tolerance(1e-3));
  BOOST_TEST(one.worth_of_margin() > margin * 1e-3);  // more than the force that is in its way
}

BOOST_AUTO_TEST_CASE(along_turned_axes_the_step_is_the_step_turned) {
  const Metric<double> along{{1, 0.5, 0.25}, {2e-3, 1e-3, 3e-3}};
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, 0.5, -0.7, 0.4).normalized();
  const auto turned_six = [&](const Vector6<double>& v) {
    Vector6<double> result;
    result << turn * Eigen::Vector3d(v.head<3>()), turn * Eigen::Vector3d(v.tail<3>());
    return result;
  };
  Matrix6<double> both = Matrix6<double>::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = turn.toRotationMatrix();
  const Twist<double> graphic_from_haptic{{-2e-4, 1e-4, 1e-3}, {0.01, -0.02, 0.03}};
  for (const double falls_off : {0.0, 0.5, 0.98, 0.99, 1.0, 3.0}) {  // less is the Hessian along x than the metric's; an eightieth has to be left
    BentRow row;
    if (falls_off < 0.6) row.arm = {0.01, -0.02, 0.005};
    row.bend(0, 0) = falls_off / (0.25 * 1e-3);  // by the force of the floor where that has no arm
    BentRow there = row;
    there.normal = turn * row.normal;
    there.arm = turn * row.arm;
    there.bend = both * row.bend * both.transpose();
    Problem problem, turned;
    BOOST_TEST_REQUIRE(problem.add(row, {0.0}));
    BOOST_TEST_REQUIRE(turned.add(there, {0.0}));
    TurnedMetric<double> metric(along);
    metric.turn(turn);
    const auto moved = Twist<double>::from_vector(turned_six(graphic_from_haptic.vector()));
    const Vector6<double> first = problem.solve_gauss_newton(along, graphic_from_haptic, 0.0);
    BOOST_TEST((turned.solve_gauss_newton(metric, moved, 0.0) - turned_six(first)).norm() < 1e-9);
    const Vector6<double> second = problem.solve_newton(along, graphic_from_haptic);
    BOOST_TEST_CONTEXT("falls off by " << falls_off) {
      BOOST_TEST((turned.solve_newton(metric, moved) - turned_six(second)).norm() < 1e-9);
      BOOST_TEST(turned.is_newton() == problem.is_newton());
      const Vector6<double> back = problem.restore(along, 1e-6);
      BOOST_TEST((turned.restore(metric, 1e-6) - turned_six(back)).norm() < 1e-11);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_eightieth_of_the_metric_has_to_be_left_of_the_hessian) {
  Problem problem;
  for (const double left : {0.02, 0.0126, 0.0124, 0.005}) {
    Matrix6<double> bend = Matrix6<double>::Zero();
    bend(0, 0) = (1 - left) / 1e-3;
    step_of(problem, 0.0, {2e-4, 0, -1e-3}, bend);
    BOOST_TEST(problem.is_newton() == (left > 1.0 / 80));
  }
}

BOOST_AUTO_TEST_SUITE_END()
