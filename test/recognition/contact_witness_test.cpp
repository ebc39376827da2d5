// Places of touching: how far they spread, and how many there is no room for.
#include "feeler/recognition/contact_witness.hpp"

#include <boost/test/unit_test.hpp>

#include <cstddef>
#include <random>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(contact_witness)

using namespace feeler_test;

using Witnesses = feeler::ContactWitnesses<double>;
using Vector = Eigen::Vector3d;

namespace {

feeler::ContactWitness<double> witness(int number, const Vector& on_tool, const Vector& on_object) {
  return {{feeler::FeatureKind::vertex, number}, {feeler::FeatureKind::face, 0}, on_tool, on_object};
}

}  // namespace

BOOST_AUTO_TEST_CASE(places_span_as_many_dimensions_as_the_box_that_they_fill_has_long_sides) {
  // A box whose sides are short or long; its corners and places within, in any order, with others that are not of the set.
  std::mt19937 bits(1);
  for (int round = 0; round < 500; ++round) {
    const double least = magnitude(bits, -6, 3);
    const int dimensions = below(bits, 3);
    Vector sides = 0.3 * least * Vector::Ones();
    for (int i = 0; i < dimensions; ++i) sides[i] = least * magnitude(bits, 0.8, 2.5);
    const Eigen::Quaterniond axes = random_rotation(bits);
    const Vector origin = 10 * least * random_vector(bits);
    Witnesses witnesses;
    Witnesses::Set set;
    const int corners = 8, count = corners + below(bits, 8), others = 5;
    const int shift = below(bits, count);
    for (int i = 0; i < count + others; ++i) {
      const int corner = (i + shift) % count;
      Vector place = sides.cwiseProduct(random_vector(bits)) / 2;
      for (int k = 0; corner < corners && k < 3; ++k) place[k] = (corner >> k & 1) == 0 ? sides[k] / 2 : -sides[k] / 2;
      if (i >= count) place = 1e4 * least * random_vector(bits);
      witnesses.add(witness(i, 1e4 * least * random_vector(bits), origin + axes * place));
      if (i < count) set.set(std::size_t(i));
    }
    BOOST_TEST(witnesses.dimension(set, least) == dimensions, "round " << round);
  }
  BOOST_TEST(Witnesses().dimension({}, 1.0) == 0);
}

BOOST_AUTO_TEST_CASE(places_beyond_the_room_are_counted_anew_after_a_clear) {
  Witnesses witnesses;
  for (int round = 0; round < 2; ++round) {
    witnesses.clear();
    BOOST_TEST(witnesses.size() == 0);
    BOOST_TEST(witnesses.dropped() == 0);
    for (int i = 0; i < Witnesses::capacity + 7; ++i) witnesses.add(witness(i, Vector::Zero(), Vector::Zero()));
    witnesses.add(witness(3, Vector::Ones(), Vector::Ones()));  // is known
    BOOST_TEST(witnesses.size() == Witnesses::capacity);
    BOOST_TEST(witnesses.dropped() == 7);
    BOOST_TEST(witnesses[3].on_tool.isZero());
  }
}

BOOST_AUTO_TEST_SUITE_END()
