// Triangles that hang together in a plane: which of them gives the face its normal, its point and its side.
#include "feeler/recognition/coplanar_faces.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstddef>
#include <random>

#include "support/contact_scenes.hpp"

BOOST_AUTO_TEST_SUITE(coplanar_faces)

using namespace feeler_test;

using Vector = Eigen::Vector3d;

namespace {

/// A strip of triangles in the plane z = 0, of random widths.
Soup strip(std::mt19937& bits, int count) {
  Soup result;
  double x = 0;
  for (int i = 0; i < count + 2; ++i) {
    x += 0.1 + fraction(bits);
    result.vertices.push_back({x, i % 2 == 0 ? 0.0 : 1.0, 0.0});
    if (i < 2) continue;
    if (i % 2 == 0) result.triangles.push_back({i - 2, i, i - 1});
    else result.triangles.push_back({i - 2, i - 1, i});
  }
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_face_has_the_plane_of_its_largest_triangle_and_the_side_of_its_first_one_whatever_sides_the_others_have) {
  std::mt19937 bits(1);
  for (int round = 0; round < 200; ++round) {
    Soup object = strip(bits, 1 + below(bits, 12)).moved({random_vector(bits), random_rotation(bits)}, magnitude(bits, -2, 2));
    for (auto& triangle : object.triangles)
      if (below(bits, 2) == 0) std::swap(triangle[1], triangle[2]);
    const auto mesh = object.shuffled(bits).mesh();
    const feeler::detail::CoplanarFaces<double> faces(mesh);
    BOOST_TEST_REQUIRE(faces.faces().size() == 1U);
    const auto& face = faces.faces()[0];
    BOOST_TEST(face.first_triangle == 0);
    BOOST_TEST(face.normal.dot(mesh.normal(0)) > 1 - 1e-12);
    const auto area = [&](int t) {
      const Eigen::Matrix3d c = mesh.corners(t);
      return Vector(c.col(1) - c.col(0)).cross(Vector(c.col(2) - c.col(0))).norm();
    };
    int largest = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      BOOST_TEST(faces.of_triangle()[std::size_t(t)] == 0);
      if (area(t) > area(largest)) largest = t;
    }
    const double sign = face.normal.dot(mesh.normal(largest)) < 0 ? -1 : 1;
    BOOST_TEST((face.normal - sign * mesh.normal(largest)).norm() == 0.0);
    BOOST_TEST((mesh.corners(largest).colwise() - face.point).colwise().norm().minCoeff() == 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
