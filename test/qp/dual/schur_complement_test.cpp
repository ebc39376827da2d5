#include "feeler/qp/dual/schur_complement.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include <Eigen/Dense>

#include "feeler/qp/dual/held_rows.hpp"
#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(schur_complement)

namespace {

using feeler::detail::HeldRows;
using Vector6 = feeler::Vector6<double>;

/// Checks the solutions of two right sides, the one that is swept along and one of later.
template <int lanes, int capacity>
void check_against_eigen(std::mt19937& bits, int rows, bool is_diagonal) {
  using Rows = HeldRows<double, lanes, capacity>;
  const auto problem = feeler_test::general_problem(bits, rows, is_diagonal);
  const feeler_test::Quadratic f(problem);
  feeler::WarmStart all;
  Eigen::MatrixXd a(rows, 6);
  for (int k = 0; k < rows; ++k) all.rows.push_back(k), a.row(k) = Vector6(problem.rows[std::size_t(k)]).transpose();
  const Eigen::MatrixXd s = a * problem.hessian.inverse() * a.transpose();
  const Rows held(problem, problem.bounds.data(), all);
  feeler::detail::SchurComplement<Rows> schur(held, f.hessian);

  std::array<double, 6> first, second;
  for (std::size_t i = 0; i < 6; ++i) first[i] = feeler_test::unit(bits), second[i] = feeler_test::unit(bits);
  auto solution = held.values(first);
  const bool is_solved = schur.sweep_and_solve(solution);
  const double least_share = 1 / (s.inverse().diagonal().array() * s.diagonal().array()).maxCoeff();  // that a row has for itself
  if (least_share > 2e-3) BOOST_TEST(is_solved);
  if (!is_solved) return;
  const auto check = [&](const typename Rows::Values& values, const std::array<double, 6>& right) {
    alignas(64) std::array<double, std::size_t(capacity)> numbers;
    for (std::size_t g = 0; g < values.size(); ++g) feeler::detail::store(&numbers[g * lanes], values[g]);
    const Eigen::VectorXd expected = s.fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(right.data(), rows));
    for (int k = 0; k < rows; ++k) BOOST_TEST(std::abs(numbers[std::size_t(k)] - expected[k]) < 1e-9 * (1 + expected.norm()));
  };
  check(solution, first);
  check(schur.solve(held.values(second)), second);
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_swept_solves_the_system_in_every_number_of_lanes) {
  constexpr unsigned seed = 45;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 300; ++i) {
    const bool is_diagonal = i % 3 == 0;
    check_against_eigen<1, 1>(bits, 1, is_diagonal);
    check_against_eigen<1, 4>(bits, 1 + i % 4, is_diagonal);
    check_against_eigen<2, 4>(bits, 1 + i % 4, is_diagonal);
    check_against_eigen<4, 4>(bits, 1 + i % 4, is_diagonal);
    check_against_eigen<1, 6>(bits, 1 + i % 6, is_diagonal);
    check_against_eigen<2, 6>(bits, 1 + i % 6, is_diagonal);
    check_against_eigen<4, 8>(bits, 1 + i % 6, is_diagonal);
  }
}

BOOST_AUTO_TEST_SUITE_END()
