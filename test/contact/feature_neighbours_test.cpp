#include "feeler/contact/feature_neighbours.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <set>

#include "feeler/object/surface_features.hpp"
#include "support/contact_scenes.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(feature_neighbours)

using namespace feeler_test;

using feeler::FeatureIncidence;
using feeler::neighbours_of;

namespace {

int size_of(const FeatureIncidence& incidence, FeatureKind kind) {
  return kind == FeatureKind::vertex ? incidence.vertex_count() : kind == FeatureKind::edge ? incidence.edge_count() : incidence.face_count();
}
std::array<int, 3> counts(const FeatureIncidence& incidence, const Feature& feature) {
  std::array<int, 3> result{};
  for (const Feature& neighbour : neighbours_of(incidence, feature).features) ++result[std::size_t(neighbour.kind)];
  return result;
}

/// Compares with the definition, for all pairs of features whose vertices are given.
template <class VerticesOf>
void check_all_pairs(const FeatureIncidence& incidence, const VerticesOf& vertices_of) {
  using enum FeatureKind;
  std::vector<Feature> all;
  for (const FeatureKind kind : {vertex, edge, face})
    for (int i = 0; i < size_of(incidence, kind); ++i) all.push_back({kind, i});
  for (const Feature& feature : all) {
    const auto neighbours = neighbours_of(incidence, feature);
    int expected = 0;
    const std::set<int> own = vertices_of(feature);
    for (const Feature& other : all) {
      const std::set<int> others = vertices_of(other);
      const bool shares = std::any_of(own.begin(), own.end(), [&](int v) { return others.count(v) > 0; });
      const bool is_neighbour = shares && other != feature;
      expected += is_neighbour ? 1 : 0;
      if (neighbours.dropped == 0) BOOST_TEST(neighbours.contains(other) == is_neighbour);
    }
    BOOST_TEST(neighbours.features.size() + neighbours.dropped >= expected);
  }
}

template <class Tool>
void check_tool(const Tool& tool) {
  check_all_pairs(incidence_of(tool), [&](const Feature& feature) -> std::set<int> {
    if (feature.kind == FeatureKind::vertex) return {feature.index};
    if (feature.kind == FeatureKind::edge) return {tool.edge(feature.index).start, tool.edge(feature.index).end};
    const auto face = tool.face(feature.index);
    return {face.vertices.begin(), face.vertices.end()};
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(neighbours_on_a_box_are_those_of_figure_8) {
  using enum FeatureKind;
  const auto incidence = incidence_of(feeler::Box<double>({0.1, 0.2, 0.3}));
  using Counts = std::array<int, 3>;
  for (int i = 0; i < 8; ++i) BOOST_TEST((counts(incidence, {vertex, i}) == Counts{0, 3, 3}));
  for (int i = 0; i < 12; ++i) BOOST_TEST((counts(incidence, {edge, i}) == Counts{2, 4, 4}));
  for (int i = 0; i < 6; ++i) BOOST_TEST((counts(incidence, {face, i}) == Counts{4, 8, 4}));
  const auto segment = incidence_of(feeler::Segment<double>({0, 0, 0}, {1, 0, 0}));
  BOOST_TEST((counts(segment, {vertex, 1}) == Counts{0, 1, 0}));
  BOOST_TEST((counts(segment, {edge, 0}) == Counts{2, 0, 0}));
}

BOOST_AUTO_TEST_CASE(neighbours_on_tools_share_a_vertex) {
  std::mt19937 bits(1);
  check_tool(random_box(bits));
  check_tool(random_segment(bits));
  for (int round = 0; round < 5; ++round) check_tool(random_hull(bits, 4 + below(bits, 12)));
}

BOOST_AUTO_TEST_CASE(neighbours_on_a_surface_do_not_depend_on_its_triangles) {
  using enum FeatureKind;
  for (const Soup& soup : {fan(5, -0.4), fan(5, -0.4).divided().divided()}) {
    const feeler::SurfaceFeatures<double> surface(soup.mesh());
    for (int v = 0; v < surface.vertex_count(); ++v) {
      const bool is_tip = surface.vertex(v).point.norm() < 0.5;
      const std::array<int, 3> expected = is_tip ? std::array<int, 3>{0, 5, 5} : std::array<int, 3>{0, 3, 2};
      BOOST_TEST((counts(surface.incidence(), {vertex, v}) == expected));
    }
    // A side: its three corners; five spokes, and the rims of itself and its neighbours; all other sides, by the tip.
    for (int f = 0; f < 5; ++f) BOOST_TEST((counts(surface.incidence(), {face, f}) == std::array<int, 3>{3, 8, 4}));
  }
}

BOOST_AUTO_TEST_CASE(joins_are_the_smallest_features_that_hold_both) {
  std::mt19937 bits(2);
  for (int round = 0; round < 20; ++round) {
    const auto tool = random_hull(bits, 4 + below(bits, 12));
    const auto incidence = incidence_of(tool);
    using enum FeatureKind;
    std::vector<Feature> all;
    for (const FeatureKind kind : {vertex, edge, face})
      for (int i = 0; i < size_of(incidence, kind); ++i) all.push_back({kind, i});
    for (const Feature& a : all) {
      for (const Feature& b : all) {
        std::vector<Feature> holders;  // sorted by kind: the first ones are the smallest
        for (const Feature& c : all)
          if (incidence.contains(c, a) && incidence.contains(c, b)) holders.push_back(c);
        const auto join = incidence.join(a, b);
        BOOST_TEST(join.size() == (holders.empty() ? 0 : 1));
        if (!holders.empty() && !join.empty()) BOOST_TEST((join[0] == holders[0]));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
