// Bridges to the QP libraries that this machine has: the laws, with what each library can promise.
#include <boost/test/unit_test.hpp>

#include "support/qp_laws.hpp"
#ifdef FEELER_HAS_DAQP
#include "feeler/adapter/daqp.hpp"
#endif
#ifdef FEELER_HAS_OSQP
#include "feeler/adapter/osqp.hpp"
#endif
#ifdef FEELER_HAS_PROXSUITE
#include "feeler/adapter/proxsuite.hpp"
#endif
#ifdef FEELER_HAS_QPOASES
#include "feeler/adapter/qpoases.hpp"
#endif

BOOST_AUTO_TEST_SUITE(outside_qp_solvers)

namespace {

template <class Solver>
feeler_test::QpPromise promise_of_library(double least_decided) {
  feeler_test::QpPromise promise;
  promise.tolerance = Solver().tolerance;
  promise.stationarity = 1e-3;
  promise.least_decided = least_decided;
  promise.proves_infeasibility = false;
  promise.decides_many_rows = false;
  promise.names_conflicts = false;
  promise.most_iterations = 1000;
  return promise;
}

}  // namespace

#ifdef FEELER_HAS_DAQP
BOOST_AUTO_TEST_CASE(every_answer_of_daqp_obeys_the_laws_of_a_qp_solver) {
  feeler_test::check_qp_laws<feeler::DaqpSolver>(21, 100, promise_of_library<feeler::DaqpSolver>(0.8));
}
#endif
#ifdef FEELER_HAS_OSQP
BOOST_AUTO_TEST_CASE(every_answer_of_osqp_obeys_the_laws_of_a_qp_solver) {
  feeler_test::check_qp_laws<feeler::OsqpSolver>(22, 100, promise_of_library<feeler::OsqpSolver>(0.3));
}
#endif
#ifdef FEELER_HAS_PROXSUITE
BOOST_AUTO_TEST_CASE(every_answer_of_proxqp_obeys_the_laws_of_a_qp_solver) {
  feeler_test::check_qp_laws<feeler::ProxQpSolver>(23, 100, promise_of_library<feeler::ProxQpSolver>(0.5));
}
#endif
#ifdef FEELER_HAS_QPOASES
BOOST_AUTO_TEST_CASE(every_answer_of_qpoases_obeys_the_laws_of_a_qp_solver) {
  feeler_test::check_qp_laws<feeler::QpOasesSolver>(24, 100, promise_of_library<feeler::QpOasesSolver>(0.8));
}
#endif

BOOST_AUTO_TEST_SUITE_END()
