#include "feeler/qp/dual/dual_tableau.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

#include <Eigen/Dense>

#include "feeler/qp/dual/held_minimum.hpp"
#include "feeler/qp/dual_active_set.hpp"
#include "support/general_problem.hpp"

BOOST_AUTO_TEST_SUITE(dual_tableau)

namespace {

using Problem = feeler::QpProblem<double>;
using Vector6 = feeler::Vector6<double>;

template <int lanes>
using Tableau = feeler::detail::DualTableau<double, lanes>;
using Tableaus = std::tuple<Tableau<2>, Tableau<4>>;

template <class AnyTableau>
bool find(AnyTableau& tableau, const Problem& problem, double tolerance = 1e-12) {
  const feeler_test::Quadratic f(problem);
  return tableau.find(problem, problem.bounds.data(), f.hessian, f.gradient, tolerance);
}

/// Rows in general position, and behind them one that all but faces the first.
Problem flat_wedge(std::mt19937& bits, int rows, bool is_diagonal, double angle) {
  Problem problem = feeler_test::general_problem(bits, rows, is_diagonal);
  const Vector6 first = problem.rows[0];
  problem.bounds[0] = 1.0;
  problem.add_row(angle * feeler_test::random_six(bits) - first, -1.0 + 0.1 * angle * feeler_test::unit(bits));
  return problem;
}

/// Of all subsets of the rows, held with equality, one at which the conditions of optimality are met.
struct Optimum {
  std::vector<int> rows;
  Eigen::VectorXd multipliers;
  double cost = 0;
};
double cost(const Problem& problem, const Vector6& x) { return x.dot(problem.hessian * x) / 2 + problem.gradient.dot(x); }
std::optional<Optimum> best_of_all_subsets(const Problem& problem) {
  const Eigen::LLT<feeler::Matrix6<double>> hessian(problem.hessian);
  for (unsigned subset = 0; subset < 1U << unsigned(problem.row_count); ++subset) {
    if (std::popcount(subset) > 6) continue;
    Optimum optimum;
    for (int k = 0; k < problem.row_count; ++k) {
      if ((subset >> unsigned(k)) & 1U) optimum.rows.push_back(k);
    }
    const auto count = Eigen::Index(optimum.rows.size());
    Eigen::MatrixXd a(count, 6);
    Eigen::VectorXd b(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      a.row(i) = Vector6(problem.rows[std::size_t(optimum.rows[std::size_t(i)])]).transpose();
      b[i] = problem.bounds[std::size_t(optimum.rows[std::size_t(i)])];
    }
    Vector6 x = -hessian.solve(problem.gradient);
    if (count > 0) {
      const Eigen::MatrixXd pushed = hessian.solve(Eigen::MatrixXd(a.transpose()));
      optimum.multipliers = (a * pushed).fullPivLu().solve(b - a * x);
      if (optimum.multipliers.minCoeff() < 0) continue;
      x += pushed * optimum.multipliers;
    }
    bool is_met = true;
    for (int k = 0; k < problem.row_count; ++k) {
      const double lacking = problem.bounds[std::size_t(k)] - problem.rows[std::size_t(k)].dot(x);
      is_met = is_met && lacking < 1e-9 * (1 + x.norm());
    }
    optimum.cost = cost(problem, x);
    if (is_met) return optimum;
  }
  return std::nullopt;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(the_rows_it_finds_are_the_best_of_all_subsets, AnyTableau, Tableaus) {
  constexpr unsigned seed = 71;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  AnyTableau tableau;
  int found = 0, refused = 0, with_rows_that_left = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool is_long = AnyTableau::row_capacity > 8 && i % 30 == 0;
    const Problem problem = feeler_test::general_problem(bits, is_long ? 11 : i % 9, i % 4 == 0);
    const bool is_found = find(tableau, problem);
    const auto optimum = best_of_all_subsets(problem);
    BOOST_TEST_REQUIRE(is_found == optimum.has_value());
    const auto& active = tableau.active().rows;
    if (!is_found) {  // the row that is refused is a sum of active ones, which leads away from its bound
      ++refused;
      BOOST_TEST_REQUIRE(tableau.refused() >= 0);
      const auto row = std::size_t(tableau.refused());
      Vector6 rest = problem.rows[row];
      double lacking = problem.bounds[row];
      for (int k = 0; k < active.size(); ++k) {
        const double share = tableau.shares()[std::size_t(k)];
        BOOST_TEST(share <= 0);
        rest -= share * problem.rows[std::size_t(active[k])];
        lacking -= share * problem.bounds[std::size_t(active[k])];
      }
      BOOST_TEST(rest.norm() < 1e-9);
      BOOST_TEST(lacking > 0);
      continue;
    }
    ++found;
    std::vector<int> rows(active.begin(), active.end());
    with_rows_that_left += tableau.steps() > int(rows.size());
    std::sort(rows.begin(), rows.end());
    BOOST_TEST_REQUIRE(rows == optimum->rows, boost::test_tools::per_element());
    for (int k = 0; k < active.size(); ++k) {
      const auto at = std::find(rows.begin(), rows.end(), active[k]) - rows.begin();
      BOOST_TEST(std::abs(tableau.multipliers()[std::size_t(k)] - optimum->multipliers[at]) < 1e-7 * (1 + optimum->multipliers.norm()));
    }
  }
  BOOST_TEST_MESSAGE(found << " found, " << with_rows_that_left << " of them with rows that left; " << refused << " refused");
  BOOST_TEST(found > 2000);
  BOOST_TEST(with_rows_that_left > 100);
  BOOST_TEST(refused > 10);
}

namespace {

void check_that_lanes_agree(unsigned seed, int most_rows) {
  std::mt19937 bits(seed);
  Tableau<1> plain;
  std::tuple<Tableau<2>, Tableau<4>, Tableau<8>> tableaus;
  for (int i = 0; i < 2000; ++i) {
    const Problem problem = feeler_test::general_problem(bits, i % (most_rows + 1), i % 4 == 0);
    const bool is_found = find(plain, problem);
    const auto agrees = [&](auto& tableau) {
      BOOST_TEST(find(tableau, problem) == is_found);
      BOOST_TEST(tableau.steps() == plain.steps());
      BOOST_TEST(tableau.refused() == plain.refused());
      BOOST_TEST_REQUIRE(tableau.active().rows.size() == plain.active().rows.size());
      for (int k = 0; k < plain.active().rows.size(); ++k) {
        BOOST_TEST(tableau.active().rows[k] == plain.active().rows[k]);
        BOOST_TEST(tableau.multipliers()[std::size_t(k)] == plain.multipliers()[std::size_t(k)]);
      }
    };
    std::apply([&](auto&... tableau) { (agrees(tableau), ...); }, tableaus);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_number_of_lanes_finds_the_same_bits) {
  constexpr unsigned seed = 72;
  BOOST_TEST_MESSAGE("seed " << seed);
  check_that_lanes_agree(seed, 8);
  check_that_lanes_agree(seed, 16);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(it_gives_up_where_a_row_depends_on_active_ones, AnyTableau, Tableaus) {
  Problem problem;  // min ½|x|², from 0
  problem.add_row(Vector6::Unit(0), 1.5);
  problem.add_row(-Vector6::Unit(0) + 1e-9 * Vector6::Unit(1), -1.4);
  AnyTableau tableau;
  BOOST_TEST(!find(tableau, problem));
  BOOST_TEST_REQUIRE(tableau.active().rows.size() == 1);  // that can be held
  BOOST_TEST(tableau.active().rows[0] == 0);
  BOOST_TEST(tableau.refused() == 1);

  problem.bounds[1] = -1.5;  // touches, and holds nothing
  BOOST_TEST(find(tableau, problem));
  BOOST_TEST_REQUIRE(tableau.active().rows.size() == 1);
  BOOST_TEST(tableau.active().rows[0] == 0);
  BOOST_TEST(tableau.multipliers()[0] == 1.5);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(forces_in_a_flat_wedge_lose_few_of_the_digits_that_its_table_does, AnyTableau, Tableaus) {
  constexpr unsigned seed = 75;
  BOOST_TEST_MESSAGE("seed " << seed);
  using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  std::mt19937 bits(seed);
  AnyTableau tableau;
  for (const double angle : {1e-2, 1e-4, 1e-5, 1e-6}) {
    int found = 0;
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      const Problem problem = flat_wedge(bits, 1 + i % 5, i % 4 == 0, angle);
      if (!find(tableau, problem)) continue;
      const auto& rows = tableau.active().rows;
      const auto is_active = [&](int row) { return std::find(rows.begin(), rows.end(), row) != rows.end(); };
      if (!is_active(0) || !is_active(problem.row_count - 1)) continue;
      ++found;
      Wide a(rows.size(), 6), b(rows.size(), 1), forces(rows.size(), 1);
      for (int k = 0; k < rows.size(); ++k) {
        a.row(k) = Vector6(problem.rows[std::size_t(rows[k])]).transpose().cast<long double>();
        b(k, 0) = problem.bounds[std::size_t(rows[k])];
        forces(k, 0) = tableau.multipliers()[std::size_t(k)];
      }
      const Eigen::LDLT<Wide> hessian(Wide(problem.hessian.cast<long double>()));
      const Wide table = a * hessian.solve(Wide(a.transpose()));
      const Wide expected = table.fullPivLu().solve(Wide(b + a * hessian.solve(Wide(problem.gradient.cast<long double>()))));
      const auto off = double((forces - expected).norm() / expected.norm());
      const double condition = double(table.norm() * table.inverse().norm());
      BOOST_TEST(off < 1e-8 + 1e-3 * std::numeric_limits<double>::epsilon() * condition);
      worst = std::max(worst, off);
    }
    BOOST_TEST_MESSAGE("angle " << angle << ": " << found << " found, forces off by up to " << worst);
    BOOST_TEST(found > 100);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(rows_that_nearly_depend_are_met_to_rounding_once_refined, AnyTableau, Tableaus) {
  constexpr unsigned seed = 74;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  AnyTableau tableau;
  feeler::detail::HeldMinimum<double, 2> minimum;
  int found = 0;
  double before = 0;
  for (int i = 0; i < 2000; ++i) {
    const Problem problem = flat_wedge(bits, 1 + i % 5, i % 4 == 0, 1e-4);
    if (!find(tableau, problem) || tableau.active().rows.size() < 2) continue;
    ++found;
    const feeler_test::Quadratic f(problem);
    int refinements = 0;
    const auto change_for = [&](const auto& lacking) {
      if (refinements == 0) {
        for (int k = 0; k < tableau.active().rows.size(); ++k) before = std::max(before, std::abs(lacking[std::size_t(k)]));
      }
      return ++refinements <= 2 ? tableau.change_for(lacking) : feeler::detail::Six<double>{};
    };
    minimum.place(problem, problem.bounds.data(), tableau.active(), tableau.multipliers(), f.hessian, f.gradient, change_for, 0.0);
    const Eigen::Map<const Vector6> x(minimum.x().data());
    for (int k = 0; k < tableau.active().rows.size(); ++k) {
      const auto row = std::size_t(tableau.active().rows[k]);
      BOOST_TEST(std::abs(problem.bounds[row] - problem.rows[row].dot(x)) < 1e-13 * (1 + x.norm()));
    }
  }
  BOOST_TEST_MESSAGE(found << " problems, up to " << before << " beside a row before");
  BOOST_TEST(found > 300);
  BOOST_TEST(before > 1e-11);  // there is something to refine
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_it_gives_up_the_solver_solves_and_goes_on_from_its_rows, AnyTableau, Tableaus) {
  constexpr unsigned seed = 73;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  AnyTableau tableau;
  feeler::DualActiveSet<double> solver;
  int given_up = 0;
  for (int i = 0; i < 2000; ++i) {
    Problem problem = feeler_test::general_problem(bits, 3 + i % 5, i % 4 == 0);
    const Vector6 sum =
        Vector6(problem.rows[0]) + Vector6(problem.rows[1]);  // and one that faces two, and agrees with them only within the tolerance
    problem.add_row(-sum, -problem.bounds[0] - problem.bounds[1] + 2e-13);
    if (find(tableau, problem, 1e-14)) continue;
    feeler::QpSolution<double> solution;
    if (solver.solve(problem, solution) == feeler::QpStatus::infeasible) {  // of other rows
      BOOST_TEST(solution.conflict.size() > 0);
      continue;
    }
    ++given_up;
    problem.bounds[std::size_t(problem.row_count - 1)] -= 4e-13;
    const auto optimum = best_of_all_subsets(problem);
    BOOST_TEST_REQUIRE(optimum.has_value());
    BOOST_TEST(std::abs(cost(problem, solution.step) - optimum->cost) < 1e-6 * (1 + std::abs(optimum->cost)));
    for (int k = 0; k < problem.row_count; ++k) BOOST_TEST(problem.bounds[std::size_t(k)] - problem.rows[std::size_t(k)].dot(solution.step) < 1e-12);
  }
  BOOST_TEST_MESSAGE(given_up << " given up and solved");
  BOOST_TEST(given_up > 100);
}

BOOST_AUTO_TEST_SUITE_END()
