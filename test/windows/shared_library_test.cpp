// The loader of Windows.
#include <boost/test/unit_test.hpp>

#include <string>

#include "feeler/device/device_catalogue.hpp"
#include "feeler/device/shared_library.hpp"

BOOST_AUTO_TEST_SUITE(windows_shared_library)

BOOST_AUTO_TEST_CASE(the_first_candidate_that_is_there_is_loaded_and_its_functions_are_found) {
  feeler::SharedLibrary library;
  BOOST_TEST(library.load({"no_such.dll", "msvcrt.dll"}) == "");
  BOOST_TEST(library.is_loaded());
  BOOST_TEST(library.path() == "msvcrt.dll");
  double (*cosine)(double) = nullptr;
  BOOST_TEST(library.find("cos", cosine) == nullptr);
  BOOST_REQUIRE(cosine != nullptr);
  BOOST_TEST(cosine(0) == 1);
  int (*function)() = nullptr;
  BOOST_TEST(library.find("no_such_function", function) == "no_such_function");
  BOOST_TEST(function == nullptr);
}

BOOST_AUTO_TEST_CASE(every_candidate_that_is_missing_is_said) {
  feeler::SharedLibrary library;
  const std::string refusals = library.load({"no_such.dll", "nor_this.dll"});
  BOOST_TEST(refusals.find("no_such.dll: cannot open") == 0u, refusals);
  BOOST_TEST(refusals.find("; nor_this.dll: cannot open") != std::string::npos, refusals);
  BOOST_TEST(!library.is_loaded());
  BOOST_TEST(!library.load({}).empty());
}

BOOST_AUTO_TEST_CASE(every_maker_s_driver_says_what_is_missing) {
  for (const feeler::Maker maker : feeler::all_makers) {
    const auto opened = feeler::make_device(maker)->open();
    BOOST_TEST(!opened);
    BOOST_TEST(opened.problem.find("install") != std::string::npos, opened.problem);
  }
}

BOOST_AUTO_TEST_SUITE_END()
