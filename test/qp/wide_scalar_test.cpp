// The solver with a scalar of fifty digits, which is a class and no built-in type.
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <boost/test/unit_test.hpp>

#include "feeler/qp/dual_active_set.hpp"
#include "support/qp_laws.hpp"

BOOST_AUTO_TEST_SUITE(wide_scalar)

BOOST_AUTO_TEST_CASE(every_answer_in_fifty_digits_obeys_the_laws_of_a_qp_solver) {
  feeler_test::check_qp_laws<feeler::DualActiveSet<boost::multiprecision::cpp_bin_float_50>>(7, 40);
}

BOOST_AUTO_TEST_SUITE_END()
