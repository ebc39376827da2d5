// The bytes that go to a page, read back word by word.
#include <boost/test/unit_test.hpp>

#include <cstring>
#include <string>
#include <vector>

#include "feeler/viewer/wire.hpp"

BOOST_AUTO_TEST_SUITE(wire)

namespace {

std::vector<double> words_of(const std::string& bytes) {
  std::vector<double> words(bytes.size() / sizeof(double));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(double));
  return words;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_frame_has_its_words_where_the_page_reads_them) {
  feeler::viewer::Frame frame;
  frame.snapshot.stage = 7;
  frame.snapshot.tick = 1234;
  frame.snapshot.time = 1.25;
  frame.snapshot.mode = feeler::viewer::HandMode::person;
  frame.snapshot.haptic.position[2] = 0.5;
  frame.snapshot.graphic.orientation[3] = 0.25;
  frame.snapshot.wrench.torque[1] = -2;
  frame.snapshot.missed = 3;
  frame.snapshot.contact_count = 1;
  frame.snapshot.contacts[0].force = 4;
  frame.recognised.push_back({2, {1, 2, 3}, {0, 0, 1}, 1e-6, 0});
  frame.samples.resize(2);
  frame.samples[1].has_folded = true;
  frame.lost = 9;
  const std::string bytes = encoded(frame);
  // page/protocol.js: 34 words of head, 9 a contact, 15 a sample.
  BOOST_REQUIRE(bytes.size() == 8 * (34 + 2 * 9 + 2 * 15));
  const std::vector<double> words = words_of(bytes);
  BOOST_TEST(words[0] == feeler::viewer::wire_version);
  BOOST_TEST(words[1] == 1);
  BOOST_TEST(words[2] == 7);
  BOOST_TEST(words[3] == 1234);
  BOOST_TEST(words[4] == 1.25);
  BOOST_TEST(words[5] == 2);
  BOOST_TEST(words[8] == 0.5);
  BOOST_TEST(words[19] == 0.25);
  BOOST_TEST(words[24] == -2);
  BOOST_TEST(words[30] == 3);
  BOOST_TEST(words[31] == 9);
  BOOST_TEST(words[32] == 2);
  BOOST_TEST(words[33] == 2);
  BOOST_TEST(words[34] == 0);
  BOOST_TEST(words[42] == 4);
  BOOST_TEST(words[43] == 2);
  BOOST_TEST(words[50] == 1e-6);
  BOOST_TEST(words.back() == 2);
}

BOOST_AUTO_TEST_CASE(a_mesh_far_from_the_origin_keeps_its_digits_about_its_own_centre) {
  feeler::Points<double> vertices(3, 3);
  vertices << 1000, 0, 0, 1000.001, 0, 0, 1000, 0.001, 0;
  feeler::Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const std::string bytes = feeler::viewer::encoded_mesh(5, vertices, triangles);
  BOOST_REQUIRE(bytes.size() == 8 * 8 + 9 * 4 + 3 * 4);
  const std::vector<double> words = words_of(bytes.substr(0, 64));
  BOOST_TEST(words[1] == 2);
  BOOST_TEST(words[2] == 5);
  BOOST_TEST(words[6] == 3);
  BOOST_TEST(words[7] == 1);
  float x = 0;
  std::memcpy(&x, bytes.data() + 64 + 3 * sizeof(float), sizeof x);
  BOOST_TEST(words[3] + double(x) == 1000.001, boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_SUITE_END()
