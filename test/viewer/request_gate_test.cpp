// Who is admitted: the server's own page, and nobody that another site sends.
#include <boost/test/unit_test.hpp>

#include <set>
#include <string>

#include "feeler/viewer/request_gate.hpp"

BOOST_AUTO_TEST_SUITE(request_gate)

using feeler::viewer::RequestGate;
using feeler::viewer::RequestHead;

BOOST_AUTO_TEST_CASE(the_own_page_is_admitted_by_each_name_of_this_machine) {
  const RequestGate gate("127.0.0.1", 4280, "");
  for (const char* host : {"127.0.0.1:4280", "localhost:4280", "[::1]:4280"}) BOOST_TEST(bool(gate.judge({"GET", "/", host, "", false})), host);
  BOOST_TEST(bool(gate.judge({"GET", "/live", "localhost:4280", "http://localhost:4280", true})));
}

BOOST_AUTO_TEST_CASE(other_hosts_other_origins_and_other_methods_are_refused_with_a_sentence) {
  const RequestGate gate("127.0.0.1", 4280, "");
  const RequestHead refused[] = {
      {"GET", "/", "", "", false},
      {"GET", "/", "evil.example:4280", "", false},
      {"GET", "/", "127.0.0.1:4281", "", false},
      {"GET", "/", "127.0.0.1.evil.example:4280", "", false},
      {"GET", "/live", "127.0.0.1:4280", "http://evil.example", true},
      {"GET", "/live", "127.0.0.1:4280", "http://localhost:4280", true},
      {"GET", "/live", "127.0.0.1:4280", "https://127.0.0.1:4280", true},
      {"GET", "/live", "127.0.0.1:4280", "null", true},
      {"POST", "/", "127.0.0.1:4280", "", false},
  };
  for (const RequestHead& request : refused) {
    const auto verdict = gate.judge(request);
    BOOST_TEST(!verdict, std::string(request.host) + ' ' + std::string(request.origin));
    BOOST_TEST(verdict.reason.back() == '.');
  }
}

BOOST_AUTO_TEST_CASE(with_a_token_nothing_is_admitted_without_it) {
  const RequestGate gate("0.0.0.0", 4280, "secret");
  const char* const host = "192.168.1.5:4280";
  BOOST_TEST(bool(gate.judge({"GET", "/?token=secret", host, "", false})));
  BOOST_TEST(bool(gate.judge({"GET", "/live?a=b&token=secret", host, "http://192.168.1.5:4280", true})));
  for (const char* target : {"/", "/?token=", "/?token=secre", "/?token=secret1", "/?tokens=secret", "/?Token=secret", "/token=secret"})
    BOOST_TEST(!gate.judge({"GET", target, host, "", false}), target);
  BOOST_TEST(!gate.judge({"GET", "/live?token=secret", host, "http://evil.example", true}));
}

BOOST_AUTO_TEST_CASE(a_file_is_taken_from_the_own_page_alone) {
  const char *const host = "127.0.0.1:4280", *const own = "http://127.0.0.1:4280";
  const RequestGate gate("127.0.0.1", 4280, "");
  BOOST_TEST(bool(gate.judge({"POST", "/file?name=a.stl", host, own, false})));
  BOOST_TEST(gate.judge({"POST", "/file", host, "", false}).status == 403);
  BOOST_TEST(gate.judge({"POST", "/file", host, "null", false}).status == 403);
  BOOST_TEST(gate.judge({"POST", "/file", host, "http://evil.example", false}).status == 403);
  BOOST_TEST(gate.judge({"POST", "/file", "evil.example:4280", "http://evil.example:4280", false}).status == 403);
  BOOST_TEST(gate.judge({"POST", "/live", host, own, false}).status == 405);
  BOOST_TEST(gate.judge({"PUT", "/file", host, own, false}).status == 405);
  const RequestGate guarded("127.0.0.1", 4280, "secret");
  BOOST_TEST(guarded.judge({"POST", "/file?name=a.stl", host, own, false}).status == 403);
  BOOST_TEST(bool(guarded.judge({"POST", "/file?token=secret&name=a.stl", host, own, false})));
}

BOOST_AUTO_TEST_CASE(a_text_of_a_query_has_its_escapes_undone_and_broken_ones_stay) {
  using feeler::viewer::query_text;
  BOOST_TEST(query_text("/file?a=b&name=my+two%20Z%C3%A4hne%2B.stl", "name") == "my two Zähne+.stl");
  BOOST_TEST(query_text("/file?name=100%", "name") == "100%");
  BOOST_TEST(query_text("/file?name=%zz%-1%4", "name") == "%zz%-1%4");
  BOOST_TEST(query_text("/file", "name") == "");
}

BOOST_AUTO_TEST_CASE(tokens_are_long_and_differ) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(feeler::viewer::random_token());
  BOOST_TEST(tokens.size() == 100u);
  BOOST_TEST(tokens.begin()->size() == 32u);
}

BOOST_AUTO_TEST_SUITE_END()
