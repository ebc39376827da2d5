#include <boost/test/unit_test.hpp>

bool renders_after_windows_headers();  // after_windows_headers.cpp

BOOST_AUTO_TEST_SUITE(after_windows_headers)

BOOST_AUTO_TEST_CASE(a_renderer_compiles_and_renders) { BOOST_TEST(renders_after_windows_headers()); }

BOOST_AUTO_TEST_SUITE_END()
