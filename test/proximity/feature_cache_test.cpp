#include "feeler/proximity/feature_cache.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(feature_cache)

BOOST_AUTO_TEST_CASE(features_are_recalled_for_their_own_triangle_until_another_takes_the_place) {
  feeler::FeatureCache cache;
  BOOST_TEST(cache.recall(7).size == 0);
  feeler::WitnessFeatures features;
  features.size = 2;
  features.tool_vertices = {3, 4, 0};
  features.corners = {1, 2, 0};
  cache.remember(7, features);
  BOOST_TEST(cache.recall(7).size == 2);
  BOOST_TEST(cache.recall(7).tool_vertices[1] == 4);
  BOOST_TEST(cache.recall(7).corners[0] == 1);
  constexpr int same_place = 7 + 3 * feeler::FeatureCache::capacity;
  BOOST_TEST(cache.recall(same_place).size == 0);
  features.size = 1;
  cache.remember(same_place, features);
  BOOST_TEST(cache.recall(same_place).size == 1);
  BOOST_TEST(cache.recall(7).size == 0);
  cache.clear();
  BOOST_TEST(cache.recall(same_place).size == 0);
}

BOOST_AUTO_TEST_CASE(a_triangle_that_is_not_known_gets_the_features_remembered_last) {
  feeler::FeatureCache cache;
  BOOST_TEST(cache.recall_or_guess(7).size == 0);
  feeler::WitnessFeatures features;
  features.size = 2;
  cache.remember(7, features);
  features.size = 3;
  cache.remember(8, features);
  BOOST_TEST(cache.recall_or_guess(7).size == 2);
  BOOST_TEST(cache.recall_or_guess(9).size == 3);
  cache.clear();
  BOOST_TEST(cache.recall_or_guess(9).size == 0);
}

BOOST_AUTO_TEST_SUITE_END()
