#include "feeler/object/mesh_interior.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <utility>

#include "feeler/object/mesh_assembly.hpp"
#include "support/closed_meshes.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(mesh_interior)

using namespace feeler;
using namespace feeler_test;

namespace {

using Vector = Vector3<double>;

/// A mesh and what it encloses.
struct Solid {
  TriangleMesh<double> mesh;
  MeshInterior interior;

  explicit Solid(const ClosedMesh& given) : mesh(given.vertices, given.triangles), interior(mesh) {}
  bool contains(const Vector& point) const { return interior.contains(mesh, point); }
};

/// Points of a ball about the origin of which an answer is false: `expected(point)` is 1 inside, −1 outside,
/// 0 where facets decide.
template <class Expected>
int false_answers(const ClosedMesh& given, double radius, std::mt19937& bits, const Expected& expected, int& inside) {
  const Eigen::Quaterniond rotation = random_rotation(bits);
  const Vector translation = random_vector(bits);
  const Solid solid(given.moved(rotation, translation));
  int count = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector point = radius * random_vector(bits);
    const int answer = expected(point);
    if (answer == 0) continue;
    inside += answer > 0;
    count += solid.contains(rotation * point + translation) != (answer > 0);
  }
  return count;
}

ClosedMesh cube(double half) { return block(Vector::Constant(-half), Vector::Constant(half)); }

}  // namespace

BOOST_AUTO_TEST_CASE(balls_blocks_and_tori_in_random_poses_hold_what_their_formulas_say) {
  std::mt19937 bits(1);
  int wrong = 0, inside = 0;
  for (int i = 0; i < 30; ++i) {
    wrong += false_answers(ball(1, 6), 1.5, bits, [](const Vector& p) { return p.norm() < 0.9 ? 1 : p.norm() > 1 ? -1 : 0; }, inside);
    wrong += false_answers(
        block({-1, -0.5, -0.1}, {1, 0.5, 0.1}), 1.2, bits,
        [](const Vector& p) {
          const double off = (p.cwiseAbs() - Vector(1, 0.5, 0.1)).maxCoeff();
          return off < -1e-12 ? 1 : off > 1e-12 ? -1 : 0;
        },
        inside);
    wrong += false_answers(
        torus(1, 0.4, 40, 20), 1.6, bits,
        [](const Vector& p) {
          const double off = std::hypot(std::hypot(p.x(), p.y()) - 1, p.z());
          return off < 0.38 ? 1 : off > 0.4 ? -1 : 0;
        },
        inside);
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(inside > 3000);
}

BOOST_AUTO_TEST_CASE(rays_through_edges_and_corners_count_once) {
  // A ray along x from a point with whole coordinates meets corners, edges and diagonals of cubes of whole
  // coordinates, and runs in their faces.
  ClosedMesh mesh = block({0, 0, 0}, {2, 2, 2}).with(block({4, 1, 1}, {6, 3, 3})).with(block({8, -1, 0}, {9, 2, 1}));
  const Solid solid(mesh);
  for (const auto& [point, is_in] : {std::pair(Vector(1, 1, 1), true),
                                     {Vector(-1, 1, 1), false},
                                     {Vector(-1, 0, 0), false},
                                     {Vector(-1, 2, 2), false},
                                     {Vector(3, 2, 2), false},
                                     {Vector(5, 2, 2), true},
                                     {Vector(3, 1, 1), false},
                                     {Vector(7, 0, 0.5), false},
                                     {Vector(8.5, 0, 0.5), true},
                                     {Vector(-1, 1, 0), false},
                                     {Vector(1, 0.5, 0.5), true},
                                     {Vector(10, 0, 0), false}})
    BOOST_TEST(solid.contains(point) == is_in, point.transpose());
}

BOOST_AUTO_TEST_CASE(crossings_are_exact_where_the_point_is_next_to_the_plane_or_the_line) {
  using Exact = boost::multiprecision::cpp_rational;
  std::mt19937 bits(2);
  const auto exact_cross = [](const Vector& u, const Vector& v, const Vector& p) {
    return (Exact(v.y()) - Exact(u.y())) * (Exact(p.z()) - Exact(u.z())) - (Exact(v.z()) - Exact(u.z())) * (Exact(p.y()) - Exact(u.y()));
  };
  int wrong_lines = 0, wrong_planes = 0, zeros = 0;
  for (int i = 0; i < 3000; ++i) {
    Matrix3<double> triangle;
    for (int k = 0; k < 3; ++k) triangle.col(k) = magnitude(bits, -6, 1) * random_vector(bits);
    if (i % 3 == 0) triangle.col(2) = triangle.col(0) + fraction(bits) * (triangle.col(1) - triangle.col(0));  // a sliver
    if (i % 5 == 0) triangle = (triangle.array() * 16).round() / 16;
    double weight = fraction(bits), other = fraction(bits);
    if (i % 5 == 0) weight = other = 0.5;
    const Vector point = triangle.col(0) + weight * (triangle.col(1) - triangle.col(0)) + other * (triangle.col(2) - triangle.col(0));
    const Vector on_line = triangle.col(0) + weight * (triangle.col(1) - triangle.col(0));
    const Exact cross = exact_cross(triangle.col(0), triangle.col(1), on_line);
    if (cross != 0) wrong_lines += detail::side_of_line(triangle.col(0), triangle.col(1), on_line) != (cross > 0 ? 1 : -1);
    wrong_lines +=
        detail::side_of_line(triangle.col(0), triangle.col(1), on_line) != -detail::side_of_line(triangle.col(1), triangle.col(0), on_line);
    Exact volume = 0;
    for (int k = 0; k < 3; ++k) {
      const auto e = [&](int axis, int corner) { return Exact(triangle(axis, corner)) - Exact(point[axis]); };
      volume += e(k, 0) * (e((k + 1) % 3, 1) * e((k + 2) % 3, 2) - e((k + 2) % 3, 1) * e((k + 1) % 3, 2));
    }
    zeros += volume == 0;
    wrong_planes += detail::side_of_plane(triangle, point) != (volume == 0 ? 0 : volume < 0 ? 1 : -1);
  }
  BOOST_TEST(wrong_lines == 0);
  BOOST_TEST(wrong_planes == 0);
  BOOST_TEST(zeros > 100);
}

BOOST_AUTO_TEST_CASE(a_cavity_is_free_whatever_is_in_it) {
  std::mt19937 bits(3);
  const auto hollow = cube(1).with(cube(0.5).inverted()).moved(random_rotation(bits), Vector::Zero());
  BOOST_TEST(!Solid(hollow).contains(Vector::Zero()));
  const Vector wall = Vector(hollow.vertices.row(0).transpose()) * 0.75;
  BOOST_TEST(Solid(hollow).contains(wall));
  const Solid with_core(hollow.with(ball(0.1, 3)));
  BOOST_TEST(with_core.contains(Vector::Zero()));
  BOOST_TEST(with_core.contains(wall));
  BOOST_TEST(!with_core.contains(Vector(0.2, 0.2, 0.2)));
  // The shell of a cavity that faces outwards is a solid in a solid.
  BOOST_TEST(Solid(cube(1).with(cube(0.5))).contains(Vector::Zero()));
}

BOOST_AUTO_TEST_CASE(a_surface_that_faces_inwards_is_a_room_and_what_stands_in_it_is_solid) {
  const Solid room(cube(1).inverted());
  BOOST_TEST(!room.contains(Vector::Zero()));
  BOOST_TEST(!room.contains(Vector(2, 0, 0)));
  const Solid furnished(cube(1).inverted().with(ball(0.2, 4)));
  BOOST_TEST(furnished.contains(Vector::Zero()));
  BOOST_TEST(!furnished.contains(Vector(0.5, 0.5, 0.5)));
  BOOST_TEST(!furnished.contains(Vector(2, 0, 0)));
}

BOOST_AUTO_TEST_CASE(an_open_surface_holds_nothing_and_hides_nothing) {
  BOOST_TEST(Solid(ball(1, 5).opened()).interior.is_empty());
  BOOST_TEST(Solid(cube(1).opened(2)).interior.is_empty());
  const Solid both(ball(1, 5).opened(20).with(cube(0.1).moved(Eigen::Quaterniond::Identity(), {0.5, 0, 0})));
  BOOST_TEST(!both.contains(Vector::Zero()));
  BOOST_TEST(both.contains(Vector(0.5, 0, 0)));
}

BOOST_AUTO_TEST_CASE(a_surface_whose_triangles_disagree_is_a_solid) {
  std::mt19937 bits(4);
  for (int k = 0; k < 20; ++k) {
    ClosedMesh mixed = torus(1, 0.4, 12, 8);
    for (Eigen::Index t = 0; t < mixed.triangles.rows(); ++t)
      if (below(bits, 2) == 0) std::swap(mixed.triangles(t, 1), mixed.triangles(t, 2));
    const Solid solid(mixed);
    BOOST_TEST(solid.contains(Vector(1, 0.01, 0.02)));
    BOOST_TEST(!solid.contains(Vector(0.01, 0.02, 0)));
  }
}

BOOST_AUTO_TEST_CASE(blocks_that_share_faces_edges_and_sheets_are_told_one_by_one) {
  const auto holds_both = [](const ClosedMesh& mesh) {
    const Solid solid(mesh);
    return solid.contains(Vector(0.5, 0.4, 0.3)) && solid.contains(Vector(1.5, 1.4, 0.3)) && !solid.contains(Vector(0.5, 1.4, 0.3));
  };
  const ClosedMesh left = block({0, 0, 0}, {1, 1, 1});
  BOOST_TEST(holds_both(left.with(block({1, 1, 0}, {2, 2, 1}))));                             // an edge
  const Solid row(left.with(block({1, 0, 0}, {2, 1, 1})).with(block({2, 0, 0}, {3, 1, 1})));  // faces
  for (const double x : {0.5, 1.5, 2.5}) BOOST_TEST(row.contains(Vector(x, 0.4, 0.3)));
  BOOST_TEST(!row.contains(Vector(3.5, 0.4, 0.3)));
  BOOST_TEST(Solid(left.with(left)).contains(Vector(0.5, 0.4, 0.3)));  // given twice
  // A fin on an edge.
  const ClosedMesh fin{Points<double>{{0, 0, 0}, {1, 0, 0}, {0, -1, -1}}, Triangles{{0, 1, 2}}};
  BOOST_TEST(Solid(left.with(fin)).contains(Vector(0.5, 0.4, 0.3)));

  MeshAssembly<double> assembly;
  for (const ClosedMesh& part : {left, fin, ball(1, 4)}) assembly.add(part.vertices, part.triangles, {.translation = {5, 0, 0}});
  const TriangleMesh<double> mesh = assembly.mesh();
  BOOST_TEST(MeshInterior(mesh).contains(mesh, Vector(5.9, 0.9, 0.9)));
  BOOST_TEST(MeshInterior(mesh).contains(mesh, Vector(4.5, 0, 0)));
}

BOOST_AUTO_TEST_CASE(of_two_blocks_that_share_a_face_a_triangle_that_is_missing_or_turned_tells_for_both) {
  const ClosedMesh both = block({0, 0, 0}, {1, 1, 1}).with(block({1, 0, 0}, {2, 1, 1}));
  int outer = 0;
  for (Eigen::Index t = 0; t < both.triangles.rows(); ++t) {
    const auto x = [&](int k) { return both.vertices(both.triangles(t, k), 0); };
    if (x(0) == 1 && x(1) == 1 && x(2) == 1) continue;
    ++outer;
    ClosedMesh opened{both.vertices, feeler::Triangles(both.triangles.rows() - 1, 3)};
    opened.triangles << both.triangles.topRows(t), both.triangles.bottomRows(both.triangles.rows() - 1 - t);
    BOOST_TEST(Solid(opened).interior.is_empty(), "without triangle " << t);
    if (t == 0 || t == 14) continue;  // what the others of its block are turned like
    ClosedMesh mixed = both.inverted();
    std::swap(mixed.triangles(t, 1), mixed.triangles(t, 2));
    const Solid solid(mixed);
    BOOST_TEST(solid.contains(Vector(0.5, 0.4, 0.3)), "with triangle " << t << " turned");
    BOOST_TEST(solid.contains(Vector(1.5, 0.4, 0.3)), "with triangle " << t << " turned");
  }
  BOOST_TEST(outer == 20);
}

BOOST_AUTO_TEST_CASE(a_surface_of_one_side_and_points_and_lines_hold_nothing) {
  // A Klein bottle: the second half of a grid is joined to the first turned round.
  constexpr int u = 16, v = 9;
  ClosedMesh bottle = wrapped_grid(u, v, [](int i, int j) {
    const double a = 2 * M_PI * i / u, b = 2 * M_PI * j / v;
    const double across = 3 + std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
    return Vector(across * std::cos(a), across * std::sin(a), std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b));
  });
  for (Eigen::Index t = 2 * (u - 1) * v; t < bottle.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      if (bottle.triangles(t, k) < v) bottle.triangles(t, k) = (v - bottle.triangles(t, k)) % v;
  BOOST_TEST_REQUIRE(TriangleMesh<double>(bottle.vertices, bottle.triangles).report().boundary_edges == 0);
  BOOST_TEST(Solid(bottle).interior.is_empty());
  BOOST_TEST(Solid(ClosedMesh{Points<double>{{0, 0, 0}, {1, 0, 0}}, Triangles{{0, 1, 1}, {0, 0, 0}}}).interior.is_empty());
}

BOOST_AUTO_TEST_CASE(what_is_given_twice_and_walls_within_a_solid_open_no_solid) {
  std::mt19937 bits(5);
  const auto with_triangle = [](const ClosedMesh& mesh, Eigen::Index t, bool is_turned) {
    ClosedMesh more{mesh.vertices, feeler::Triangles(mesh.triangles.rows() + 1, 3)};
    more.triangles << mesh.triangles, mesh.triangles.row(t);
    if (is_turned) std::swap(more.triangles(mesh.triangles.rows(), 1), more.triangles(mesh.triangles.rows(), 2));
    return more;
  };
  for (const ClosedMesh& shape : {cube(1), ball(1, 4), torus(1, 0.4, 12, 8).moved(Eigen::Quaterniond::Identity(), {-1, 0, 0})})
    for (int i = 0; i < 40; ++i) {
      ClosedMesh mesh = shape;
      for (int k = below(bits, 20); k > 0; --k) mesh = with_triangle(mesh, below(bits, int(mesh.triangles.rows())), false);
      if (i % 2 == 0) mesh = with_triangle(mesh, below(bits, int(shape.triangles.rows())), true);
      const Solid solid(mesh);
      BOOST_TEST(solid.contains(Vector(0.01, 0.02, 0.03)));
      BOOST_TEST(!solid.contains(Vector(1.5, 0.2, 0.1)));
    }
  // A block that walls cut into rooms, each of which is closed: all of it is solid.
  const auto rooms = [&](int count, bool are_turned) {
    ClosedMesh row{Points<double>(0, 3), feeler::Triangles(0, 3)};
    for (int i = 0; i < count; ++i) row = row.with(block({double(i), 0, 0}, {double(i + 1), 1, 1}));
    std::vector<Eigen::Index> kept;
    for (Eigen::Index t = 0; t < row.triangles.rows(); ++t) {
      const double x = row.vertices(row.triangles(t, 0), 0);
      const bool is_wall = x > 0 && x < count && row.vertices(row.triangles(t, 1), 0) == x && row.vertices(row.triangles(t, 2), 0) == x;
      if (!is_wall || (t / 12 < Eigen::Index(x)) == are_turned) kept.push_back(t);  // of the two that blocks share one
    }
    feeler::Triangles triangles(Eigen::Index(kept.size()), 3);
    for (std::size_t k = 0; k < kept.size(); ++k) triangles.row(Eigen::Index(k)) = row.triangles.row(kept[k]);
    return ClosedMesh{row.vertices, triangles};
  };
  for (const int count : {2, 3, 5})
    for (const bool are_turned : {false, true}) {
      const Solid solid(rooms(count, are_turned));
      BOOST_TEST(solid.mesh.triangle_count() == 10 * count + 2);
      for (int i = 0; i < count; ++i) BOOST_TEST(solid.contains(Vector(i + 0.5, 0.4, 0.3)), "room " << i << " of " << count);
      BOOST_TEST(!solid.contains(Vector(count + 0.5, 0.4, 0.3)));
    }
}

BOOST_AUTO_TEST_CASE(a_cavity_that_touches_the_wall_of_its_block_is_one) {
  const ClosedMesh outer = cube(0.02);
  for (int first = 0; first < 4; ++first) {
    ClosedMesh hole{Points<double>{{0.02, 0.003, 0.001}, {-0.01, 0.01, 0.0}, {-0.01, -0.01, 0.0}, {0.0, 0.0, 0.015}},
                    Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
    Triangles turned(4, 3);
    for (int t = 0; t < 4; ++t) turned.row(t) = hole.triangles.row((t + first) % 4);
    hole.triangles = turned;
    const Vector inside = hole.vertices.colwise().mean().transpose();
    const ClosedMesh both = outer.with(Solid(hole).contains(inside) ? hole.inverted() : hole);
    BOOST_TEST(!Solid(both).contains(inside));
    BOOST_TEST(Solid(both).contains(Vector(0.0, 0.0, -0.015)));
  }
}

BOOST_AUTO_TEST_CASE(a_point_near_the_surface_is_not_enclosed) {
  const Solid solid(cube(1));
  for (const double depth : {-1e-3, -1e-11, 0.0, 4e-12}) BOOST_TEST(!solid.interior.encloses(solid.mesh, Vector(0.3, 0.2, 1 - depth), 1e-11));
  BOOST_TEST(solid.interior.encloses(solid.mesh, Vector(0.3, 0.2, 1 - 2e-11), 1e-11));
}

BOOST_AUTO_TEST_CASE(a_point_near_any_side_of_a_cube_is_not_enclosed) {
  const Solid solid(cube(1));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      Vector point(0.3, 0.2, 0.1);
      point[axis] = side * (1 - 4e-4);
      BOOST_TEST(!solid.interior.encloses(solid.mesh, point, 1e-3));
      point[axis] = side * (1 - 2e-3);
      BOOST_TEST(solid.interior.encloses(solid.mesh, point, 1e-3));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_room_in_whose_wall_a_block_stands_is_no_cavity_of_that) {
  // Of the room's twelve triangles the two of one wall lie in the block.
  const Solid solid(cube(1).inverted().with(block({0.8, -0.5, -0.5}, {1.2, 0.5, 0.5})));
  BOOST_TEST(solid.contains(Vector(0.9, 0.1, 0.2)));
  BOOST_TEST(solid.contains(Vector(1.1, 0.1, 0.2)));
  BOOST_TEST(!solid.contains(Vector(0.5, 0.1, 0.2)));
  BOOST_TEST(!solid.contains(Vector(1.5, 0.1, 0.2)));
}

BOOST_AUTO_TEST_SUITE_END()
