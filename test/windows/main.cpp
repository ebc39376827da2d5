// The entry point of the tests for Windows, with the whole of Boost.Test.
#define BOOST_TEST_MODULE feeler on Windows
#include <boost/test/included/unit_test.hpp>
