// The edges at which faces end: whose they are, by all triangles that have both ends, and where two of them are one straight edge.
#include "feeler/recognition/sharp_edges.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstddef>
#include <random>
#include <set>
#include <vector>

#include "support/contact_scenes.hpp"

BOOST_AUTO_TEST_SUITE(sharp_edges)

using namespace feeler_test;

using feeler::Convexity;
using Edges = feeler::detail::SharpEdges<double>;
using Faces = feeler::detail::CoplanarFaces<double>;
using Vector = Eigen::Vector3d;

BOOST_AUTO_TEST_CASE(an_edge_has_the_faces_of_all_triangles_at_it_each_once) {
  std::mt19937 bits(1);
  for (int round = 0; round < 60; ++round) {
    Soup object = below(bits, 2) == 0 ? roof(unit(bits)) : fan(3 + below(bits, 4), unit(bits));
    if (below(bits, 2) == 0) object = object.divided();
    // Fins stand on some of the edges, also on those inside of a face.
    for (int i = below(bits, 4); i > 0; --i) {
      const auto& triangle = object.triangles[std::size_t(below(bits, int(object.triangles.size())))];
      const int first = triangle[0], second = triangle[1];
      object.vertices.push_back({unit(bits), unit(bits), 3});
      object.triangles.push_back({first, second, int(object.vertices.size()) - 1});
    }
    const auto mesh = object.shuffled(bits).mesh();
    const Faces faces(mesh);
    const Edges edges(mesh, faces);
    for (const auto& edge : edges.edges()) {
      std::set<int> around;
      for (int t = 0; t < mesh.triangle_count(); ++t) {
        const auto& corners = mesh.triangle(t);
        const bool has_both =
            std::all_of(edge.ends.begin(), edge.ends.end(), [&](int end) { return std::find(corners.begin(), corners.end(), end) != corners.end(); });
        if (has_both) around.insert(faces.of_triangle()[std::size_t(t)]);
      }
      BOOST_TEST(edge.faces == std::vector<int>(around.begin(), around.end()), boost::test_tools::per_element());
    }
  }
}

BOOST_AUTO_TEST_CASE(two_edges_go_on_in_each_other_if_they_are_straight_and_between_the_same_faces_and_not_if_one_folds_back) {
  std::mt19937 bits(2);
  for (int round = 0; round < 100; ++round) {
    // Vertices on a line through the first, before, behind and behind it, and one beside it.
    const Vector middle = random_vector(bits), along = random_direction(bits), beside = along.unitOrthogonal();
    const double first = magnitude(bits, -2, 2), second = magnitude(bits, -2, 2), third = second * (1.1 + fraction(bits));
    const double bend = (below(bits, 2) == 0 ? 1 : -1) * magnitude(bits, -6, -1);
    const Soup object{{middle, middle - first * along, middle + second * along, middle + third * along, middle + second * (along + bend * beside),
                       middle + third * beside},
                      {{0, 1, 5}, {0, 5, 2}, {0, 2, 3}, {0, 3, 4}}};
    const auto mesh = object.mesh();
    using Edge = feeler::detail::MeshEdge;
    const auto edge = [](int a, int b) { return Edge{{a, b}, Convexity::convex, {4, 7}}; };
    const auto continues = [&](const Edge& a, const Edge& b, std::size_t count = 2) { return Edges::continues(mesh, 0, a, b, count); };
    BOOST_TEST(continues(edge(0, 1), edge(0, 2)));
    BOOST_TEST(continues(edge(3, 0), edge(1, 0)));
    BOOST_TEST(!continues(edge(0, 2), edge(0, 3)));
    BOOST_TEST(!continues(edge(0, 1), edge(0, 4)));
    BOOST_TEST(!continues(edge(0, 1), edge(0, 2), 3));
    BOOST_TEST(!continues(edge(0, 1), Edge{{0, 2}, Convexity::concave, {4, 7}}));
    BOOST_TEST(!continues(edge(0, 1), Edge{{0, 2}, Convexity::convex, {4, 8}}));
  }
}

BOOST_AUTO_TEST_SUITE_END()
