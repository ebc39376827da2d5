#include "feeler/qp/dual_active_set.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "support/qp_laws.hpp"

BOOST_AUTO_TEST_SUITE(dual_active_set)

using feeler::DualActiveSet;
using feeler::QpStatus;
using Problem = feeler::QpProblem<double>;
using Solution = feeler::QpSolution<double>;
using Vector = Eigen::Vector3d;
using feeler_test::contact_row;

namespace {

/// The problem min ½|d − target|².
Problem towards(const feeler::Vector6<double>& target) {
  Problem problem;
  problem.gradient = -target;
  return problem;
}

feeler::Vector6<double> six(double x, double y, double z, double a = 0, double b = 0, double c = 0) {
  feeler::Vector6<double> v;
  v << x, y, z, a, b, c;
  return v;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_answer_in_float_obeys_the_laws_of_a_qp_solver) { feeler_test::check_qp_laws<DualActiveSet<float>>(1); }
BOOST_AUTO_TEST_CASE(every_answer_in_double_obeys_the_laws_of_a_qp_solver) { feeler_test::check_qp_laws<DualActiveSet<double>>(2); }
BOOST_AUTO_TEST_CASE(every_answer_in_long_double_obeys_the_laws_of_a_qp_solver) { feeler_test::check_qp_laws<DualActiveSet<long double>>(3); }

BOOST_AUTO_TEST_CASE(a_box_on_the_floor_stops_at_the_floor_and_shares_its_weight) {
  // Four corners at ±0.1; the target is 0.3 below: each multiplier times 4 is the weight, and the step is
  // zero.
  Problem problem = towards(six(0, 0, -0.3));
  for (const Vector& arm : {Vector(0.1, 0.1, 0), Vector(-0.1, 0.1, 0), Vector(-0.1, -0.1, 0), Vector(0.1, -0.1, 0)})
    problem.add_row(contact_row<double>(Vector::UnitZ(), arm), 0);
  DualActiveSet<double> solver;
  Solution solution;
  BOOST_TEST((solver.solve(problem, solution) == QpStatus::optimal));
  BOOST_TEST(solution.step.norm() < 1e-15);
  double weight = 0;
  for (const auto& active : solution.active) weight += active.multiplier;
  BOOST_TEST(std::abs(weight - 0.3) < 1e-14);
}

BOOST_AUTO_TEST_CASE(a_corner_of_three_walls_is_found_and_its_multipliers_are_the_penetrations) {
  Problem problem = towards(six(-1, -2, 5, 0.5, 0, 0));
  for (int k = 0; k < 3; ++k) problem.add_row(contact_row<double>(Vector::Unit(k), Vector::Zero()), 0.25 * k);
  DualActiveSet<double> solver;
  Solution solution;
  BOOST_TEST((solver.solve(problem, solution) == QpStatus::optimal));
  BOOST_TEST((solution.step - six(0, 0.25, 5, 0.5, 0, 0)).norm() < 1e-15);
  BOOST_TEST_REQUIRE(solution.active.size() == 2);
  for (const auto& active : solution.active) BOOST_TEST(std::abs(active.multiplier - (active.row == 0 ? 1 : 2.25)) < 1e-15);
}

BOOST_AUTO_TEST_CASE(sliding_out_of_a_wedge_is_found_however_flat_the_wedge) {
  // Walls z ≥ θ x and −z ≥ θ x − … meet in an edge; the target lies beyond it, so the answer is the edge.
  for (const double angle : {1e-2, 1e-4, 1e-5, 1e-6}) {
    Problem problem = towards(six(1, 0, 0.2));
    const Vector up(-std::sin(angle), 0, std::cos(angle)), down(-std::sin(angle), 0, -std::cos(angle));
    const double edge = 0.5;  // x of the edge
    problem.add_row(contact_row<double>(up, Vector::Zero()), -std::sin(angle) * edge);
    problem.add_row(contact_row<double>(down, Vector::Zero()), -std::sin(angle) * edge);
    DualActiveSet<double> solver;
    Solution solution;
    BOOST_TEST((solver.solve(problem, solution) == QpStatus::optimal));
    BOOST_TEST((solution.step - six(edge, 0, 0)).norm() < 1e-15 / angle * 100);
  }
}

BOOST_AUTO_TEST_CASE(a_slot_that_is_too_narrow_is_infeasible_and_the_conflict_names_both_walls) {
  Problem problem = towards(six(0, 0, 1));
  problem.add_row(contact_row<double>(Vector::UnitX(), Vector::Zero()), -1);
  problem.add_row(contact_row<double>(Vector::UnitZ(), Vector::Zero()), 0.1);
  problem.add_row(contact_row<double>(Vector(0, 0, -1), Vector::Zero()), 0);
  DualActiveSet<double> solver;
  Solution solution;
  BOOST_TEST((solver.solve(problem, solution) == QpStatus::infeasible));
  BOOST_TEST_REQUIRE(solution.conflict.size() == 2);
  BOOST_TEST(solution.conflict[0] + solution.conflict[1] == 3);
}

BOOST_AUTO_TEST_CASE(a_slot_of_walls_that_are_parallel_but_for_a_hair_is_infeasible_without_a_second_start) {
  // The walls overlap by 2 µm, so the edge where they meet is 200 m away at the largest angle; the target, a millimetre.
  for (const double angle : {0.0, 1e-13, 1e-11, 4e-10, 1e-8}) {
    Problem problem = towards(six(0, 0, 1e-3));
    const Vector arm(0, 0.1, 0);
    problem.add_row(contact_row<double>(Vector(std::sin(angle), 0, std::cos(angle)), arm), 1e-6);
    problem.add_row(contact_row<double>(Vector(0, 0, -1), arm), 1e-6);
    for (int k = 0; k < 20; ++k) problem.add_row(contact_row<double>(Vector(std::cos(k), std::sin(k), 0), arm), -1);
    DualActiveSet<double> solver;
    Solution solution;
    BOOST_TEST_INFO("angle " << angle);
    BOOST_TEST((solver.solve(problem, solution) == QpStatus::infeasible));
    BOOST_TEST(solution.conflict.size() == 2);
    BOOST_TEST(solution.iterations == 2);  // one wall, then the other
  }
}

BOOST_AUTO_TEST_CASE(a_problem_with_a_row_of_no_numbers_is_never_called_solved) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nothing = std::numeric_limits<double>::quiet_NaN();
  DualActiveSet<double> solver;
  for (const int count : {1, 2, 8, 9, 40}) {
    for (const double bad : {nothing, infinity}) {
      for (const bool is_in_bound : {false, true}) {
        if (bad == infinity && !is_in_bound) continue;  // such a row may be met
        for (const int bad_row : {0, count - 1}) {
          Problem problem = towards(six(0, 0, -1));
          for (int k = 0; k < count; ++k) problem.add_row(six(0.01 * k, 0, 1, 0.1, 0.02 * k), 0.5 - k);
          if (is_in_bound) problem.bounds[std::size_t(bad_row)] = bad;
          else problem.rows[std::size_t(bad_row)][3] = bad;
          Solution solution;
          for (const bool is_told : {false, true}) {
            feeler::WarmStart start;
            if (is_told) start.rows.push_back(0);
            BOOST_TEST_INFO(count << " rows, " << bad << (is_in_bound ? " as bound" : "") << " of row " << bad_row);
            BOOST_TEST((solver.solve(problem, start, solution) != QpStatus::optimal));
            BOOST_TEST(solution.step.allFinite());
            for (const auto& active : solution.active) BOOST_TEST((std::isfinite(active.multiplier) && active.multiplier >= 0));
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_step_called_optimal_meets_every_row_in_float_too) {
  constexpr unsigned seed = 6;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  DualActiveSet<float> solver;
  feeler::QpSolution<float> solution;
  int optimal = 0;
  for (int i = 0; i < 30000; ++i) {
    const double scale = feeler_test::magnitude(bits, -6, 3);
    const auto problem = feeler_test::random_problem<float>(bits, 2 + i % 2, scale);  // slots and rank-deficient rows
    if (solver.solve(problem, solution) != QpStatus::optimal) continue;
    ++optimal;
    const auto kkt = feeler_test::kkt_residuals(feeler_test::WideProblem(problem), solution);
    const long double length = solution.step.cast<long double>().norm() + static_cast<long double>(scale);
    const long double missed = std::max(kkt.violation, kkt.slackness);
    if (missed > 64 * static_cast<long double>(std::numeric_limits<float>::epsilon()) * length)
      BOOST_ERROR("problem " << i << " misses a row by " << missed << " at a length of " << length);
  }
  BOOST_TEST(optimal > 15000);
}

BOOST_AUTO_TEST_CASE(a_start_from_the_rows_of_the_answer_finds_it_at_once) {
  constexpr unsigned seed = 8;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  DualActiveSet<double> solver;
  Solution cold, warm;
  int optimal = 0, at_once = 0;
  for (int i = 0; i < 6000; ++i) {
    const double scale = feeler_test::magnitude(bits, -6, 3);
    const Problem problem = feeler_test::random_problem<double>(bits, i % feeler_test::random_problem_families, scale);
    const QpStatus status = solver.solve(problem, cold);
    feeler_test::check_answer(problem, solver.solve(problem, feeler::WarmStart(cold), warm), warm, scale, "problem " + std::to_string(i));
    if (status != QpStatus::optimal) continue;
    ++optimal;
    at_once += warm.iterations <= 1 ? 1 : 0;
  }
  BOOST_TEST(optimal > 4000);
  BOOST_TEST(at_once > 0.9 * optimal);
}

BOOST_AUTO_TEST_CASE(a_start_from_any_rows_ends_at_the_same_answer) {
  constexpr unsigned seed = 9;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  DualActiveSet<double> solver;
  Solution solution;
  for (int i = 0; i < 6000; ++i) {
    const double scale = feeler_test::magnitude(bits, -6, 3);
    const Problem problem = feeler_test::random_problem<double>(bits, i % feeler_test::random_problem_families, scale);
    feeler::WarmStart start;  // repeated rows and rows that do not exist among them
    for (int k = feeler_test::below(bits, 7); k > 0; --k) start.rows.push_back(feeler_test::below(bits, 12) - 2);
    const QpStatus status = solver.solve(problem, start, solution);
    feeler_test::check_answer(problem, status, solution, scale, "problem " + std::to_string(i));
    Solution again;
    BOOST_TEST((solver.solve(problem, start, again) == status));
    BOOST_TEST(feeler_test::is_same(solution, again));
  }
}

/// As the worst of the public dense test problems: norms from 1 to 6000, few directions with small errors, opposite rows.
/// All rows hold at a step of size one, up to rounding of the bounds.
/// @param error  of the directions, relative
Problem nearly_dependent_rows(std::mt19937& bits, double error) {
  Problem problem;
  feeler::Matrix6<double> root;
  for (int j = 0; j < 6; ++j) root.col(j) = feeler_test::random_six(bits);
  problem.hessian = root * root.transpose() + 1e-3 * feeler::Matrix6<double>::Identity();
  const feeler::Vector6<double> feasible = feeler_test::random_six(bits), target = 3 * feeler_test::random_six(bits);
  problem.gradient = -(problem.hessian * target);
  std::array<feeler::Vector6<double>, 6> directions;
  for (auto& direction : directions) direction = feeler_test::random_six(bits).normalized();
  const int rank = 2 + feeler_test::below(bits, 5), rows = 30 + feeler_test::below(bits, 226);
  while (problem.row_count < rows) {
    feeler::Vector6<double> row = error * feeler_test::random_six(bits);
    for (int j = 0; j < rank; ++j) row += feeler_test::unit(bits) * directions[std::size_t(j)];
    if (problem.row_count > 0 && feeler_test::below(bits, 3) == 0) {
      row = problem.rows[std::size_t(feeler_test::below(bits, problem.row_count))];
      row = (feeler_test::below(bits, 2) == 0 ? -1 : 1) * row.normalized() + error * feeler_test::random_six(bits);
    }
    if (row.norm() < 0.01) continue;
    const double norm = feeler_test::magnitude(bits, 0, 3.78);
    const double room = feeler_test::below(bits, 20) == 0 ? 0 : 0.3 * feeler_test::fraction(bits);
    row *= norm / row.norm();
    problem.add_row(row, row.dot(feasible) - norm * room);
  }
  return problem;
}

BOOST_AUTO_TEST_CASE(hundreds_of_rows_of_any_size_that_nearly_depend_are_solved_to_a_nanometre) {
  constexpr unsigned seed = 10;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  DualActiveSet<double> solver;
  solver.tolerance = 1e-10;
  Solution cold, warm;
  for (int i = 0; i < 1500; ++i) {
    const double error = i % 3 == 0 ? 0 : feeler_test::magnitude(bits, -9, -3);
    const Problem problem = nearly_dependent_rows(bits, error);
    BOOST_TEST((solver.solve(problem, cold) == QpStatus::optimal));
    BOOST_TEST((solver.solve(problem, feeler::WarmStart(cold), warm) == QpStatus::optimal));
    for (const Solution& solution : {cold, warm}) {
      const auto kkt = feeler_test::kkt_residuals(feeler_test::WideProblem(problem), solution);
      BOOST_TEST(kkt.stationarity < 1e-11L);
      BOOST_TEST(std::max(kkt.violation, kkt.slackness) < 1e-9L);
    }
  }
}

BOOST_AUTO_TEST_CASE(rows_that_depend_up_to_rounding_are_in_doubt_but_never_infeasible) {
  constexpr unsigned seed = 112;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  DualActiveSet<double> solver;
  solver.tolerance = 1e-10;
  Solution solution;
  int solved = 0;
  constexpr int problems = 12000;
  for (int i = 0; i < problems; ++i) {
    const Problem problem = nearly_dependent_rows(bits, feeler_test::magnitude(bits, -14, -9));
    const QpStatus status = solver.solve(problem, solution);
    BOOST_TEST((status == QpStatus::optimal || status == QpStatus::iteration_limit));
    if (status != QpStatus::optimal) continue;
    ++solved;
    const auto kkt = feeler_test::kkt_residuals(feeler_test::WideProblem(problem), solution);
    BOOST_TEST(std::max(kkt.violation, kkt.slackness) < 1e-9L);
  }
  BOOST_TEST(solved > 0.98 * problems);
}

BOOST_AUTO_TEST_CASE(units_that_differ_by_a_power_of_two_give_the_same_bits) {
  constexpr unsigned seed = 4;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  DualActiveSet<double> solver, scaled;
  scaled.tolerance = solver.tolerance * 1024;
  for (int i = 0; i < 500; ++i) {
    const Problem problem = feeler_test::random_problem<double>(bits, i % feeler_test::random_problem_families, 0.01);
    Problem larger = problem;  // every length of the step times 1024
    larger.gradient *= 1024;
    for (int k = 0; k < problem.row_count; ++k) larger.bounds[std::size_t(k)] *= 1024;
    Solution a, b;
    BOOST_TEST((solver.solve(problem, a) == scaled.solve(larger, b)));
    BOOST_TEST((a.step * 1024 == b.step));
  }
}

// What chooses rows has the range of float, what decides has not.
BOOST_AUTO_TEST_CASE(hessians_and_lengths_far_beyond_float_obey_the_laws) {
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  DualActiveSet<double> solver;
  for (const int exponent : {-280, -130, -70, 70, 130, 280}) {
    const double factor = std::ldexp(1.0, exponent);
    for (int i = 0; i < 120; ++i) {
      constexpr double scale = 0.01;
      const Problem problem = feeler_test::random_problem<double>(bits, i % feeler_test::random_problem_families, scale);
      Problem stiff = problem, large = problem;
      stiff.hessian *= factor;
      stiff.gradient *= factor;
      large.gradient *= factor;
      for (int k = 0; k < problem.row_count; ++k) large.bounds[std::size_t(k)] *= factor;
      const std::string name = "exponent " + std::to_string(exponent) + " problem " + std::to_string(i);
      const feeler_test::QpPromise promise;
      Solution solution;
      solver.tolerance = 2e-13;
      feeler_test::check_answer(stiff, solver.solve(stiff, solution), solution, scale, "stiff " + name, promise);
      feeler_test::QpPromise large_promise;
      large_promise.tolerance *= factor;
      solver.tolerance *= factor;
      feeler_test::check_answer(large, solver.solve(large, solution), solution, factor * scale, "large " + name, large_promise);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
