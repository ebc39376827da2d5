// The laws that every QP solver obeys, as one call: check_qp_laws<Solver>().
#pragma once

#include <boost/test/unit_test.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "feeler/qp/problem.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/solution.hpp"
#include "support/random_geometry.hpp"

namespace feeler_test {

using WideReal = long double;
using Wide6 = Eigen::Matrix<WideReal, 6, 1>;
using WideMatrix6 = Eigen::Matrix<WideReal, 6, 6>;
using WideRows = Eigen::Matrix<WideReal, Eigen::Dynamic, 6>;
using WideVectorX = Eigen::Matrix<WideReal, Eigen::Dynamic, 1>;
using WideMatrix = Eigen::Matrix<WideReal, Eigen::Dynamic, Eigen::Dynamic>;

/// Rounding of a scalar, or of the type that judges it where that is coarser.
template <class Scalar>
WideReal rounding_of() {
  return std::max(WideReal(std::numeric_limits<Scalar>::epsilon()), std::numeric_limits<WideReal>::epsilon());
}

/// A problem of the scalar, in long double and without any other change.
struct WideProblem {
  template <class Scalar>
  explicit WideProblem(const feeler::QpProblem<Scalar>& problem)
      : hessian(problem.hessian.template cast<WideReal>()),
        gradient(problem.gradient.template cast<WideReal>()),
        rows(problem.row_count, 6),
        bounds(problem.row_count) {
    for (int k = 0; k < problem.row_count; ++k) {
      rows.row(k) = problem.rows[std::size_t(k)].template cast<WideReal>().transpose();
      bounds[k] = WideReal(problem.bounds[std::size_t(k)]);
    }
  }
  WideReal value(const Wide6& d) const { return d.dot(hessian * d) / 2 + gradient.dot(d); }
  WideReal violation(const Wide6& d) const {
    WideReal largest = 0;
    for (Eigen::Index k = 0; k < rows.rows(); ++k) largest = std::max(largest, bounds[k] - rows.row(k).dot(d));
    return largest;
  }

  WideMatrix6 hessian;
  Wide6 gradient;
  WideRows rows;
  WideVectorX bounds;
};

/// What a solution says of itself, and how far it is from true.
struct KktResiduals {
  WideReal stationarity = 0;  ///< |H d + g − Σ λ a|, relative to the sizes of its terms
  WideReal violation = 0;     ///< largest b − a·d, in the unit of the bounds
  WideReal slackness = 0;     ///< largest |a·d − b| of an active row
  WideReal multiplier = 0;    ///< least one
};

template <class Scalar>
KktResiduals kkt_residuals(const WideProblem& problem, const feeler::QpSolution<Scalar>& solution) {
  const Wide6 d = solution.step.template cast<WideReal>();
  KktResiduals result;
  Wide6 gradient = problem.hessian * d + problem.gradient;
  WideReal size = (problem.hessian.cwiseAbs() * d.cwiseAbs()).norm() + problem.gradient.norm();
  for (const auto& active : solution.active) {
    const auto multiplier = WideReal(active.multiplier);
    gradient -= multiplier * problem.rows.row(active.row).transpose();
    size += std::abs(multiplier) * problem.rows.row(active.row).norm();
    result.multiplier = std::min(result.multiplier, multiplier);
    result.slackness = std::max(result.slackness, std::abs(problem.rows.row(active.row).dot(d) - problem.bounds[active.row]));
  }
  result.stationarity = size > 0 ? gradient.norm() / size : WideReal(0);
  result.violation = problem.violation(d);
  return result;
}

/// Calls `visit` with every subset of {0 … count−1} that has at most `most` elements.
template <class Visit>
void for_every_subset(int count, int most, const Visit& visit) {
  for (unsigned mask = 0; mask < (1u << count); ++mask) {
    std::vector<int> subset;
    for (int k = 0; k < count; ++k)
      if ((mask >> k & 1u) != 0) subset.push_back(k);
    if (int(subset.size()) <= most) visit(subset);
  }
}

/// The optimum by trying every set of active rows; rows are met to `slack`.
struct BruteForceOptimum {
  bool exists = false;
  Wide6 step = Wide6::Zero();
  WideReal value = std::numeric_limits<WideReal>::infinity();

  /// By which a row may be missed.
  static WideReal rounding_of(const Wide6& d) { return 64 * std::numeric_limits<WideReal>::epsilon() * d.norm(); }

  BruteForceOptimum(const WideProblem& problem, WideReal slack) {
    const WideMatrix6 inverse = Eigen::FullPivLU<WideMatrix>(problem.hessian).inverse();
    const Wide6 free = -(inverse * problem.gradient);
    for_every_subset(int(problem.rows.rows()), 6, [&](const std::vector<int>& subset) {
      const auto count = Eigen::Index(subset.size());
      WideRows n(count, 6);
      WideVectorX lacking(count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const int k = subset[std::size_t(i)];
        n.row(i) = problem.rows.row(k);
        lacking[i] = problem.bounds[k] - slack - n.row(i).dot(free);
      }
      Wide6 d = free;
      if (count > 0) {
        const Eigen::FullPivLU<WideMatrix> lu(n * inverse * n.transpose());
        if (!lu.isInvertible()) return;
        for (int refinement = 0; refinement < 3; ++refinement) {
          d += inverse * n.transpose() * lu.solve(lacking);
          for (Eigen::Index i = 0; i < count; ++i) lacking[i] = problem.bounds[subset[std::size_t(i)]] - slack - n.row(i).dot(d);
        }
      }
      // The equality-constrained minimum of a subset is feasible or no candidate; the best of them is the
      // optimum.
      if (!(problem.violation(d) <= slack + rounding_of(d))) return;
      const WideReal reached = problem.value(d);
      if (reached < value) {
        value = reached;
        step = d;
        exists = true;
      }
    });
  }
};

/// Whether rows certify that no d with |d| ≤ reach meets them (Farkas): some y ≥ 0 has yᵀA = 0 and yᵀb > 0.
///
/// By Carathéodory a certificate needs no more than 7 rows with a left null space of one dimension, so all
/// are tried.
inline bool are_infeasible(const WideRows& rows, const WideVectorX& bounds, WideReal reach) {
  bool proved = false;
  for_every_subset(int(rows.rows()), 7, [&](const std::vector<int>& subset) {
    if (proved || subset.empty()) return;
    const auto count = Eigen::Index(subset.size());
    WideRows a(count, 6);
    WideVectorX b(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      a.row(i) = rows.row(subset[std::size_t(i)]);
      b[i] = bounds[subset[std::size_t(i)]];
    }
    // The singular vector of the least singular value, by inverse iteration; a y ≥ 0 is not orthogonal to the start.
    WideMatrix gram = a * a.transpose();
    gram.diagonal().array() += 1e-18L * gram.trace();
    Eigen::FullPivLU<WideMatrix> lu(gram);
    lu.setThreshold(0);
    WideVectorX y = WideVectorX::Ones(count);
    for (int iteration = 0; iteration < 8; ++iteration) y = lu.solve(y).normalized();
    if (y.minCoeff() < -1e-15L) return;
    y = y.cwiseMax(WideReal(0));
    proved = b.dot(y) - reach * (a.transpose() * y).norm() > 0;
  });
  return proved;
}

template <class Scalar>
feeler::Vector6<Scalar> contact_row(const Eigen::Vector3d& normal, const Eigen::Vector3d& arm) {
  feeler::Vector6<Scalar> row;
  row << normal.cast<Scalar>(), arm.cross(normal).cast<Scalar>();
  return row;
}

/// Random problems as contacts make them, with lengths of about `scale`.
template <class Scalar>
feeler::QpProblem<Scalar> random_problem(std::mt19937& bits, int family, double scale) {
  feeler::QpProblem<Scalar> problem;
  feeler::Vector6<Scalar> weights;
  for (int i = 0; i < 6; ++i) weights[i] = Scalar(i < 3 ? 1.0 : magnitude(bits, -4, -2));
  problem.hessian = weights.asDiagonal();
  if (below(bits, 2) == 0) {  // with some curvature
    feeler::Matrix6<Scalar> b;
    for (int i = 0; i < 36; ++i) b(i / 6, i % 6) = Scalar(0.05 * unit(bits)) * (i / 6 < 3 ? 1 : Scalar(0.01));
    problem.hessian += b * b.transpose();
  }
  feeler::Vector6<Scalar> target;
  for (int i = 0; i < 6; ++i) target[i] = Scalar(scale * unit(bits));
  problem.gradient = -(problem.hessian * target);
  const auto bound = [&] { return Scalar(scale * 0.3 * (unit(bits) - 0.5)); };
  const int count = 1 + below(bits, 8);
  const Eigen::Vector3d normal = random_direction(bits), side = normal.unitOrthogonal();
  const Eigen::Vector3d plane_arm = 0.1 * random_vector(bits);
  while (problem.row_count < count) {
    const Eigen::Vector3d arm = 0.1 * random_vector(bits);
    const double sign = below(bits, 2) == 0 ? 1 : -1;
    switch (family) {
      case 1:  // duplicates, some a little off
        if (problem.row_count > 0 && below(bits, 2) == 0) {
          const auto k = std::size_t(below(bits, problem.row_count));
          const auto row = problem.rows[k];
          const Scalar b = problem.bounds[k];
          problem.add_row(row, b + (below(bits, 2) == 0 ? Scalar(0) : Scalar(scale * 1e-3 * unit(bits))));
          continue;
        }
        break;
      case 2:  // opposite rows: slots open, closed and overlapping
        if (problem.row_count > 0 && below(bits, 2) == 0) {
          const auto k = std::size_t(below(bits, problem.row_count));
          const feeler::Vector6<Scalar> row = -problem.rows[k];
          const Scalar b = -problem.bounds[k];
          const int kind = below(bits, 4);
          problem.add_row(row, kind == 0 ? b : b + Scalar(scale * (kind == 1 ? 1e-3 : -1e-3)));
          continue;
        }
        break;
      case 3:  // rank-deficient: all arms on a line, all normals across it
        problem.add_row(contact_row<Scalar>((normal.cross(side) * unit(bits) + side * unit(bits)).normalized(), 0.1 * unit(bits) * normal), bound());
        continue;
      case 4:  // wedges of 1e-6 rad
        problem.add_row(contact_row<Scalar>((sign * normal + 1e-6 * unit(bits) * side).normalized(), plane_arm), bound());
        continue;
      case 5:  // nearly parallel, faces on faces
        problem.add_row(contact_row<Scalar>((normal + magnitude(bits, -9, -2) * random_vector(bits)).normalized(), arm), bound());
        continue;
      default: break;
    }
    problem.add_row(contact_row<Scalar>(random_direction(bits), arm), bound());
  }
  return problem;
}

constexpr int random_problem_families = 6;

/// Bit for bit the same answer.
template <class Scalar>
bool is_same(const feeler::QpSolution<Scalar>& a, const feeler::QpSolution<Scalar>& b) {
  bool same = a.iterations == b.iterations && a.active.size() == b.active.size() && a.conflict.size() == b.conflict.size();
  for (int i = 0; i < 6; ++i) same = same && a.step[i] == b.step[i];
  for (int i = 0; same && i < a.active.size(); ++i) same = a.active[i].row == b.active[i].row && a.active[i].multiplier == b.active[i].multiplier;
  for (int i = 0; same && i < a.conflict.size(); ++i) same = a.conflict[i] == b.conflict[i];
  return same;
}

/// What a solver promises beyond its concept. By default: nearly every problem decided, to the rounding of its scalar.
struct QpPromise {
  double tolerance = 5e-13;         ///< of a row, where the solver says `optimal` [m]
  double stationarity = 0;          ///< relative, besides rounding
  double least_decided = 0.99;      ///< share of the problems that do not end as `iteration_limit`
  bool proves_infeasibility = true;  ///< or leaves those problems undecided
  bool decides_many_rows = true;     ///< every problem of as many rows as there is room for
  bool names_conflicts = true;       ///< rows that prove `infeasible`
  int most_iterations = 16;          ///< times the number of rows and eight
};

/// What holds after every status: the step is finite, multipliers are non-negative, rows are in range and
/// none is named twice.
template <class Scalar>
bool is_valid(const feeler::QpProblem<Scalar>& problem, const feeler::QpSolution<Scalar>& solution, const QpPromise& promise = {}) {
  using std::isfinite;
  bool valid = solution.iterations <= promise.most_iterations * (problem.row_count + 8);
  for (int i = 0; i < 6; ++i) valid = valid && isfinite(solution.step[i]);
  std::vector<int> rows, conflict;
  for (const auto& active : solution.active) {
    valid = valid && active.multiplier >= Scalar(0) && isfinite(active.multiplier);
    rows.push_back(active.row);
  }
  for (const int row : solution.conflict) conflict.push_back(row);
  for (auto* list : {&rows, &conflict}) {
    std::sort(list->begin(), list->end());
    valid = valid && std::adjacent_find(list->begin(), list->end()) == list->end();
    valid = valid && (list->empty() || (list->front() >= 0 && list->back() < problem.row_count));
  }
  return valid;
}

/// Checks one answer against the problem and against the definition of its status, in long double.
/// @param scale  typical length; tolerances are relative to it and to the rounding of the scalar
template <class Scalar>
void check_answer(const feeler::QpProblem<Scalar>& problem, feeler::QpStatus status, const feeler::QpSolution<Scalar>& solution, double scale,
                  const std::string& name, const QpPromise& promise = {}) {
  BOOST_TEST_CONTEXT(name) {
    BOOST_TEST(is_valid(problem, solution, promise));
    const WideReal epsilon = rounding_of<Scalar>();
    const WideProblem wide(problem);
    // Infeasible within this distance: a direction known to epsilon says nothing about what lies farther off.
    const WideReal reach = std::min(1e4L, 1e-5L / epsilon) * WideReal(scale);
    if (status == feeler::QpStatus::optimal) {
      BOOST_TEST(solution.conflict.empty());
      const KktResiduals kkt = kkt_residuals(wide, solution);
      const WideReal length = solution.step.template cast<WideReal>().norm() + WideReal(scale);
      const WideReal tolerance = WideReal(promise.tolerance) + 256 * epsilon * length;
      BOOST_TEST(kkt.stationarity <= WideReal(promise.stationarity) + 1e6L * epsilon);
      BOOST_TEST(kkt.violation <= tolerance);
      BOOST_TEST(kkt.slackness <= tolerance);
      BOOST_TEST(kkt.multiplier >= 0);
      const BruteForceOptimum best(wide, tolerance);  // rows met as loosely as the solver may
      if (best.exists) {
        WideReal price = 0;  // of the slack, at the multipliers: the best step uses it one way, the answer the other
        for (const auto& active : solution.active) price += WideReal(active.multiplier);
        // A solver that is not exact may be off its stationary point by its tolerance.
        const WideReal residual = promise.stationarity > 0 ? wide.hessian.norm() * tolerance : WideReal(0);
        const WideReal size = std::abs(best.value) + std::abs(wide.value(solution.step.template cast<WideReal>())) + wide.gradient.norm() * length;
        BOOST_TEST(wide.value(solution.step.template cast<WideReal>()) <=
                   best.value + price * (2 * tolerance + BruteForceOptimum::rounding_of(best.step)) + 1e4L * epsilon * size +
                       3 * residual * (solution.step.template cast<WideReal>() - best.step).norm());
      }
    } else if (status == feeler::QpStatus::infeasible || promise.least_decided >= 0.99) {
      const BruteForceOptimum optimum(wide, 0);
      BOOST_TEST((!optimum.exists || optimum.step.norm() > 10 * WideReal(scale)));
      if (status == feeler::QpStatus::iteration_limit) return;  // an honest end, on the brink of infeasibility
      BOOST_TEST_REQUIRE((status == feeler::QpStatus::infeasible));
      if (!promise.names_conflicts) return;
      WideRows rows(solution.conflict.size(), 6);
      WideVectorX bounds(solution.conflict.size());
      for (int i = 0; i < solution.conflict.size(); ++i) {
        rows.row(i) = wide.rows.row(solution.conflict[i]);
        bounds[i] = wide.bounds[solution.conflict[i]];
      }
      // A row with a bound too tight by rounding is in conflict as far as the scalar can tell.
      bounds.array() += 256 * epsilon * WideReal(scale);
      BOOST_TEST(are_infeasible(rows, bounds, reach));
    }
  }
}

/// A solver, whatever its type: the laws are compiled once a scalar.
template <class Scalar>
using Solve = std::function<feeler::QpStatus(const feeler::QpProblem<Scalar>&, feeler::QpSolution<Scalar>&)>;

/// As `check_qp_laws`.
/// @param solve_with_other  another one of the same solver
template <class Scalar>
void check_laws(const Solve<Scalar>& solve, const Solve<Scalar>& solve_with_other, unsigned seed, int problems_per_family, const QpPromise& promise) {
  using Problem = feeler::QpProblem<Scalar>;
  using Solution = feeler::QpSolution<Scalar>;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  Solution solution, again;
  int feasible = 0, infeasible = 0, unfinished = 0;

  for (int family = 0; family < random_problem_families; ++family) {
    for (int i = 0; i < problems_per_family; ++i) {
      const double scale = magnitude(bits, -6, 3);
      const Problem problem = random_problem<Scalar>(bits, family, scale);
      const feeler::QpStatus status = solve(problem, solution);
      (status == feeler::QpStatus::optimal ? feasible : status == feeler::QpStatus::iteration_limit ? unfinished : infeasible)++;
      check_answer(problem, status, solution, scale, "family " + std::to_string(family) + " problem " + std::to_string(i), promise);
      // The same input gives the same bits: with a solver that knows it, and with one that knows another.
      BOOST_TEST((solve(problem, again) == status));
      BOOST_TEST(is_same(solution, again));
      solve_with_other(random_problem<Scalar>(bits, 0, 1), again);
      BOOST_TEST((solve_with_other(problem, again) == status));
      BOOST_TEST(is_same(solution, again));
    }
  }
  BOOST_TEST_MESSAGE(feasible << " optimal, " << infeasible << " infeasible, " << unfinished << " undecided");
  BOOST_TEST(feasible > problems_per_family);
  if (promise.proves_infeasibility) BOOST_TEST(infeasible > problems_per_family / 10);
  BOOST_TEST(unfinished <= (1 - promise.least_decided) * random_problem_families * problems_per_family);

  // Without rows the answer is −H⁻¹g; with a row that says nothing too; a row of zeros can not be met.
  Problem problem = random_problem<Scalar>(bits, 0, 1);
  problem.clear_rows();
  const Wide6 free = Eigen::FullPivLU<WideMatrix>(-WideProblem(problem).hessian).solve(WideProblem(problem).gradient);
  for (const Scalar& bound : {Scalar(0), Scalar(-1)}) {
    BOOST_TEST((solve(problem, solution) == feeler::QpStatus::optimal));
    BOOST_TEST((solution.step.template cast<WideReal>() - free).norm() <= 1e6L * rounding_of<Scalar>() * free.norm());
    BOOST_TEST(solution.active.empty());
    problem.clear_rows();
    problem.add_row(feeler::Vector6<Scalar>::Zero(), bound);
  }
  problem.clear_rows();
  problem.add_row(feeler::Vector6<Scalar>::Zero(), Scalar(1));
  const feeler::QpStatus impossible = solve(problem, solution);
  BOOST_TEST((impossible != feeler::QpStatus::optimal));
  if (promise.names_conflicts) {
    BOOST_TEST((impossible == feeler::QpStatus::infeasible));
    BOOST_TEST_REQUIRE(solution.conflict.size() == 1);
    BOOST_TEST(solution.conflict[0] == 0);
  }
  BOOST_TEST(is_valid(problem, solution, promise));

  // As many rows as there is room for, all around the target: every one of them is met.
  for (int i = 0; i < 20; ++i) {
    problem = random_problem<Scalar>(bits, 0, 1);
    problem.clear_rows();
    while (problem.row_count < Problem::row_capacity)
      problem.add_row(contact_row<Scalar>(random_direction(bits), 0.1 * random_vector(bits)), Scalar(-0.1 * fraction(bits)));
    BOOST_TEST(!problem.add_row(feeler::Vector6<Scalar>::Zero(), Scalar(0)));
    const feeler::QpStatus status = solve(problem, solution);
    BOOST_TEST(is_valid(problem, solution, promise));
    if (status == feeler::QpStatus::iteration_limit && !promise.decides_many_rows) continue;
    BOOST_TEST((status == feeler::QpStatus::optimal));
    BOOST_TEST(kkt_residuals(WideProblem(problem), solution).violation <= WideReal(promise.tolerance) + 256 * rounding_of<Scalar>());
  }

  // A Hessian that is not positive definite is refused and leaves a step of zero.
  for (int i = 0; i < 3; ++i) {
    problem = random_problem<Scalar>(bits, 0, 1);
    if (i == 0) problem.hessian.setZero();
    if (i == 1) problem.hessian(4, 4) = -problem.hessian(4, 4);
    if (i == 2) problem.hessian.row(2).setZero(), problem.hessian.col(2).setZero();
    BOOST_TEST((solve(problem, solution) == feeler::QpStatus::not_positive_definite));
    BOOST_TEST(solution.step.isZero(Scalar(0)));
    BOOST_TEST(is_valid(problem, solution, promise));
  }

  // A NaN or an infinity anywhere ends, and leaves a valid answer.
  for (const Scalar& bad :
       {std::numeric_limits<Scalar>::quiet_NaN(), std::numeric_limits<Scalar>::infinity(), -std::numeric_limits<Scalar>::infinity()}) {
    for (int place = 0; place < 100; ++place) {
      BOOST_TEST_CONTEXT("bad value " << bad << " place " << place) {
        problem = random_problem<Scalar>(bits, place % random_problem_families, 1);
        const int i = below(bits, 6), k = below(bits, 6);
        const auto row = std::size_t(below(bits, problem.row_count));
        if (place % 4 == 0) problem.hessian(i, k) = problem.hessian(k, i) = bad;
        if (place % 4 == 1) problem.gradient[i] = bad;
        if (place % 4 == 2) problem.rows[row][i] = bad;
        if (place % 4 == 3) problem.bounds[row] = bad;
        const feeler::QpStatus status = solve(problem, solution);
        BOOST_TEST(is_valid(problem, solution, promise));
        // Truth: a problem with no number in its objective has no optimum.
        if (place % 4 < 2) BOOST_TEST((status != feeler::QpStatus::optimal));
      }
    }
  }
}

/// Checks a solver against the definition of its answers on random and on special problems.
template <feeler::QpSolver Solver>
void check_qp_laws(unsigned seed = 1, int problems_per_family = 300, const QpPromise& promise = {}) {
  using Scalar = typename Solver::Scalar;
  const auto of = [](auto& solver) {
    return [&solver](const feeler::QpProblem<Scalar>& problem, feeler::QpSolution<Scalar>& solution) { return solver.solve(problem, solution); };
  };
  Solver solver, other;
  check_laws<Scalar>(of(solver), of(other), seed, problems_per_family, promise);
}

}  // namespace feeler_test
