// Libraries loaded at run time: the first that is there, and the words of the dynamic linker for those that
// are not.
#include <boost/test/unit_test.hpp>

#include <string>

#include "feeler/device/shared_library.hpp"

BOOST_AUTO_TEST_SUITE(shared_library)

BOOST_AUTO_TEST_CASE(the_first_candidate_that_is_there_is_loaded) {
  feeler::SharedLibrary library;
  BOOST_TEST(library.load({"/nowhere/libm.so", "libm.so.6", "libc.so.6"}) == "");
  BOOST_TEST(library.is_loaded());
  BOOST_TEST(library.path() == "libm.so.6");
  double (*cosine)(double) = nullptr;
  BOOST_TEST(library.find("cos", cosine) == nullptr);
  BOOST_REQUIRE(cosine != nullptr);
  BOOST_TEST(cosine(0) == 1);
}

BOOST_AUTO_TEST_CASE(every_candidate_that_is_missing_is_said_in_the_words_of_the_linker) {
  feeler::SharedLibrary library;
  const std::string refusals = library.load({"/nowhere/a.so", "/nowhere/b.so"});
  BOOST_TEST(refusals.find("/nowhere/a.so: cannot open shared object file: No such file or directory; "
                           "/nowhere/b.so: cannot") == 0u);
  BOOST_TEST(!library.is_loaded());
  BOOST_TEST(!library.load({}).empty());
}

BOOST_AUTO_TEST_CASE(a_missing_function_is_named_and_leaves_the_pointer) {
  feeler::SharedLibrary library;
  int (*function)() = nullptr;
  BOOST_TEST(library.find("anything", function) == "anything");
  BOOST_REQUIRE(library.load({"libm.so.6"}) == "");
  BOOST_TEST(library.find("no_such_function", function) == "no_such_function");
  BOOST_TEST(function == nullptr);
}

BOOST_AUTO_TEST_SUITE_END()
