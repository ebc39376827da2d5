// The optimum of a QP in exact arithmetic.
#pragma once

#include <optional>

#include "feeler/qp/problem.hpp"

namespace feeler::qp_families {

/// The optimum of a problem as it is written, rounded to double; empty where no point meets the rows.
///
/// By CGAL's exact rational solver where the build found CGAL, else by `TextbookActiveSet` in fractions.
std::optional<Vector6<double>> exact_optimum(const QpProblem<double>& problem);

/// The name of what solves exactly in this build.
const char* exact_solver_name();

}  // namespace feeler::qp_families
