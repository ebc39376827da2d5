// What a class must offer to solve the renderer's QP.
#pragma once

#include <concepts>

#include "feeler/qp/problem.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// A solver of `QpProblem`s: bounded time, no allocation, no exception, the same answer for the same input.
template <class T>
concept QpSolver =
    RealScalar<typename T::Scalar> && requires(T& solver, const QpProblem<typename T::Scalar>& problem, QpSolution<typename T::Scalar>& solution) {
      { solver.solve(problem, solution) } noexcept -> std::same_as<QpStatus>;
    };

}  // namespace feeler
