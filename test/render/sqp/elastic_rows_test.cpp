// Rows relaxed at a price, against closed forms and against a search over the relaxation.
#include "feeler/render/sqp/elastic_rows.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "feeler/qp/dual_active_set.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(elastic_rows)

using namespace feeler;

namespace {

using Elastic = ElasticRows<double, 32>;

struct Fit {
  QpProblem<double> problem;
  Elastic rows;
  DualActiveSet<double> solver;
  QpSolution<double> solution;

  void add(const Vector6<double>& row, double soft, double hard) {
    problem.add_row(row, soft);
    rows.add(soft, hard);
  }
  int solve(double price, int allowed = Elastic::most_solves) { return rows.solve(solver, problem, price, 1e-12, allowed, {}, solution); }
};

Vector6<double> along(int axis, double sign) {
  Vector6<double> row = Vector6<double>::Zero();
  row[axis] = sign;
  return row;
}

/// Between a floor and a ceiling `play` apart; the hand is `hand` above the middle, where the step starts.
Fit slot(double play, double margin, double hand) {
  Fit fit;
  fit.problem.gradient[2] = -hand;
  fit.add(along(2, 1), margin - play / 2, -play / 2);
  fit.add(along(2, -1), margin - play / 2, -play / 2);
  return fit;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_has_room_is_not_relaxed_and_takes_one_qp) {
  Fit fit = slot(4e-6, 1e-6, 1e-3);
  BOOST_TEST(fit.solve(1.0) == 1);
  BOOST_TEST(fit.rows.relaxation() == 0.0);
  BOOST_TEST(fit.solution.step[2] == 1e-6, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_slot_without_room_for_the_margin_holds_the_tool_in_its_middle_while_the_force_is_below_the_price) {
  for (const double play : {1.9e-6, 1e-6, 1e-8}) {
    Fit fit = slot(play, 1e-6, 1e-3);
    BOOST_TEST(fit.solve(2e-3) > 0);
    BOOST_TEST(std::abs(fit.solution.step[2]) < 1e-11);
    BOOST_TEST(fit.rows.relaxation() == 1e-6 - play / 2, boost::test_tools::tolerance(1e-5));
  }
}

BOOST_AUTO_TEST_CASE(a_search_that_ends_for_want_of_qps_relaxes_by_what_is_surely_enough_and_says_so) {
  for (const int allowed : {1, 2, 24}) {
    Fit fit = slot(1e-6, 1e-6, -1e-7);
    BOOST_TEST(fit.solve(2e-3, allowed) > 0);
    BOOST_TEST(fit.rows.is_cut_short() == (allowed < 24));
    BOOST_TEST(fit.rows.relaxation() == 0.5e-6, boost::test_tools::tolerance(1e-5));
  }
  // A wall 0.3 mm below where it should give way: what is missing at first is too much.
  Fit fit;
  fit.problem.gradient[2] = 1e-3;
  fit.add(along(2, 1), 5e-4, 0.0);
  BOOST_TEST(fit.solve(1.2e-3, 1) == 1);
  BOOST_TEST(fit.rows.is_cut_short());
  BOOST_TEST(fit.rows.relaxation() == 5e-4, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_wall_that_costs_more_than_the_price_gives_way_by_what_the_price_is_short) {
  // The floor alone, and the hand 1 mm below the tool: the floor gives way to where the force z − hand falls to the price.
  for (const double soft : {1e-6, 5e-4}) {
    for (const double price : {9e-4, 8e-4}) {
      Fit fit;
      fit.problem.gradient[2] = 1e-3;
      fit.add(along(2, 1), soft, -5e-4);
      BOOST_TEST(fit.solve(price) > 0);
      BOOST_TEST(fit.solution.step[2] == price - 1e-3, boost::test_tools::tolerance(1e-7));
      BOOST_TEST(fit.rows.relaxation() == soft - (price - 1e-3), boost::test_tools::tolerance(1e-7));
      BOOST_TEST(!fit.rows.is_hard(0));
    }
  }
}

BOOST_AUTO_TEST_CASE(walls_that_cost_more_than_the_price_at_their_hard_bounds_stay_there_and_tell_so_in_a_few_qps) {
  // The same floor, and others beside it with more or less to give: the force 1 mm − z is over the price down to the last of them.
  for (const int others : {0, 1, 5}) {
    Fit fit;
    fit.problem.gradient[2] = 1e-3;
    fit.add(along(2, 1), 1e-6, -5e-4);
    for (int k = 1; k <= others; ++k) fit.add(along(2, 1), 1e-6, -5e-4 - 1e-5 * k);
    const int solves = fit.solve(4e-4);
    BOOST_TEST((0 < solves && solves <= (others == 0 ? 2 : 12)));
    BOOST_TEST(!fit.rows.is_cut_short());
    BOOST_TEST(fit.solution.step[2] == -5e-4, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(fit.rows.is_hard(0));
  }
}

BOOST_AUTO_TEST_CASE(what_a_wall_that_gives_way_lacks_before_one_that_does_not_is_known_at_once) {
  // A floor 0.2 µm below that has to be kept whole, whatever less is asked of it than its hard bound; a ceiling that gives way by 0.3 µm.
  for (const bool is_floor_first : {true, false}) {
    Fit fit;
    fit.problem.gradient[2] = 1e-9;
    const auto add_floor = [&fit] { fit.add(along(2, 1), -0.2e-6, 1e-6); };
    if (is_floor_first) add_floor();
    fit.add(along(2, -1), 0.5e-6, -0.5e-6);
    if (!is_floor_first) add_floor();
    BOOST_TEST(fit.solve(1.0) == 2);
    BOOST_TEST(std::abs(fit.solution.step[2] + 0.2e-6) < 1e-12);
    BOOST_TEST(fit.rows.relaxation() == 0.3e-6, boost::test_tools::tolerance(1e-5));
  }
}

BOOST_AUTO_TEST_CASE(what_one_wall_gives_up_of_the_margin_all_others_may_come_nearer_by) {
  // A slot without room for the margin, and a wall to its side that the hand pulls the tool to.
  for (const double play : {1.9e-6, 1e-6, 1e-8}) {
    Fit fit = slot(play, 1e-6, 0);
    fit.problem.gradient[0] = 1e-3;
    fit.add(along(0, 1), 1e-6, -1e-4);
    BOOST_TEST(fit.solve(1.0) > 0);
    BOOST_TEST(fit.rows.relaxation() == 1e-6 - play / 2, boost::test_tools::tolerance(1e-5));
    BOOST_TEST(std::abs(fit.solution.step[0] - play / 2) < 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(a_row_that_is_there_twice_changes_nothing) {
  Fit once = slot(1e-6, 1e-6, 1e-3), twice = slot(1e-6, 1e-6, 1e-3);
  for (int i = 0; i < 5; ++i) twice.add(along(2, 1), 0.5e-6, -0.5e-6);
  once.solve(2e-3);
  twice.solve(2e-3);
  BOOST_TEST((once.solution.step - twice.solution.step).norm() < 1e-11);
  BOOST_TEST(std::abs(once.rows.relaxation() - twice.rows.relaxation()) < 1e-11);
}

BOOST_AUTO_TEST_CASE(random_rows_have_the_relaxation_that_a_search_finds) {
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int relaxed = 0, at_hard_bounds = 0, cut_short = 0;
  for (int i = 0; i < 300; ++i) {
    Fit fit;
    const double price = std::vector{1e-3, 1e-4, 3e-5}[std::size_t(i % 3)];
    std::vector<double> soft, hard;
    fit.problem.gradient << 2e-4 * feeler_test::random_vector(bits), 2e-4 * feeler_test::random_vector(bits);
    const int count = 2 + int(bits() % 20);
    double most = 0;
    for (int k = 0; k < count; ++k) {
      Vector6<double> row;
      row << feeler_test::random_direction(bits), 0.5 * feeler_test::random_vector(bits);
      soft.push_back(1e-6 * (1 - double(bits() % 1000) / 600));
      hard.push_back(std::min(soft.back(), -1e-8 * double(bits() % 1000)));
      fit.add(row, soft.back(), hard.back());
      most = std::max(most, soft.back() - hard.back());
    }
    const int solves = fit.solve(price);
    BOOST_TEST_REQUIRE(solves > 0);
    if (solves == 24) {  // as many as it may: what it has is feasible
      ++cut_short;
      for (int k = 0; k < count; ++k) BOOST_TEST(fit.problem.rows[std::size_t(k)].dot(fit.solution.step) >= hard[std::size_t(k)] - 1e-12);
      continue;
    }
    // min ½ |d|² + gᵀ d + price ξ is convex in ξ: no other does better, but for a thousandth of the price.
    const auto merit = [&](double relaxation) {
      for (int k = 0; k < count; ++k) fit.problem.bounds[std::size_t(k)] = std::max(hard[std::size_t(k)], soft[std::size_t(k)] - relaxation);
      QpSolution<double> solution;
      if (fit.solver.solve(fit.problem, solution) != QpStatus::optimal) return std::numeric_limits<double>::infinity();
      return solution.step.squaredNorm() / 2 + fit.problem.gradient.dot(solution.step) + price * relaxation;
    };
    const double found = fit.solution.step.squaredNorm() / 2 + fit.problem.gradient.dot(fit.solution.step) + price * fit.rows.relaxation();
    for (int k = 0; k <= 400; ++k)
      BOOST_TEST(found <= merit(most * k / 400) + 2e-3 * price * most, "problem " << i << " at " << k << ": " << found << " > "
                                                                                  << merit(most * k / 400) << ", " << fit.rows.relaxation() << " of "
                                                                                  << most);
    relaxed += fit.rows.relaxation() > 0;
    const auto& active = fit.solution.active;
    at_hard_bounds += std::any_of(active.begin(), active.end(), [&](const auto& a) { return fit.rows.is_hard(a.row); });
  }
  BOOST_TEST(relaxed > 50);
  BOOST_TEST(at_hard_bounds > 50);
  BOOST_TEST(cut_short == 0);
}

BOOST_AUTO_TEST_SUITE_END()
