// Every solver keeps the laws, with the tolerance that it states.
#include <boost/test/unit_test.hpp>

#include <tuple>

#include "feeler/qp/reference/interior_point.hpp"
#include "feeler/qp/reference/projected_gauss_seidel.hpp"
#include "feeler/qp/reference/textbook_active_set.hpp"
#include "support/qp_laws.hpp"
#include "support/qp_promises.hpp"

BOOST_AUTO_TEST_SUITE(qp_solver_laws)

namespace {

template <class Scalar>
using Solvers = std::tuple<feeler::TextbookActiveSet<Scalar>, feeler::InteriorPoint<Scalar>, feeler::ProjectedGaussSeidel<Scalar>>;

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(every_answer_in_double_obeys_the_laws_of_a_qp_solver, Solver, Solvers<double>) {
  feeler_test::check_qp_laws<Solver>(11, 300, feeler_test::promise_of<Solver>());
}
BOOST_AUTO_TEST_CASE_TEMPLATE(every_answer_in_float_obeys_the_laws_of_a_qp_solver, Solver, Solvers<float>) {
  feeler_test::check_qp_laws<Solver>(12, 300, feeler_test::promise_of<Solver>());
}
BOOST_AUTO_TEST_CASE_TEMPLATE(every_answer_in_long_double_obeys_the_laws_of_a_qp_solver, Solver, Solvers<long double>) {
  feeler_test::check_qp_laws<Solver>(13, 300, feeler_test::promise_of<Solver>());
}

BOOST_AUTO_TEST_SUITE_END()
