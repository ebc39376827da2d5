#include "feeler/tool/tool_incidence.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <set>

#include "feeler/tool/sphere_swept.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(tool_incidence)

using feeler::Feature;
using feeler::FeatureKind;
using namespace feeler_test;

namespace {

/// Every pair of features, by the vertices that the tool lists for them.
template <class Tool>
void check(const Tool& tool) {
  const feeler::FeatureIncidence incidence = feeler::incidence_of(tool);
  BOOST_TEST(incidence.vertex_count() == tool.vertex_count());
  BOOST_TEST(incidence.edge_count() == tool.edge_count());
  BOOST_TEST(incidence.face_count() == tool.face_count());
  for (int f = 0; f < tool.face_count(); ++f) {
    const auto face = tool.face(f);
    const std::set<int> corners(face.vertices.begin(), face.vertices.end());
    for (int v = 0; v < tool.vertex_count(); ++v)
      BOOST_TEST(incidence.contains({FeatureKind::face, f}, {FeatureKind::vertex, v}) == (corners.count(v) > 0));
    int sides = 0;
    for (int e = 0; e < tool.edge_count(); ++e) {
      // Of a convex tool an edge bounds a face where the face has both of its ends.
      const bool is_side = corners.count(tool.edge(e).start) > 0 && corners.count(tool.edge(e).end) > 0;
      BOOST_TEST(incidence.contains({FeatureKind::face, f}, {FeatureKind::edge, e}) == is_side);
      sides += is_side ? 1 : 0;
    }
    BOOST_TEST(sides == int(corners.size()));
  }
  for (int e = 0; e < tool.edge_count(); ++e) {
    for (int v = 0; v < tool.vertex_count(); ++v) {
      const bool is_end = v == tool.edge(e).start || v == tool.edge(e).end;
      BOOST_TEST(incidence.contains({FeatureKind::edge, e}, {FeatureKind::vertex, v}) == is_end);
    }
    if (tool.face_count() > 0) BOOST_TEST(incidence.edge_faces(e).size() == 2U);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(faces_hold_the_vertices_and_edges_of_their_loops_and_edges_their_ends) {
  std::mt19937 bits(1);
  check(random_box(bits));
  check(random_segment(bits));
  check(random_sphere(bits));
  check(random_rounded_box(bits));
  for (int i = 0; i < 10; ++i) check(random_hull(bits, 4 + 3 * i));
}

BOOST_AUTO_TEST_SUITE_END()
