// Places of touching are numbered by who is within reach of whom, which is found a second way: a set that grows until it takes in no more.
#include "feeler/recognition/contact_spots.hpp"

#include <boost/test/unit_test.hpp>

#include <cstddef>
#include <random>
#include <vector>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(contact_spots)

using namespace feeler_test;

using Spots = feeler::ContactSpots<double>;
using Witnesses = feeler::ContactWitnesses<double>;

namespace {

/// Places within a metre on the object; where they are on the tool says nothing.
Witnesses random_witnesses(std::mt19937& bits, int count) {
  Witnesses witnesses;
  for (int i = 0; i < count; ++i)
    witnesses.add({{feeler::FeatureKind::vertex, i}, {feeler::FeatureKind::face, 0}, 100 * random_vector(bits), random_vector(bits)});
  return witnesses;
}

/// The first of all witnesses that a witness is joined with, directly or by way of others.
int first_joined(const Witnesses& witnesses, double reach, const std::vector<Witnesses::Set>& contacts, int of) {
  Witnesses::Set spot;
  spot.set(std::size_t(of));
  for (std::size_t before = 0; before != spot.count();) {
    before = spot.count();
    for (const auto& contact : contacts)
      if ((contact & spot).any()) spot |= contact;
    for (int i = 0; i < witnesses.size(); ++i)
      for (int j = 0; j < witnesses.size(); ++j)
        if (spot[std::size_t(i)] && (witnesses[i].on_object - witnesses[j].on_object).norm() <= reach) spot.set(std::size_t(j));
  }
  int first = 0;
  while (!spot[std::size_t(first)]) ++first;
  return first;
}

}  // namespace

BOOST_AUTO_TEST_CASE(witnesses_within_reach_of_each_other_or_of_one_contact_have_the_number_of_the_first_of_them) {
  std::mt19937 bits(1);
  Spots spots;  // one for all rounds: nothing of the last may be left
  for (int round = 0; round < 60; ++round) {
    const int count = 1 + below(bits, 40);
    const Witnesses witnesses = random_witnesses(bits, count);
    const double reach = fraction(bits) * 0.5;
    std::vector<Witnesses::Set> contacts(std::size_t(below(bits, 5)));
    for (auto& contact : contacts)
      for (int i = below(bits, 4); i > 0; --i) contact.set(std::size_t(below(bits, count)));
    spots.start(witnesses, reach);
    for (const auto& contact : contacts) spots.join(contact);
    for (int i = 0; i < count; ++i) BOOST_TEST(spots.of(i) == first_joined(witnesses, reach, contacts, i), "round " << round << ", witness " << i);
  }
}

BOOST_AUTO_TEST_SUITE_END()
