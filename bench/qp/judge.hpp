// Says whether an answer of a QP solver is right, by the exact optimum.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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

/// The exact optima of one problem: as it is written, and with bounds lower by a tolerance.
///
/// Rounding makes many a slot without clearance exactly infeasible, so the optimum with a picometre of slack
/// is right too, and problems that need a step of more than 10 m count as infeasible.
class Judge {
 public:
  Judge(const QpProblem<double>& problem, double metres_per_unit)
      : problem_(problem), unit_(metres_per_unit), exact_(exact_optimum(problem)) {}

  /// Right is: rows met to twice the tolerance, and the step within 500 tolerances of the exact optimum, or
  /// no farther from it than the optimum moves when all rows are relaxed by the tolerance.
  /// @param tolerance  that the solver states for its rows [m]
  Verdict judge(QpStatus status, const QpSolution<double>& solution, double tolerance) {
    distance_ = exact_ ? distance(solution.step, *exact_) : std::numeric_limits<double>::quiet_NaN();
    if (status == QpStatus::iteration_limit) return Verdict::undecided;
    if (status == QpStatus::not_positive_definite) return Verdict::falsely_infeasible;
    if (status == QpStatus::infeasible)
      return is_out_of_reach() ? Verdict::right : Verdict::falsely_infeasible;
    const double size = 1.0 + solution.step.head<3>().norm() * unit_;
    if (!(violation(solution.step) <= (2.0 * tolerance + 1e-12) * size)) return Verdict::wrong;
    const double accepted = 500.0 * tolerance * size;
    if (exact_ && distance_ <= accepted) return Verdict::right;
    const auto& looser = relaxed(std::max(tolerance, 1e-12));
    if (!looser) return Verdict::wrong;
    const double from_looser = distance(solution.step, *looser);
    if (!exact_) distance_ = from_looser;
    if (from_looser <= accepted) return Verdict::right;
    return exact_ && distance_ <= 1.01 * distance(*exact_, *looser) ? Verdict::right : Verdict::wrong;
  }

  /// Of the step last judged from the exact optimum, in the metric of the problem [m]; NaN where there is no optimum.
  double distance() const { return distance_; }

 private:
  const std::optional<Vector6<double>>& relaxed(double slack) {
    const auto known = relaxed_.find(slack);
    if (known != relaxed_.end()) return known->second;
    QpProblem<double> looser = problem_;
    for (int k = 0; k < looser.row_count; ++k) looser.bounds[std::size_t(k)] -= slack / unit_;
    return relaxed_[slack] = exact_optimum(looser);
  }

  bool is_out_of_reach() {
    if (exact_ && exact_->head<3>().norm() * unit_ <= 10.0) return false;
    const auto& looser = relaxed(1e-12);
    return !looser || looser->head<3>().norm() * unit_ > 10.0;
  }

  double violation(const Vector6<double>& step) const {
    long double largest = 0;
    for (int k = 0; k < problem_.row_count; ++k) {
      const auto row = std::size_t(k);
      const long double value = problem_.rows[row].cast<long double>().dot(step.cast<long double>());
      largest = std::max(largest, static_cast<long double>(problem_.bounds[row]) - value);
    }
    return double(largest) * unit_;
  }

  double distance(const Vector6<double>& a, const Vector6<double>& b) const {
    const Vector6<double> off = a - b;
    return std::sqrt(off.dot(problem_.hessian * off) / problem_.hessian.diagonal().head<3>().maxCoeff()) *
           unit_;
  }

  QpProblem<double> problem_;
  double unit_;
  std::optional<Vector6<double>> exact_;
  std::map<double, std::optional<Vector6<double>>> relaxed_;
  double distance_ = 0;
};

}  // namespace feeler::qp_families
