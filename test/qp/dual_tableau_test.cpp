#include "feeler/qp/dual_tableau.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

#include <Eigen/Dense>

#include "feeler/qp/dual_active_set.hpp"
#include "support/general_problem.hpp"

BOOST_AUTO_TEST_SUITE(dual_tableau)

namespace {

using Problem = feeler::QpProblem<double>;
using Six = feeler::detail::Six<double>;
using Vector6 = feeler::Vector6<double>;

template <int lanes>
bool find(feeler::detail::DualTableau<double, lanes>& tableau, const Problem& problem) {
  feeler::detail::InverseHessian<double> hessian;
  BOOST_TEST_REQUIRE(hessian.factor(problem.hessian));
  Six gradient;
  std::copy_n(problem.gradient.data(), 6, gradient.begin());
  return tableau.find(problem, problem.bounds.data(), hessian, gradient, 1e-12);
}

/// The rows that are active at the minimum, with their multipliers, of all subsets of the rows: that which meets the conditions of optimality.
struct Optimum {
  std::vector<int> rows;
  Eigen::VectorXd multipliers;
};
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
    optimum.multipliers = (a * hessian.solve(Eigen::MatrixXd(a.transpose()))).fullPivLu().solve(b + a * hessian.solve(problem.gradient));
    if (count > 0 && optimum.multipliers.minCoeff() < 0) continue;
    const Vector6 x = hessian.solve(a.transpose() * optimum.multipliers - problem.gradient);
    bool is_met = true;
    for (int k = 0; k < problem.row_count; ++k) {
      const double lacking = problem.bounds[std::size_t(k)] - problem.rows[std::size_t(k)].dot(x);
      is_met = is_met && lacking < 1e-9 * (1 + x.norm());
    }
    if (is_met) return optimum;
  }
  return std::nullopt;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_rows_it_finds_are_the_best_of_all_subsets) {
  constexpr unsigned seed = 71;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  feeler::detail::DualTableau<double, 2> tableau;
  int found = 0, refused = 0, with_rows_that_left = 0;
  for (int i = 0; i < 3000; ++i) {
    const Problem problem = feeler_test::general_problem(bits, i % 9, i % 4 == 0);
    const bool is_found = find(tableau, problem);
    const auto optimum = best_of_all_subsets(problem);
    if (!optimum) continue;  // no step meets all rows
    if (!is_found) {
      ++refused;
      continue;
    }
    ++found;
    std::vector<int> rows(tableau.active().rows.begin(), tableau.active().rows.end());
    with_rows_that_left += tableau.steps() > int(rows.size());
    std::sort(rows.begin(), rows.end());
    BOOST_TEST_REQUIRE(rows == optimum->rows, boost::test_tools::per_element());
    for (int k = 0; k < tableau.active().rows.size(); ++k) {
      const auto at = std::find(rows.begin(), rows.end(), tableau.active().rows[k]) - rows.begin();
      BOOST_TEST(std::abs(tableau.multipliers()[std::size_t(k)] - optimum->multipliers[at]) < 1e-7 * (1 + optimum->multipliers.norm()));
    }
  }
  BOOST_TEST_MESSAGE(found << " found, " << with_rows_that_left << " of them with rows that left; " << refused << " given up");
  BOOST_TEST(found > 2000);
  BOOST_TEST(with_rows_that_left > 100);
  BOOST_TEST(refused < found / 10);
}

BOOST_AUTO_TEST_CASE(every_number_of_lanes_finds_the_same_bits) {
  constexpr unsigned seed = 72;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  feeler::detail::DualTableau<double, 1> plain;
  std::tuple<feeler::detail::DualTableau<double, 2>, feeler::detail::DualTableau<double, 4>, feeler::detail::DualTableau<double, 8>> tableaus;
  for (int i = 0; i < 2000; ++i) {
    const Problem problem = feeler_test::general_problem(bits, i % 9, i % 4 == 0);
    const bool is_found = find(plain, problem);
    const auto agrees = [&](auto& tableau) {
      BOOST_TEST(find(tableau, problem) == is_found);
      BOOST_TEST(tableau.steps() == plain.steps());
      BOOST_TEST_REQUIRE(tableau.active().rows.size() == plain.active().rows.size());
      for (int k = 0; k < plain.active().rows.size(); ++k) {
        BOOST_TEST(tableau.active().rows[k] == plain.active().rows[k]);
        BOOST_TEST(tableau.multipliers()[std::size_t(k)] == plain.multipliers()[std::size_t(k)]);
      }
    };
    std::apply([&](auto&... tableau) { (agrees(tableau), ...); }, tableaus);
  }
}

BOOST_AUTO_TEST_CASE(it_gives_up_where_a_row_all_but_depends_on_active_ones) {
  Problem problem;  // min ½|x|², from 0
  problem.add_row(Vector6::Unit(0), 1.5);
  problem.add_row(-Vector6::Unit(0) + 1e-3 * Vector6::Unit(1), -1.4);
  feeler::detail::DualTableau<double, 2> tableau;
  BOOST_TEST(!find(tableau, problem));
  BOOST_TEST_REQUIRE(tableau.active().rows.size() == 1);  // that can be held
  BOOST_TEST(tableau.active().rows[0] == 0);

  problem.bounds[1] = -1.5;  // touches, and holds nothing
  BOOST_TEST(find(tableau, problem));
  BOOST_TEST_REQUIRE(tableau.active().rows.size() == 1);
  BOOST_TEST(tableau.active().rows[0] == 0);
  BOOST_TEST(tableau.multipliers()[0] == 1.5);
}

BOOST_AUTO_TEST_CASE(what_it_gives_up_the_solver_solves_and_goes_on_from_its_rows) {
  constexpr unsigned seed = 73;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  feeler::detail::DualTableau<double, 2> tableau;
  feeler::DualActiveSet<double> solver;
  int given_up = 0;
  for (int i = 0; i < 2000; ++i) {
    Problem problem = feeler_test::general_problem(bits, 3 + i % 5, i % 4 == 0);
    const Vector6 first = problem.rows[0];  // and one that all but repeats it
    problem.add_row(first + 1e-5 * feeler_test::random_six(bits), problem.bounds[0] + 1e-5 * feeler_test::unit(bits));
    if (find(tableau, problem)) continue;
    const auto optimum = best_of_all_subsets(problem);
    if (!optimum) continue;
    ++given_up;
    feeler::QpSolution<double> solution;
    BOOST_TEST((solver.solve(problem, solution) == feeler::QpStatus::optimal));
    std::vector<int> rows;
    for (const auto& active : solution.active) rows.push_back(active.row);
    std::sort(rows.begin(), rows.end());
    BOOST_TEST(rows == optimum->rows, boost::test_tools::per_element());
  }
  BOOST_TEST(given_up > 100);
}

BOOST_AUTO_TEST_SUITE_END()
