#include "feeler/qp/dual/active_operators.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <Eigen/Dense>

#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(active_operators)

namespace {

using Six = feeler::detail::Six<double>;
using feeler_test::in_six;
using Matrix6 = feeler::Matrix6<double>;
using Vector6 = feeler::Vector6<double>;
using Wide = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// The first six numbers.
template <class Numbers>
feeler::Vector6<long double> in_vector(const Numbers& numbers) {
  return Eigen::Map<const Vector6>(numbers.data()).template cast<long double>();
}

/// Operators, and the rows that they are to be of.
template <int lanes>
struct Followed {
  using Operators = feeler::detail::ActiveOperators<double, lanes>;
  Operators operators;
  Wide inverse;
  std::vector<Vector6> rows;

  void add(const Vector6& row) {
    const Six a = in_six(row);
    operators.apply(a);
    const double slope = feeler::detail::dot_of_six<double>(a, operators.image().step);
    operators.add(a, slope);
    rows.push_back(row);
  }
  void drop(int slot, const feeler::detail::InverseHessian<double>& hessian) {
    const Six dual = operators.dual(slot), curved = hessian.hessian_times(dual);
    operators.apply(curved);
    operators.drop(slot, hessian, dual, feeler::detail::dot(dual, curved));
    rows[std::size_t(slot)] = rows.back();
    rows.pop_back();
  }
  /// All that they say, by their definition in long double.
  /// @param v  some vector
  void check(const Vector6& v, bool is_projector_first) {
    const auto count = Eigen::Index(rows.size());
    BOOST_TEST_REQUIRE(operators.used() == int(count));
    Wide n(6, count);
    for (Eigen::Index i = 0; i < count; ++i) n.col(i) = rows[std::size_t(i)].cast<long double>();
    Wide shares(count, 6), projector = inverse;
    if (count > 0) {
      shares = Wide(n.transpose() * inverse * n).partialPivLu().solve(Wide(n.transpose() * inverse));
      projector = inverse - inverse * n * shares;
    }
    const long double tolerance = 1e-9L * (1 + shares.norm() + inverse.norm());
    if (is_projector_first) BOOST_TEST((projector_said() - projector).norm() < tolerance);
    operators.apply(in_six(v));
    const Wide wide = v.cast<long double>();
    BOOST_TEST((Wide(in_vector(operators.image().step)) - projector * wide).norm() < tolerance);
    for (Eigen::Index i = 0; i < count; ++i) {
      const long double share = (shares.row(i) * wide)(0, 0);
      BOOST_TEST(std::abs(static_cast<long double>(operators.image().share[std::size_t(i)]) - share) < tolerance);
      BOOST_TEST((in_vector(operators.dual(int(i))).transpose() - shares.row(i)).norm() < tolerance);
      BOOST_TEST((in_vector(operators.normal(int(i))) == rows[std::size_t(i)].cast<long double>()));
    }
    Six along{};
    Wide expected = Wide::Zero(6, 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      along[i] = double(i) - 1.5;
      expected += static_cast<long double>(along[i]) * shares.row(Eigen::Index(i)).transpose();
    }
    BOOST_TEST((Wide(in_vector(operators.step_of(along))) - expected).norm() < 10 * tolerance);
    BOOST_TEST((projector_said() - projector).norm() < tolerance);
  }
  Wide projector_said() {
    Wide said(6, 6);
    const auto p = operators.projector();
    for (std::size_t j = 0; j < 6; ++j) said.col(Eigen::Index(j)) = in_vector(p[j]);
    return said;
  }
};

template <int lanes>
void check_rows_that_come_and_go(unsigned seed) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  Followed<lanes> followed;  // one for all problems: nothing of one is left for the next
  for (int i = 0; i < 12; ++i) {
    const auto problem = feeler_test::general_problem(bits, 0, i % 2 == 0);
    feeler_test::Quadratic f(problem);
    f.hessian.invert();
    followed.operators.reset(f.hessian);
    followed.inverse = Wide(problem.hessian.cast<long double>()).fullPivLu().inverse();
    followed.rows.clear();
    followed.check(feeler_test::random_six(bits), i % 4 < 2);
    for (int change = 0; change < 16; ++change) {
      const int count = int(followed.rows.size());
      const bool is_drop = count == 5 || (count > 0 && feeler_test::below(bits, 3) == 0);  // with six nothing is left of P
      if (is_drop) followed.drop(feeler_test::below(bits, count), f.hessian);
      else followed.add(feeler_test::random_six(bits));
      if (i % 3 == 0) followed.operators.rebuild(f.hessian);
      followed.check(feeler_test::random_six(bits), feeler_test::below(bits, 2) == 0);
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(rows_that_come_and_go_leave_the_operators_of_those_that_are_there) {
  check_rows_that_come_and_go<1>(105);
  check_rows_that_come_and_go<2>(106);
  check_rows_that_come_and_go<4>(107);
  check_rows_that_come_and_go<8>(108);
}

// Of a row at 1e-7 rad to an active one P leaves 1e-7, with an error of 1e-16 along the active one, which is too much.
BOOST_AUTO_TEST_CASE(what_is_projected_again_is_orthogonal_to_the_active_rows_to_its_own_rounding) {
  constexpr unsigned seed = 109;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  double once = 0, twice = 0;
  for (int i = 0; i < 300; ++i) {
    const auto problem = feeler_test::general_problem(bits, 0, i % 2 == 0);
    feeler_test::Quadratic f(problem);
    f.hessian.invert();
    Followed<2> followed;
    followed.operators.reset(f.hessian);
    for (int k = 0; k < 3; ++k) followed.add(feeler_test::random_six(bits));
    const Vector6 near = followed.rows[0] - 0.5 * followed.rows[1] + 1e-7 * feeler_test::random_six(bits);
    const auto angle = [&] {
      const Eigen::Map<const Vector6> step(followed.operators.image().step.data());
      double worst = 0;
      for (const Vector6& row : followed.rows) worst = std::max(worst, std::abs(row.dot(step)) / (row.norm() * step.norm()));
      return worst;
    };
    followed.operators.apply(in_six(near));
    once = std::max(once, angle());
    followed.operators.project_again();
    twice = std::max(twice, angle());
  }
  BOOST_TEST_MESSAGE("off by " << once << " rad, then by " << twice);
  BOOST_TEST(once > 1e-11);
  BOOST_TEST(twice < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
