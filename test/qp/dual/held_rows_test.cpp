#include "feeler/qp/dual/held_rows.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(held_rows)

namespace {

using Six = feeler::detail::Six<double>;
using Vector6 = feeler::Vector6<double>;

/// Its numbers, one by one.
template <class Rows>
std::vector<double> numbers_of(const typename Rows::Values& values) {
  alignas(64) std::array<double, std::size_t(Rows::capacity)> numbers;
  for (std::size_t g = 0; g < values.size(); ++g) feeler::detail::store(&numbers[g * std::size_t(Rows::lanes)], values[g]);
  return {numbers.begin(), numbers.end()};
}

template <class Check>
void for_every_number_of_lanes(const Check& check) {
  check.template operator()<1, 1>();
  check.template operator()<1, 4>();
  check.template operator()<2, 4>();
  check.template operator()<4, 4>();
  check.template operator()<1, 6>();
  check.template operator()<2, 6>();
  check.template operator()<4, 8>();
}

template <int lanes, int capacity>
void check_lacking(std::mt19937& bits, int count, int first) {
  using Rows = feeler::detail::HeldRows<double, lanes, capacity>;
  feeler::QpProblem<double> problem = feeler_test::general_problem(bits, 12, true);
  problem.bounds[0] = 1e3;  // is held by none of them
  feeler::WarmStart start;
  for (int k = 0; k < count; ++k) start.rows.push_back(1 + (k * 5 + first) % 11);
  const Vector6 x = feeler_test::random_six(bits);
  Six at;
  std::copy_n(x.data(), 6, at.begin());
  const Rows rows(problem, problem.bounds.data(), start);
  BOOST_TEST(rows.count() == count);
  const auto lacking = numbers_of<Rows>(rows.lacking(at)), bounds = numbers_of<Rows>(rows.bounds());
  std::vector<double> expected;
  for (const int row : start.rows) {
    const auto k = std::size_t(row);
    expected.push_back(double(static_cast<long double>(problem.bounds[k]) - Vector6(problem.rows[k]).cast<long double>().dot(x.cast<long double>())));
  }
  for (std::size_t k = 0; k < std::size_t(capacity); ++k) {
    const auto is_near = [&](double one) { return std::abs(lacking[k] - one) < 1e-14; };
    if (k >= std::size_t(count)) {
      BOOST_TEST(std::any_of(expected.begin(), expected.end(), is_near));
      continue;
    }
    BOOST_TEST(is_near(expected[k]));
    BOOST_TEST(bounds[k] == problem.bounds[std::size_t(start.rows[int(k)])]);
  }
}

template <int lanes, int capacity>
void check_forces(std::mt19937& bits, int count) {
  using Rows = feeler::detail::HeldRows<double, lanes, capacity>;
  const feeler::QpProblem<double> problem = feeler_test::general_problem(bits, 6, true);
  feeler::WarmStart start;
  for (int k = 0; k < count; ++k) start.rows.push_back(k);
  std::array<double, 6> forces;
  for (double& force : forces) force = feeler_test::fraction(bits);
  const Rows rows(problem, problem.bounds.data(), start);
  const auto values = rows.values(forces);
  const auto numbers = numbers_of<Rows>(values);
  Vector6 sum = Vector6::Zero();
  for (std::size_t k = 0; k < std::size_t(capacity); ++k) {
    BOOST_TEST(numbers[k] == (k < std::size_t(count) ? forces[k] : 0.0));
    if (k < std::size_t(count)) sum += forces[k] * problem.rows[k];
  }
  const Six found = rows.sum(values);
  BOOST_TEST((Eigen::Map<const Vector6>(found.data()) - sum).norm() < 1e-14);
}

template <int lanes, int capacity>
void check_signs() {
  using Rows = feeler::detail::HeldRows<double, lanes, capacity>;
  const feeler::QpProblem<double> problem;
  feeler::WarmStart start;
  const int count = std::min(capacity, 6);
  for (int k = 0; k < count; ++k) start.rows.push_back(0);
  const Rows rows(problem, problem.bounds.data(), start);
  std::array<double, 6> numbers{};
  BOOST_TEST(Rows::are_not_negative(rows.values(numbers)));
  for (int k = 0; k < count; ++k) {
    for (const double bad : {-1e-300, std::numeric_limits<double>::quiet_NaN()}) {
      numbers.fill(1.0);
      BOOST_TEST(Rows::are_not_negative(rows.values(numbers)));
      numbers[std::size_t(k)] = bad;
      BOOST_TEST(!Rows::are_not_negative(rows.values(numbers)));
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(rows_lack_what_long_double_says_and_what_fills_the_last_group_lacks_no_more_than_they) {
  constexpr unsigned seed = 103;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for_every_number_of_lanes([&]<int lanes, int capacity>() {
    for (int i = 0; i < 30; ++i) check_lacking<lanes, capacity>(bits, 1 + i % std::min(capacity, 6), i);
  });
}

BOOST_AUTO_TEST_CASE(behind_the_last_row_there_is_no_force) {
  constexpr unsigned seed = 104;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for_every_number_of_lanes([&]<int lanes, int capacity>() {
    for (int count = 0; count <= std::min(capacity, 6); ++count) check_forces<lanes, capacity>(bits, count);
  });
}

BOOST_AUTO_TEST_CASE(a_value_that_is_negative_or_no_number_is_seen_in_every_place) {
  for_every_number_of_lanes([]<int lanes, int capacity>() { check_signs<lanes, capacity>(); });
}

BOOST_AUTO_TEST_SUITE_END()
