#include "feeler/qp/dual/lower_rows.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstddef>
#include <random>

#include <Eigen/Dense>

#include "support/general_problem.hpp"

BOOST_AUTO_TEST_SUITE(lower_rows)

namespace {

using Vector6 = feeler::Vector6<double>;
constexpr int capacity = 24;

template <int lanes>
void check_against_eigen(unsigned seed) {
  using Rows = feeler::detail::LowerRows<double, lanes, capacity>;
  using Group = typename Rows::Group;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  Rows rows;  // one for all problems
  for (int i = 0; i < 50; ++i) {
    const auto problem = feeler_test::general_problem(bits, 1 + i % capacity, i % 3 == 0);
    const feeler_test::Quadratic f(problem);
    rows.start(problem, f.hessian);
    const auto pivots = feeler::detail::spread_six<Group>(f.hessian.inverse_pivots());
    for (int k = 0; k < problem.row_count; k += lanes) rows.scale(k, pivots);
    const Eigen::LLT<feeler::Matrix6<double>> expected(problem.hessian);  // H = CCᵀ, C = L·√D
    const Vector6 root = expected.matrixLLT().diagonal();
    for (int k = 0; k < problem.row_count; ++k) {
      const Vector6 y = root.cwiseProduct(Vector6(expected.matrixL().solve(Vector6(problem.rows[std::size_t(k)]))));
      const Vector6 scaled = y.cwiseQuotient(root.cwiseAbs2());
      const auto row = rows.row(k), scaled_here = rows.scaled(row);
      const auto in_lanes = rows.scaled_row(k);
      const auto group = rows.at(k - k % lanes);
      for (std::size_t j = 0; j < 6; ++j) {
        const auto at = Eigen::Index(j);
        BOOST_TEST(std::abs(row[j] - y[at]) < 1e-11 * (1 + y.norm()));
        BOOST_TEST(std::abs(scaled_here[j] - scaled[at]) < 1e-11 * (1 + scaled.norm()));
        BOOST_TEST(feeler::detail::in_lanes<double>(group[j])[std::size_t(k % lanes)] == row[j]);
        for (const double number : feeler::detail::in_lanes<double>(in_lanes[j])) BOOST_TEST(number == scaled_here[j]);
      }
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(rows_have_the_coordinates_in_which_the_hessian_of_eigen_is_diagonal) {
  check_against_eigen<1>(147);
  check_against_eigen<2>(148);
  check_against_eigen<4>(149);
}

BOOST_AUTO_TEST_SUITE_END()
