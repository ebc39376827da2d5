// Says whether an answer of a QP solver is right, by the exact optimum.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "feeler/qp/problem.hpp"
#include "feeler/qp/solution.hpp"
#include "qp/exact_reference.hpp"

namespace feeler::qp_families {

enum class Verdict {
  right,
  undecided,          ///< `iteration_limit`: no claim, so none that is wrong
  wrong,              ///< called optimal, and is not
  falsely_infeasible  ///< or a Hessian refused that is positive definite
};

/// The exact optimum of one problem, and what its answers are worth by it.
///
/// A problem is known no better than its rows are to be met: rounding makes many a slot without clearance
/// exactly infeasible, and where edges are all but parallel one row that gives way by a tenth of a picometre
/// moves the optimum by a nanometre. So the optimum of a problem that is as near as the tolerance is right
/// too (backward error: Higham, Accuracy and Stability of Numerical Algorithms, 2002, 1.5), and problems that
/// need a step of more than 10 m count as infeasible.
class Judge {
 public:
  Judge(const QpProblem<double>& problem, double metres_per_unit) : problem_(problem), unit_(metres_per_unit), exact_(exact_optimum(problem)) {}

  /// Right is: rows met to twice the tolerance, and the step within 500 tolerances of the exact optimum, of
  /// this problem or of the one whose bounds go through the step where they are that near to it.
  /// @param tolerance  that the solver states for its rows [m]
  Verdict judge(QpStatus status, const QpSolution<double>& solution, double tolerance) {
    distance_ = exact_ ? distance(solution.step, *exact_) : std::numeric_limits<double>::quiet_NaN();
    if (status == QpStatus::iteration_limit) return Verdict::undecided;
    if (status == QpStatus::not_positive_definite) return Verdict::falsely_infeasible;
    if (status == QpStatus::infeasible) return is_out_of_reach() ? Verdict::right : Verdict::falsely_infeasible;
    const double size = 1.0 + solution.step.head<3>().norm() * unit_;
    const double give = 2.0 * tolerance * size;
    if (!(violation(solution.step) <= give)) return Verdict::wrong;
    const double accepted = 500.0 * tolerance * size;
    if (exact_ && distance_ <= accepted) return Verdict::right;
    const auto further = exact_optimum(seen_from(solution.step, give));
    return further && distance(*further, Vector6<double>::Zero()) <= accepted ? Verdict::right : Verdict::wrong;
  }

  /// Of the step last judged from the exact optimum, in the metric of the problem [m]; NaN where there is no
  /// optimum.
  double distance() const { return distance_; }

 private:
  /// The problem of the step that is left after `step`, with rows that it meets to `give` [m] met exactly.
  ///
  /// Its rounding is relative to what is left, not to the step, so nearly parallel rows do not amplify it.
  QpProblem<double> seen_from(const Vector6<double>& step, double give) const {
    QpProblem<double> rest = problem_;
    const auto wide_step = step.cast<long double>();
    rest.gradient = (problem_.hessian.cast<long double>() * wide_step + problem_.gradient.cast<long double>()).cast<double>();
    for (int k = 0; k < problem_.row_count; ++k) {
      const double missing = missing_at(step, k);
      rest.bounds[std::size_t(k)] = std::abs(missing) * unit_ <= give ? 0.0 : missing;
    }
    return rest;
  }

  bool is_out_of_reach() const {
    if (exact_ && exact_->head<3>().norm() * unit_ <= 10.0) return false;
    QpProblem<double> looser = problem_;
    for (int k = 0; k < looser.row_count; ++k) looser.bounds[std::size_t(k)] -= 1e-12 / unit_;
    const auto optimum = exact_optimum(looser);
    return !optimum || optimum->head<3>().norm() * unit_ > 10.0;
  }

  /// What row k lacks at a step, negative where it is met [units of length].
  double missing_at(const Vector6<double>& step, int k) const {
    const auto row = std::size_t(k);
    const long double value = problem_.rows[row].cast<long double>().dot(step.cast<long double>());
    return double(static_cast<long double>(problem_.bounds[row]) - value);
  }

  double violation(const Vector6<double>& step) const {
    double largest = 0;
    for (int k = 0; k < problem_.row_count; ++k) largest = std::max(largest, missing_at(step, k));
    return largest * unit_;
  }

  double distance(const Vector6<double>& a, const Vector6<double>& b) const {
    const Vector6<double> off = a - b;
    return std::sqrt(off.dot(problem_.hessian * off) / problem_.hessian.diagonal().head<3>().maxCoeff()) * unit_;
  }

  QpProblem<double> problem_;
  double unit_;
  std::optional<Vector6<double>> exact_;
  double distance_ = 0;
};

}  // namespace feeler::qp_families
