#include "feeler/recognition/constraint_plane.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/contact_scenes.hpp"

BOOST_AUTO_TEST_SUITE(constraint_plane)

using namespace feeler_test;

using feeler::SurfaceFeatures;
using feeler::SurfaceSide;
using Vector = Eigen::Vector3d;

BOOST_AUTO_TEST_CASE(plane_of_a_face_gives_the_height_above_it) {
  const SurfaceFeatures<double> floor(floor_object().mesh());
  const auto plane = face_plane(floor, 0, SurfaceSide::front);
  BOOST_TEST(plane.value({0.3, 0.2, 0.7}) == 0.7);
  BOOST_TEST(face_plane(floor, 0, SurfaceSide::back).value({0.3, 0.2, 0.7}) == -0.7);
}

BOOST_AUTO_TEST_CASE(plane_of_two_edges_holds_both_and_turns_with_the_tool) {
  std::mt19937 bits(1);
  for (int round = 0; round < 1000; ++round) {
    const Vector object = 3 * random_vector(bits), tool = 0.1 * random_vector(bits), point = random_vector(bits), up = random_direction(bits);
    if (object.normalized().cross(tool.normalized()).norm() < 1e-2) continue;
    const auto plane = feeler::edge_edge_plane<double>(object, tool, point, up);
    BOOST_TEST(plane.normal.norm() == 1.0, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(std::abs(plane.value(point + 2 * object)) < 1e-12);
    BOOST_TEST(std::abs(plane.value(point - 5 * tool)) < 1e-12);
    BOOST_TEST(plane.value(point + up) >= 0);
  }
}

BOOST_AUTO_TEST_CASE(planes_around_a_valley_are_those_of_all_its_faces_each_once) {
  // z = |x|: distances from the two sides, whatever triangles they are made of.
  for (const Soup& soup : {roof(1.0), roof(1.0).divided()}) {
    const SurfaceFeatures<double> surface(soup.mesh());
    for (int e = 0; e < surface.edge_count(); ++e) {
      const Feature edge{FeatureKind::edge, e};
      if (surface.convexity(edge, SurfaceSide::front) != feeler::Convexity::concave) continue;
      const auto planes = planes_around(surface, edge, SurfaceSide::front);
      BOOST_TEST_REQUIRE(planes.size() == 2);
      const Vector p(0.1, 0.2, 0.4);
      const double low = std::min(planes[0].value(p), planes[1].value(p)), high = std::max(planes[0].value(p), planes[1].value(p));
      BOOST_TEST(low == 0.3 / std::sqrt(2.0), boost::test_tools::tolerance(1e-12));
      BOOST_TEST(high == 0.5 / std::sqrt(2.0), boost::test_tools::tolerance(1e-12));
    }
  }
  const SurfaceFeatures<double> pit(fan(3, 0.5).divided().mesh());
  for (int v = 0; v < pit.vertex_count(); ++v)
    if (pit.vertex(v).point.norm() < 0.5) BOOST_TEST(planes_around(pit, {FeatureKind::vertex, v}, SurfaceSide::front).size() == 3);
}

BOOST_AUTO_TEST_CASE(a_triangle_without_area_adds_no_plane_to_those_around_its_corner) {
  const Soup object = roof(1.0).divided();
  const auto mesh = object.mesh();
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vector place = mesh.vertex(v);
    Soup with = object;
    const int there = int(std::find(object.vertices.begin(), object.vertices.end(), place) - object.vertices.begin());
    with.triangles.push_back({there, there, there});
    const SurfaceFeatures<double> surface(with.mesh());
    for (int w = 0; w < surface.vertex_count(); ++w) {
      if (surface.vertex(w).point != place) continue;
      const auto planes = planes_around(surface, {FeatureKind::vertex, w}, SurfaceSide::front);
      BOOST_TEST(planes.size() == (place.x() == 0 ? 2 : 1));
      for (const auto& plane : planes) BOOST_TEST(plane.normal.norm() == 1.0, boost::test_tools::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(points_on_the_free_side_of_a_valley_or_a_ridge_are_in_front) {
  std::mt19937 bits(2);
  for (int round = 0; round < 2000; ++round) {
    const double slope = 2 * unit(bits);
    const SurfaceFeatures<double> surface(roof(slope).mesh());
    const Vector point(0, 0.5 * unit(bits), 0), direction = random_direction(bits);
    const double height = direction.z() - slope * std::abs(direction.x());  // above the roof
    if (std::abs(height) < 1e-3 || std::abs(slope) < 1e-3) continue;
    for (int e = 0; e < surface.edge_count(); ++e) {
      if (surface.incidence().edge_faces(e).size() != 2) continue;
      const auto side = feeler::side_of_tool<double>(surface, {FeatureKind::edge, e}, 1e-12, [&](const auto& visit) { visit(direction); });
      BOOST_TEST((side == SurfaceSide::front) == (height > 0));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
