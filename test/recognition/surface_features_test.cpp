#include "feeler/recognition/surface_features.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <map>
#include <random>
#include <string>

#include "scenes/steps.hpp"
#include "support/contact_scenes.hpp"

BOOST_AUTO_TEST_SUITE(surface_features)

using namespace feeler_test;

using feeler::Convexity;
using feeler::SurfaceFeatures;
using feeler::SurfaceSide;

namespace {

SurfaceFeatures<double> features_of(const Soup& soup) { return SurfaceFeatures<double>(soup.mesh()); }

/// A cube of side 2 about the origin without its octant of positive coordinates, of squares of side 1.
Soup notched_cube() {
  Soup result;
  const auto is_solid = [](const Eigen::Vector3i& cell) {
    return (cell.array() >= -1).all() && (cell.array() <= 0).all() && !(cell.array() == 0).all();
  };
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3i cell(-(i & 1), -(i >> 1 & 1), -(i >> 2 & 1));
    if (!is_solid(cell)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) {
        if (is_solid(cell + sign * Eigen::Vector3i::Unit(axis))) continue;
        Eigen::Vector3d corner = cell.cast<double>();
        if (sign > 0) corner[axis] += 1;
        const Eigen::Vector3d u = Eigen::Vector3d::Unit((axis + 1) % 3), v = Eigen::Vector3d::Unit((axis + 2) % 3);
        const int first = int(result.vertices.size());
        for (const Eigen::Vector3d& p : {corner, Eigen::Vector3d(corner + u), Eigen::Vector3d(corner + u + v), Eigen::Vector3d(corner + v)})
          result.vertices.push_back(p);
        if (sign > 0) {
          result.triangles.push_back({first, first + 1, first + 2});
          result.triangles.push_back({first, first + 2, first + 3});
        } else {
          result.triangles.push_back({first, first + 2, first + 1});
          result.triangles.push_back({first, first + 3, first + 2});
        }
      }
    }
  }
  return result;
}

/// How many features there are of each kind and shape.
std::map<std::string, int> census(const SurfaceFeatures<double>& surface, SurfaceSide side) {
  std::map<std::string, int> result;
  const auto name = [](Convexity c) {
    return std::string(c == Convexity::convex ? "convex" : c == Convexity::concave ? "concave" : c == Convexity::mixed ? "mixed" : "other");
  };
  result["faces"] = surface.face_count();
  for (int e = 0; e < surface.edge_count(); ++e) ++result[name(surface.convexity({FeatureKind::edge, e}, side)) + " edges"];
  for (int v = 0; v < surface.vertex_count(); ++v) ++result[name(surface.convexity({FeatureKind::vertex, v}, side)) + " vertices"];
  return result;
}
using Census = std::map<std::string, int>;

}  // namespace

BOOST_AUTO_TEST_CASE(notched_cube_has_the_features_of_its_surface) {
  // By hand: nine faces; of the cube's twelve edges three are cut and nine whole, and the notch has three valleys and six ridges.
  const auto surface = features_of(notched_cube());
  const Census front = census(surface, SurfaceSide::front);
  BOOST_TEST(
      (front ==
       Census{{"faces", 9}, {"convex edges", 18}, {"concave edges", 3}, {"convex vertices", 10}, {"concave vertices", 1}, {"mixed vertices", 3}}));
  const Census back = census(surface, SurfaceSide::back);
  BOOST_TEST(
      (back ==
       Census{{"faces", 9}, {"convex edges", 3}, {"concave edges", 18}, {"convex vertices", 1}, {"concave vertices", 10}, {"mixed vertices", 3}}));
}

BOOST_AUTO_TEST_CASE(another_triangulation_has_the_same_features) {
  std::mt19937 bits(1);
  const Census expected = census(features_of(notched_cube()), SurfaceSide::front);
  for (int round = 0; round < 60; ++round) {
    Soup object = notched_cube();
    const double scale = std::pow(10.0, below(bits, 9) - 4);
    if (round % 2 == 0) object = object.moved({scale * random_vector(bits), random_rotation(bits)}, scale);
    for (int i = below(bits, 4); i > 0; --i) object = object.divided();
    if (round % 2 == 1) object = object.moved({scale * random_vector(bits), random_rotation(bits)}, scale);
    BOOST_TEST((census(features_of(object.shuffled(bits)), SurfaceSide::front) == expected), "round " << round);
  }
}

BOOST_AUTO_TEST_CASE(maps_lead_from_triangles_to_the_features_they_are_part_of) {
  std::mt19937 bits(2);
  for (int round = 0; round < 20; ++round) {
    const auto mesh = notched_cube().divided().divided().shuffled(bits).mesh();
    const SurfaceFeatures<double> surface(mesh);
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const int f = surface.face_of_triangle(t);
      const auto& face = surface.face(f);
      BOOST_TEST(face.first_triangle <= t);
      BOOST_TEST(surface.face_of_triangle(face.first_triangle) == f);
      BOOST_TEST(face.normal.dot(mesh.normal(t)) > 1 - 1e-12);
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d a = mesh.vertex(mesh.triangle(t)[std::size_t(k)]), b = mesh.vertex(mesh.triangle(t)[std::size_t((k + 1) % 3)]);
        BOOST_TEST(std::abs(face.normal.dot(a - face.point)) < 1e-12);
        const Feature edge = surface.feature_of_edge(t, k);
        const bool is_flat = mesh.topology().edge_convexity(t, k) == Convexity::flat;
        BOOST_TEST((edge.kind == FeatureKind::face) == is_flat);
        BOOST_TEST(surface.incidence().contains({FeatureKind::face, f}, edge));
        if (edge.kind == FeatureKind::edge) {
          const auto& whole = surface.edge(edge.index);
          BOOST_TEST((whole.end - whole.start).cross(a - whole.start).norm() < 1e-12);
          BOOST_TEST((whole.end - whole.start).cross(b - whole.start).norm() < 1e-12);
          BOOST_TEST(std::abs((a - whole.start).norm() + (whole.end - a).norm() - (whole.end - whole.start).norm()) < 1e-12);
        }
        const Feature vertex = surface.feature_of_vertex(mesh.triangle(t)[std::size_t(k)]);
        BOOST_TEST(surface.incidence().contains({FeatureKind::face, f}, vertex));
        if (vertex.kind == FeatureKind::vertex) BOOST_TEST(surface.vertex(vertex.index).point == a);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(rims_of_an_open_sheet_are_ridges_from_both_sides) {
  const auto floor = features_of(floor_object().divided());
  BOOST_TEST((census(floor, SurfaceSide::front) == Census{{"faces", 1}, {"convex edges", 4}, {"convex vertices", 4}}));
  BOOST_TEST((census(floor, SurfaceSide::back) == Census{{"faces", 1}, {"convex edges", 4}, {"convex vertices", 4}}));
  const auto valley = features_of(roof(0.5).divided());
  BOOST_TEST((census(valley, SurfaceSide::front) ==
              Census{{"faces", 2}, {"convex edges", 6}, {"concave edges", 1}, {"convex vertices", 4}, {"mixed vertices", 2}}));
  BOOST_TEST((census(valley, SurfaceSide::back) == Census{{"faces", 2}, {"convex edges", 7}, {"convex vertices", 6}}));
}

BOOST_AUTO_TEST_CASE(steps_have_nine_faces_and_four_valleys) {
  const auto scene = feeler::scenes::steps();
  const SurfaceFeatures<double> surface(feeler::TriangleMesh<double>(scene.vertices, scene.triangles));
  const Census front = census(surface, SurfaceSide::front);
  // The profile turns up at x = -0.03, 0, 0.018 and 0.03, z = 0, and down in between; 18 rims along it, 2 across.
  BOOST_TEST(surface.face_count() == 9);
  BOOST_TEST(front.at("concave edges") == 4);
  BOOST_TEST(front.at("convex edges") == 4 + 20);
}

BOOST_AUTO_TEST_CASE(triangles_without_area_join_no_faces) {
  // A needle along the valley between two walls, as some mesh tools leave them.
  Soup object = roof(1.0);
  object.vertices.push_back({0, 0, 0});
  object.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 6}, {6, 5, 4}, {1, 6, 4}};
  const auto surface = features_of(object);
  BOOST_TEST(surface.face_of_triangle(0) != surface.face_of_triangle(2));
  BOOST_TEST(surface.face_of_triangle(0) == surface.face_of_triangle(1));
}

BOOST_AUTO_TEST_CASE(a_needle_along_a_bend_hides_neither_valley_nor_ridge_and_may_be_the_first_triangle_of_a_face) {
  for (const double slope : {1.0, -1.0}) {
    Soup object = roof(slope);
    object.vertices.push_back({0, 0, 0});
    object.triangles = {{1, 6, 4}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 6}, {6, 5, 4}};
    const auto surface = features_of(object);
    const Census front = census(surface, SurfaceSide::front);
    BOOST_TEST((front.count("concave edges") > 0 ? front.at("concave edges") : 0) == (slope > 0 ? 1 : 0));
    BOOST_TEST(front.at("convex edges") == (slope > 0 ? 6 : 7));
    BOOST_TEST(surface.face(surface.face_of_triangle(0)).first_triangle == 0);
  }
}

BOOST_AUTO_TEST_CASE(the_front_of_a_face_whose_triangles_disagree_is_that_of_its_first_one) {
  const Soup object{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 0}}, {{0, 1, 2}, {1, 2, 3}}};  // the second, a larger one, faces down
  const auto surface = features_of(object);
  BOOST_TEST(surface.face_count() == 1);
  BOOST_TEST((surface.face(0).normal - Eigen::Vector3d::UnitZ()).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(a_triangle_that_is_a_point_is_a_corner_of_the_surface_wherever_it_is) {
  Soup object = roof(1.0).divided();
  const auto mesh = object.mesh();
  const SurfaceFeatures<double> without(mesh);
  int inside_edges = 0, inside_faces = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const FeatureKind kind = without.feature_of_vertex(v).kind;
    if (kind == FeatureKind::vertex) continue;
    ++(kind == FeatureKind::edge ? inside_edges : inside_faces);
    Soup with = object;
    const auto there =
        std::size_t(std::find(object.vertices.begin(), object.vertices.end(), Eigen::Vector3d(mesh.vertex(v))) - object.vertices.begin());
    with.triangles.push_back({int(there), int(there), int(there)});
    const auto surface = features_of(with);
    BOOST_TEST(surface.vertex_count() == without.vertex_count() + 1);
  }
  BOOST_TEST(inside_edges > 0);
  BOOST_TEST(inside_faces > 0);
}

BOOST_AUTO_TEST_CASE(edges_of_three_triangles_count_as_convex) {
  Soup object = roof(1.0);
  object.vertices.push_back({0, 0, 3});
  object.triangles.push_back({1, 4, 6});
  const auto surface = features_of(object);
  for (int e = 0; e < surface.edge_count(); ++e) {
    BOOST_TEST((surface.convexity({FeatureKind::edge, e}, SurfaceSide::front) == Convexity::convex));
    BOOST_TEST((surface.convexity({FeatureKind::edge, e}, SurfaceSide::back) == Convexity::convex));
  }
}

BOOST_AUTO_TEST_SUITE_END()
