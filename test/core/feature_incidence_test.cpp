#include "feeler/core/feature_incidence.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(feature_incidence)

using feeler::Feature;
using feeler::FeatureIncidence;
using feeler::FeatureKind;

namespace {

/// Polygons by their corners; what holds what follows from the sets of their vertices.
struct Polygons {
  int vertex_count;
  std::vector<std::vector<int>> faces;
  std::vector<std::array<int, 2>> edges;

  Polygons(int count, std::vector<std::vector<int>> corners) : vertex_count(count), faces(std::move(corners)) {
    for (const auto& face : faces) {
      for (std::size_t i = 0; i < face.size(); ++i) {
        const auto [low, high] = std::minmax(face[i], face[(i + 1) % face.size()]);
        if (number_of(low, high) < 0) edges.push_back({low, high});
      }
    }
  }
  int number_of(int low, int high) const {
    const auto found = std::find(edges.begin(), edges.end(), std::array{low, high});
    return found == edges.end() ? -1 : int(found - edges.begin());
  }
  FeatureIncidence incidence() const {
    std::vector<std::pair<int, int>> edge_faces, vertex_faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (std::size_t i = 0; i < faces[f].size(); ++i) {
        const auto [low, high] = std::minmax(faces[f][i], faces[f][(i + 1) % faces[f].size()]);
        edge_faces.emplace_back(number_of(low, high), int(f));
        vertex_faces.emplace_back(faces[f][i], int(f));
      }
    }
    return {vertex_count, edges, int(faces.size()), edge_faces, vertex_faces};
  }

  std::vector<Feature> features() const {
    std::vector<Feature> all;
    for (int v = 0; v < vertex_count; ++v) all.push_back({FeatureKind::vertex, v});
    for (int e = 0; e < int(edges.size()); ++e) all.push_back({FeatureKind::edge, e});
    for (int f = 0; f < int(faces.size()); ++f) all.push_back({FeatureKind::face, f});
    return all;
  }
  std::set<int> vertices_of(const Feature& feature) const {
    const auto i = std::size_t(feature.index);
    if (feature.kind == FeatureKind::vertex) return {feature.index};
    if (feature.kind == FeatureKind::edge) return {edges[i].begin(), edges[i].end()};
    return {faces[i].begin(), faces[i].end()};
  }
  bool contains(const Feature& whole, const Feature& part) const {
    if (whole.kind == part.kind) return whole == part;
    const std::set<int> all = vertices_of(whole), some = vertices_of(part);
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
  }
  /// Those that hold both, but for those that hold another such.
  std::vector<Feature> join(const Feature& a, const Feature& b) const {
    std::vector<Feature> both;
    for (const Feature& feature : features())
      if (contains(feature, a) && contains(feature, b)) both.push_back(feature);
    std::vector<Feature> smallest;
    for (const Feature& feature : both) {
      const auto is_smaller = [&](const Feature& other) { return !(other == feature) && contains(feature, other); };
      if (std::none_of(both.begin(), both.end(), is_smaller)) smallest.push_back(feature);
    }
    return smallest;
  }
};

Polygons cube() { return {8, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}}; }
/// A square with a front and a back, and a square beside it.
Polygons two_sides() { return {6, {{0, 1, 2, 3}, {3, 2, 1, 0}, {1, 4, 5, 2}}}; }

std::vector<Feature> listed(const feeler::FeatureJoin& join) { return {join.begin(), join.end()}; }

}  // namespace

BOOST_AUTO_TEST_CASE(features_hold_each_other_and_are_joined_as_the_sets_of_their_vertices_say) {
  for (const Polygons& polygons : {cube(), two_sides()}) {
    const FeatureIncidence incidence = polygons.incidence();
    const auto all = polygons.features();
    int joined = 0;
    for (const Feature& a : all) {
      for (const Feature& b : all) {
        BOOST_TEST(incidence.contains(a, b) == polygons.contains(a, b));
        const auto expected = polygons.join(a, b);
        BOOST_TEST((listed(incidence.join(a, b)) == expected));
        joined += expected.empty() ? 0 : 1;
      }
    }
    BOOST_TEST(joined > int(all.size()));
  }
}

BOOST_AUTO_TEST_CASE(lists_are_sorted_and_hold_each_number_once) {
  const Polygons polygons = cube();
  const FeatureIncidence incidence = polygons.incidence();
  const auto check = [&](const Feature& feature, FeatureKind kind, std::span<const int> list) {
    std::vector<int> expected;
    for (const Feature& other : polygons.features())
      if (other.kind == kind && (polygons.contains(feature, other) || polygons.contains(other, feature))) expected.push_back(other.index);
    BOOST_TEST(std::vector<int>(list.begin(), list.end()) == expected, boost::test_tools::per_element());
  };
  BOOST_TEST(incidence.vertex_count() == 8);
  BOOST_TEST(incidence.edge_count() == 12);
  BOOST_TEST(incidence.face_count() == 6);
  for (int v = 0; v < 8; ++v) {
    check({FeatureKind::vertex, v}, FeatureKind::edge, incidence.vertex_edges(v));
    check({FeatureKind::vertex, v}, FeatureKind::face, incidence.vertex_faces(v));
  }
  for (int e = 0; e < 12; ++e) check({FeatureKind::edge, e}, FeatureKind::face, incidence.edge_faces(e));
  for (int f = 0; f < 6; ++f) {
    check({FeatureKind::face, f}, FeatureKind::edge, incidence.face_edges(f));
    check({FeatureKind::face, f}, FeatureKind::vertex, incidence.face_vertices(f));
  }
}

BOOST_AUTO_TEST_CASE(of_more_faces_than_there_is_room_for_the_first_are_joined) {
  std::vector<std::vector<int>> pages;  // each has vertices 0 and 1 as opposite corners
  for (int i = 0; i < 6; ++i) pages.push_back({0, 2 + 2 * i, 1, 3 + 2 * i});
  const FeatureIncidence incidence = Polygons(14, pages).incidence();
  const auto join = incidence.join({FeatureKind::vertex, 0}, {FeatureKind::vertex, 1});
  BOOST_TEST_REQUIRE(join.size() == feeler::FeatureJoin::capacity());
  for (int i = 0; i < join.size(); ++i) BOOST_TEST((join[i] == Feature{FeatureKind::face, i}));
}

BOOST_AUTO_TEST_SUITE_END()
