// What each QP solver promises to the laws of qp_laws.hpp.
#pragma once

#include "feeler/qp/reference/interior_point.hpp"
#include "feeler/qp/reference/projected_gauss_seidel.hpp"
#include "support/qp_laws.hpp"

namespace feeler_test {

template <class Solver>
struct PromiseOf {
  static QpPromise get() { return {}; }
};

template <class Scalar>
struct PromiseOf<feeler::InteriorPoint<Scalar>> {
  static QpPromise get() {
    QpPromise promise;
    promise.tolerance = double(feeler::InteriorPoint<Scalar>().tolerance);
    promise.stationarity = 1e-3;
    promise.least_decided = 0.97;
    return promise;
  }
};

template <class Scalar>
struct PromiseOf<feeler::ProjectedGaussSeidel<Scalar>> {
  static QpPromise get() {
    QpPromise promise;
    promise.tolerance = double(feeler::ProjectedGaussSeidel<Scalar>().tolerance);
    promise.stationarity = 1e-3;
    promise.least_decided = 0.3;
    promise.proves_infeasibility = false;
    promise.decides_many_rows = false;
    return promise;
  }
};

/// A solver without a promise of its own keeps the strict ones.
template <class Solver>
QpPromise promise_of() {
  return PromiseOf<Solver>::get();
}

}  // namespace feeler_test
