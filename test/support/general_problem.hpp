// Quadratic programs of rows in general position, and as the parts of a solver take them.
#pragma once

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>

#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/problem.hpp"
#include "support/random_geometry.hpp"

namespace feeler_test {

/// With a Hessian that is diagonal or not.
inline feeler::QpProblem<double> general_problem(std::mt19937& bits, int rows, bool is_diagonal) {
  feeler::QpProblem<double> problem;
  feeler::Matrix6<double> root;
  for (int j = 0; j < 6; ++j) root.col(j) = random_six(bits);
  problem.hessian = root * root.transpose() + 0.1 * feeler::Matrix6<double>::Identity();
  if (is_diagonal) problem.hessian = feeler::Matrix6<double>(problem.hessian.diagonal().asDiagonal());
  problem.gradient = random_six(bits);
  for (int k = 0; k < rows; ++k) problem.add_row(random_six(bits), unit(bits));
  return problem;
}

inline feeler::detail::Six<double> in_six(const feeler::Vector6<double>& v) {
  feeler::detail::Six<double> numbers;
  std::copy_n(v.data(), 6, numbers.begin());
  return numbers;
}

/// The function of a problem, its Hessian factored in place.
struct Quadratic {
  feeler::detail::InverseHessian<double> hessian;
  feeler::detail::Six<double> gradient;

  explicit Quadratic(const feeler::QpProblem<double>& problem) {
    BOOST_TEST_REQUIRE(hessian.factor(problem.hessian));
    gradient = in_six(problem.gradient);
  }
};

}  // namespace feeler_test
