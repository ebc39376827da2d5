#include <boost/test/unit_test.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "feeler/object/normal_cone.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "support/refusal.hpp"

BOOST_AUTO_TEST_SUITE(triangle_mesh)

using feeler::Convexity;
using feeler::MeshTopology;
using feeler::Points;
using feeler::Triangles;
using feeler_test::contains;
using feeler_test::refusal;
using Mesh = feeler::TriangleMesh<double>;
using Vector = feeler::Vector3<double>;

namespace {
double unit(std::mt19937& bits) { return double(bits()) / 2147483648.0 - 1.0; }

Points<double> points(std::initializer_list<Vector> list) {
  Points<double> result(Eigen::Index(list.size()), 3);
  Eigen::Index i = 0;
  for (const Vector& p : list) result.row(i++) = p.transpose();
  return result;
}
Triangles rows(std::initializer_list<std::array<int, 3>> list) {
  Triangles result(Eigen::Index(list.size()), 3);
  Eigen::Index i = 0;
  for (const auto& t : list) result.row(i++) << t[0], t[1], t[2];
  return result;
}

Points<double> cube_points() {
  Points<double> result(8, 3);
  for (int i = 0; i < 8; ++i) result.row(i) << i % 2, i / 2 % 2, i / 4;
  return result;
}
Triangles cube_triangles() {
  return rows({{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}});
}
/// Two triangles over the edge (0,0,0)–(0,1,0), whose far corners are at the height given; normals up.
Mesh fold(double height) { return Mesh(points({{0, 0, 0}, {0, 1, 0}, {1, 0.5, height}, {-1, 0.5, height}}), rows({{1, 0, 2}, {0, 1, 3}})); }
/// A bumpy sheet around the origin, of six triangles around vertex 0; without one of them where that is missing.
Mesh fan(const std::array<double, 6>& heights, int missing = 6) {
  Points<double> p(7, 3);
  Triangles t(6, 3);
  p.row(0).setZero();
  for (int i = 0; i < 6; ++i) {
    p.row(i + 1) << std::cos(i * 1.0471975511965976), std::sin(i * 1.0471975511965976), heights[std::size_t(i)];
    t.row(i) << 0, i + 1, (i + 1) % 6 + 1;
  }
  if (missing < 6) {
    t.row(missing) = t.row(5).eval();
    t.conservativeResize(5, 3);
  }
  return Mesh(p, t);
}
/// Which corner of a triangle of a fan is the origin.
int tip_of(const Mesh& mesh, int triangle) {
  const auto& corners = mesh.triangle(triangle);
  return mesh.vertex(corners[0]).isZero(0) ? 0 : mesh.vertex(corners[1]).isZero(0) ? 1 : 2;
}

Vector closest_on_segment(const Vector& a, const Vector& b, const Vector& p) {
  const double s = (b - a).squaredNorm() > 0 ? (p - a).dot(b - a) / (b - a).squaredNorm() : 0;
  return a + std::clamp(s, 0.0, 1.0) * (b - a);
}
/// Distance of a point to a mesh, from the definition: to all faces, edges and corners.
double distance(const Mesh& mesh, const Vector& p) {
  double best = std::numeric_limits<double>::infinity();
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix3d c = mesh.corners(t);
    for (int k = 0; k < 3; ++k) best = std::min(best, (closest_on_segment(c.col(k), c.col((k + 1) % 3), p) - p).norm());
    const Vector n = (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0)).normalized();
    bool is_over = true;
    for (int k = 0; k < 3; ++k) is_over = is_over && n.dot((c.col((k + 1) % 3) - c.col(k)).cross(p - c.col(k))) >= 0;
    if (is_over) best = std::min(best, std::abs(n.dot(p - c.col(0))));
  }
  return best;
}
}  // namespace

BOOST_AUTO_TEST_CASE(cube_is_closed_and_all_its_edges_and_corners_stick_out) {
  const Mesh mesh(cube_points(), cube_triangles());
  BOOST_TEST(mesh.report().is_closed_manifold());
  BOOST_TEST(mesh.report().vertices == 8);
  BOOST_TEST(mesh.report().welded_vertices == 0);
  int convex = 0, flat = 0;
  for (int t = 0; t < 12; ++t) {
    const Vector outward = mesh.corners(t).rowwise().mean() - Vector(0.5, 0.5, 0.5);
    BOOST_TEST(std::abs(mesh.normal(t).dot(outward) - 0.5) < 1e-15);
    for (int k = 0; k < 3; ++k) {
      convex += mesh.topology().edge_convexity(t, k) == Convexity::convex;
      flat += mesh.topology().edge_convexity(t, k) == Convexity::flat;
      const int other = mesh.topology().neighbour(t, k);
      BOOST_TEST_REQUIRE(other >= 0);
      bool is_mutual = false;
      for (int j = 0; j < 3; ++j) is_mutual = is_mutual || mesh.topology().neighbour(other, j) == t;
      BOOST_TEST(is_mutual);
    }
  }
  BOOST_TEST(convex == 24);
  BOOST_TEST(flat == 12);
  int valences = 0;
  for (int v = 0; v < 8; ++v) {
    BOOST_TEST((mesh.topology().vertex_convexity(v) == Convexity::convex));
    valences += int(mesh.topology().vertex_neighbours(v).size());
  }
  BOOST_TEST(valences == 2 * 18);
  BOOST_TEST((mesh.bounds().min() == Vector(0, 0, 0)));
  BOOST_TEST((mesh.bounds().max() == Vector(1, 1, 1)));
}

BOOST_AUTO_TEST_CASE(room_is_a_cube_inside_out_with_concave_edges_and_corners) {
  Triangles inverted = cube_triangles();
  inverted.col(1).swap(inverted.col(2));
  const Mesh mesh(cube_points(), inverted);
  BOOST_TEST(mesh.report().is_closed_manifold());
  int concave = 0;
  for (int t = 0; t < 12; ++t)
    for (int k = 0; k < 3; ++k) concave += mesh.topology().edge_convexity(t, k) == Convexity::concave;
  BOOST_TEST(concave == 24);
  for (int v = 0; v < 8; ++v) BOOST_TEST((mesh.topology().vertex_convexity(v) == Convexity::concave));
}

BOOST_AUTO_TEST_CASE(roof_is_convex_valley_concave_and_plane_flat) {
  const auto middle_edge = [](const Mesh& mesh) { return mesh.topology().edge_convexity(0, 0); };
  for (const double height : {1.0, 1e-3, 1e-9, 1e-14}) {
    BOOST_TEST((middle_edge(fold(-height)) == Convexity::convex));
    BOOST_TEST((middle_edge(fold(height)) == Convexity::concave));
  }
  BOOST_TEST((middle_edge(fold(0)) == Convexity::flat));
  BOOST_TEST((middle_edge(fold(1e-17)) == Convexity::flat));
  BOOST_TEST((fold(1).topology().edge_convexity(0, 1) == Convexity::boundary));
  BOOST_TEST((fold(1).topology().vertex_convexity(0) == Convexity::boundary));
}

BOOST_AUTO_TEST_CASE(knife_edge_of_a_sheet_with_two_sides_is_convex) {
  const Mesh mesh(points({{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {0.7, 0.2, 0}}), rows({{1, 0, 2}, {0, 1, 3}}));
  BOOST_TEST((mesh.topology().edge_convexity(0, 0) == Convexity::convex));
}

BOOST_AUTO_TEST_CASE(saddle_vertex_is_mixed_and_tip_and_pit_are_not) {
  const auto middle = [](double height, double wave) {
    const Mesh mesh = fan({height + wave, height - wave, height + wave, height - wave, height + wave, height - wave});
    return mesh.topology().vertex_convexity(0);
  };
  BOOST_TEST((middle(-0.5, 0) == Convexity::convex));
  BOOST_TEST((middle(0.5, 0) == Convexity::concave));
  BOOST_TEST((middle(0, 0) == Convexity::flat));
  BOOST_TEST((middle(0, 0.5) == Convexity::mixed));
}

BOOST_AUTO_TEST_CASE(open_sheet_has_a_boundary) {
  const Mesh mesh = fan({0, 0, 0, 0, 0, 0});
  BOOST_TEST(mesh.report().boundary_edges == 6);
  BOOST_TEST(!mesh.report().is_closed_manifold());
  BOOST_TEST(mesh.topology().neighbour(0, 1) == MeshTopology::boundary);
  BOOST_TEST(mesh.topology().neighbour(0, 0) == 5);
  BOOST_TEST(mesh.topology().neighbour(0, 2) == 1);
  BOOST_TEST(contains(to_string(mesh.report()), "6 triangles on 7 vertices; not a closed surface. It has 6 open edges."));
}

BOOST_AUTO_TEST_CASE(three_triangles_at_an_edge_are_non_manifold) {
  const Mesh mesh(points({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}}), rows({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  BOOST_TEST(mesh.report().non_manifold_edges == 1);
  BOOST_TEST(mesh.report().non_manifold_vertices == 2);
  for (int t = 0; t < 3; ++t) {
    BOOST_TEST(mesh.topology().neighbour(t, 0) == MeshTopology::non_manifold);
    BOOST_TEST((mesh.topology().edge_convexity(t, 0) == Convexity::non_manifold));
  }
}

BOOST_AUTO_TEST_CASE(two_cubes_that_share_a_corner_have_a_non_manifold_vertex) {
  Points<double> p(16, 3);
  p.topRows(8) = cube_points();
  p.bottomRows(8) = -cube_points();
  Triangles t(24, 3);
  t.topRows(12) = cube_triangles();
  t.bottomRows(12) = cube_triangles().array() + 8;
  const Mesh mesh(p, t);
  BOOST_TEST(mesh.report().welded_vertices == 1);
  BOOST_TEST(mesh.report().non_manifold_vertices == 1);
  BOOST_TEST(mesh.report().boundary_edges == 0);
  BOOST_TEST(!mesh.report().is_closed_manifold());
}

BOOST_AUTO_TEST_CASE(duplicate_degenerate_and_inverted_triangles_are_kept_and_reported) {
  Triangles t(16, 3);
  t.topRows(12) = cube_triangles();
  t.row(12) << 3, 0, 2;  // row 0 again
  t.row(13) << 3, 2, 0;  // and turned over
  t.row(14) << 5, 5, 7;
  t.row(15) << 6, 6, 6;
  const Mesh mesh(cube_points(), t);
  BOOST_TEST(mesh.triangle_count() == 16);
  BOOST_TEST(mesh.report().duplicate_triangles == 2);
  BOOST_TEST(mesh.report().degenerate_triangles == 2);
  BOOST_TEST(mesh.report().non_manifold_edges == 3);
  BOOST_TEST(mesh.normal(14).isZero(0));
  for (int i = 0; i < 16; ++i)
    for (int k = 0; k < 3; ++k) BOOST_TEST((mesh.corners(i).col(k) == cube_points().row(t(i, k)).transpose()));

  Triangles inverted = cube_triangles();
  std::swap(inverted(4, 0), inverted(4, 1));
  BOOST_TEST(Mesh(cube_points(), inverted).report().inconsistent_edges == 3);
}

BOOST_AUTO_TEST_CASE(triangle_is_degenerate_only_to_rounding_at_any_size) {
  for (const double scale : {1e-150, 1e-6, 1.0, 1e6, 1e150}) {
    const auto one = [scale](double height) { return Mesh(points({{0, 0, 0}, {scale, 0, 0}, {scale / 3, scale * height, 0}}), rows({{0, 1, 2}})); };
    BOOST_TEST(one(0).report().degenerate_triangles == 1);
    BOOST_TEST(one(1e-12).report().degenerate_triangles == 0);
    BOOST_TEST((one(1e-12).normal(0) - Vector(0, 0, 1)).norm() < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(points_on_a_line_in_space_make_no_triangle_and_a_low_one_beside_a_high_one_is_flat) {
  constexpr unsigned seed = 12;
  std::mt19937 bits(seed);
  int with_area = 0, bent = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto random = [&] { return Vector(unit(bits), unit(bits), unit(bits)); };
    const Vector start = random() / 2, along = random().normalized(), across = along.cross(random()).normalized();
    const Vector end = start + along, between = start + (0.5 + 0.1 * unit(bits)) * along;
    with_area += Mesh(points({start, end, between}), rows({{0, 1, 2}})).normal(0).isZero(0) ? 0 : 1;
    const Mesh sheet(points({start, end, between + 1e-6 * across, between - across}), rows({{0, 1, 2}, {1, 0, 3}}));
    bent += sheet.topology().edge_convexity(0, 0) == Convexity::flat ? 0 : 1;
  }
  BOOST_TEST(with_area == 0);
  BOOST_TEST(bent == 0);
}

BOOST_AUTO_TEST_CASE(soup_is_welded_also_over_the_sign_of_zero) {
  Points<double> p(36, 3);
  Triangles t(12, 3);
  for (int i = 0; i < 36; ++i) {
    p.row(i) = cube_points().row(cube_triangles()(i / 3, i % 3));
    for (int k = 0; k < 3; ++k)
      if (p(i, k) == 0 && (i + k) % 2 == 0) p(i, k) = -0.0;
    t(i / 3, i % 3) = i;
  }
  const Mesh mesh(p, t);
  BOOST_TEST(mesh.vertex_count() == 8);
  BOOST_TEST(mesh.report().welded_vertices == 28);
  BOOST_TEST(mesh.report().is_closed_manifold());
}

BOOST_AUTO_TEST_CASE(copies_do_not_refer_to_the_original) {
  auto original = std::make_unique<Mesh>(cube_points(), cube_triangles());
  const Mesh copy = *original;
  original.reset();
  BOOST_TEST(copy.topology().neighbour(0, 2) == 1);
  BOOST_TEST(feeler::vertex_cone_contains<double>(copy, 0, Vector(-1, -1, -1).normalized(), 0.0));
  BOOST_TEST(copy.bvh().leaves().size() >= 3U);
}

BOOST_AUTO_TEST_CASE(cones_agree_with_the_closest_point) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    BOOST_TEST_MESSAGE("seed " << seed);
    std::mt19937 bits(seed);
    std::array<double, 6> heights{};
    for (double& h : heights) h = unit(bits);
    const Mesh mesh = fan(heights);
    int inside = 0;
    for (int i = 0; i < 400; ++i) {
      const Vector any = Vector(unit(bits), unit(bits), unit(bits)).normalized();
      const double t = 1e-3;
      // Closest there to within the tilt that a tolerance of 1e-3 in the sine allows; directions in between
      // prove nothing.
      const auto check = [&](const Vector& place, const Vector& d, bool strictly, bool loosely) {
        const bool is_closest = distance(mesh, place + t * d) >= t * (1 - 1e-12);
        if (strictly) BOOST_TEST(is_closest);
        if (!loosely) BOOST_TEST(!is_closest);
        inside += strictly;
      };
      check(Vector::Zero(), any, feeler::vertex_cone_contains<double>(mesh, 0, any, -1e-3), feeler::vertex_cone_contains<double>(mesh, 0, any, 1e-3));
      for (int triangle = 0; triangle < 6; ++triangle)
        for (int k = 0; k < 3; ++k) {
          const Eigen::Matrix3d c = mesh.corners(triangle);
          const Vector along = (c.col((k + 1) % 3) - c.col(k)).normalized();
          const Vector d = (any - along * along.dot(any)).normalized();
          const Vector place = c.col(k) + 0.5 * (c.col((k + 1) % 3) - c.col(k));
          check(place, d, feeler::edge_cone_contains<double>(mesh, triangle, k, d, -1e-3),
                feeler::edge_cone_contains<double>(mesh, triangle, k, d, 1e-3));
        }
    }
    BOOST_TEST(inside > 0);
  }
}

BOOST_AUTO_TEST_CASE(the_triangle_along_a_direction_has_the_edge_that_points_most_along_it) {
  constexpr unsigned seed = 11;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int along = 0, away = 0;
  for (int round = 0; round < 2000; ++round) {
    std::array<double, 6> heights{};
    for (double& h : heights) h = round % 2 == 0 ? unit(bits) : unit(bits) - 1;  // every second one more of a tip
    const Mesh mesh = fan(heights, round % 7);
    const Vector direction = Vector(unit(bits), unit(bits), unit(bits)).normalized();
    const auto highest_of = [&](int triangle) {
      double highest = 0;
      for (const int v : mesh.triangle(triangle))
        if (!mesh.vertex(v).isZero(0)) highest = std::max(highest, direction.dot(mesh.vertex(v).normalized()));
      return highest;
    };
    for (int start = 0; start < mesh.triangle_count(); ++start) {
      const int corner = tip_of(mesh, start);
      double highest = 0;
      for (int other = 0; other < mesh.triangle_count(); ++other)
        if (other != start) highest = std::max(highest, highest_of(other));
      const int found = feeler::triangle_along<double>(mesh, start, corner, direction);
      BOOST_TEST(found != start);
      if (highest > 0) BOOST_TEST((found >= 0 && highest_of(found) == highest));
      else BOOST_TEST(found == -1);
      ++(highest > 0 ? along : away);
    }
  }
  BOOST_TEST(along > 1000);
  BOOST_TEST(away > 100);
}

BOOST_AUTO_TEST_CASE(a_ray_leads_under_a_neighbour_where_a_triangle_covers_it_in_the_view_and_rises_over_it) {
  constexpr unsigned seed = 12;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int under = 0, clear = 0;
  for (int round = 0; round < 2000; ++round) {
    std::array<double, 6> heights{};
    for (double& h : heights) h = unit(bits);
    const Mesh mesh = fan(heights, round % 7);
    const Vector view = Vector(unit(bits), unit(bits), unit(bits)).normalized();
    const Vector ray = view.cross(Vector(unit(bits), unit(bits), unit(bits))), upward = view.cross(ray).normalized();
    for (int start = 0; start < mesh.triangle_count(); ++start) {
      const int corner = tip_of(mesh, start);
      bool is_covered = false;
      for (int other = 0; other < mesh.triangle_count(); ++other) {
        if (other == start) continue;
        // ray = α a + β b + γ view, with α, β > 0, of which one rises.
        const int tip = tip_of(mesh, other);
        Eigen::Matrix3d basis;
        basis << mesh.corners(other).col((tip + 1) % 3), mesh.corners(other).col((tip + 2) % 3), view;
        const Vector weights = basis.partialPivLu().solve(ray);
        is_covered = is_covered || (weights[0] > 0 && weights[1] > 0);
      }
      BOOST_TEST(feeler::leads_under_a_neighbour<double>(mesh, start, corner, ray, upward, 1e-9) == is_covered);
      ++(is_covered ? under : clear);
    }
  }
  BOOST_TEST(under > 1000);
  BOOST_TEST(clear > 1000);
}

BOOST_AUTO_TEST_CASE(a_flat_surface_leads_a_ray_along_it_under_nothing_and_a_valley_does_in_every_view_across_it) {
  // Two plates that meet along y, of which the right one rises.
  for (const double slope : {0.0, 0.2, -0.2}) {
    const Mesh mesh =
        Mesh(Points<double>{{-1, -1, 0}, {0, -1, 0}, {0, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {1, -1, slope}, {1, 0, slope}, {1, 1, slope}},
             Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}, {1, 6, 7}, {1, 7, 2}, {2, 7, 8}, {2, 8, 4}});
    for (int triangle = 0; triangle < 4; ++triangle)
      for (int corner = 0; corner < 3; ++corner) {
        if (!mesh.vertex(mesh.triangle(triangle)[std::size_t(corner)]).isZero(0)) continue;
        for (const Vector& ray : {Vector(1, 0, 0), Vector(1, 0.3, 0), Vector(1, -0.3, 0)})
          BOOST_TEST(feeler::leads_under_a_neighbour<double>(mesh, triangle, corner, ray, Vector::UnitZ(), 1e-6) == (slope > 0));
        BOOST_TEST(!feeler::leads_under_a_neighbour<double>(mesh, triangle, corner, Vector(-1, 0, 0), Vector::UnitZ(), 1e-6));
      }
  }
}

BOOST_AUTO_TEST_CASE(vertex_of_many_edges_accepts_every_direction) {
  const int n = 65;
  Points<double> p(n + 1, 3);
  Triangles t(n, 3);
  p.row(n).setZero();
  for (int i = 0; i < n; ++i) {
    p.row(i) << std::cos(6.283185307179586 * i / n), std::sin(6.283185307179586 * i / n), -1;
    t.row(i) << n, i, (i + 1) % n;
  }
  const Mesh mesh(p, t);
  int tip = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.vertex(v).isZero(0)) tip = v;
  BOOST_TEST(mesh.topology().vertex_neighbours(tip).size() == 65U);
  BOOST_TEST(feeler::vertex_cone_contains<double>(mesh, tip, Vector(0, 0, -1), 0.0));
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_with_a_sentence) {
  Points<double> p = cube_points();
  Triangles t = cube_triangles();
  BOOST_TEST(contains(refusal([&] { Mesh(p, Triangles(0, 3)); }), "there are no triangles"));
  t(7, 1) = 8;
  BOOST_TEST(contains(refusal([&] { Mesh(p, t); }), "triangle 7 has the index 8, but there are 8 vertices"));
  t(7, 1) = -1;
  BOOST_TEST(contains(refusal([&] { Mesh(p, t); }), "triangle 7 has the index -1"));
  p(3, 2) = std::numeric_limits<double>::infinity();
  BOOST_TEST(contains(refusal([&] { Mesh(p, cube_triangles()); }), "vertex 3 has a NaN or an infinity"));
}

BOOST_AUTO_TEST_CASE(a_mesh_from_the_arrays_of_an_engine_is_that_from_matrices) {
  std::vector<float> millimetres;
  std::vector<unsigned> indices;
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) millimetres.push_back(float(1000 * cube_points()(i, k)));
  for (int i = 0; i < 12; ++i)
    for (int k = 0; k < 3; ++k) indices.push_back(unsigned(cube_triangles()(i, k)));
  const Mesh expected(cube_points(), cube_triangles()), mesh(millimetres.data(), 8, indices.data(), 12, 0.001);
  BOOST_TEST(mesh.report().is_closed_manifold());
  BOOST_TEST(mesh.triangle_count() == 12);
  for (int i = 0; i < 12; ++i) BOOST_TEST((mesh.corners(i) == expected.corners(i)));
  BOOST_TEST((Mesh(1000 * cube_points(), cube_triangles(), 0.001).corners(5) == expected.corners(5)));

  const auto refused = [&](std::size_t vertex_count, std::size_t triangle_count) {
    return refusal([&] { Mesh(millimetres.data(), vertex_count, indices.data(), triangle_count); });
  };
  BOOST_TEST(contains(refused(7, 12), "but there are 7 vertices"));
  BOOST_TEST(contains(refused(8, std::size_t(-1)), "there may be 715827882 of each"));
  BOOST_TEST(contains(refused(std::size_t(1) << 40, 12), "there may be 715827882 of each"));
  BOOST_TEST(contains(refusal([&] { Mesh(millimetres.data(), 8, static_cast<const int*>(nullptr), 12); }), "null"));
  BOOST_TEST(contains(Mesh::reason_against(static_cast<const float*>(nullptr), 8, indices.data(), 12), "null"));
  indices[4] = 4294967295U;  // -1 once more
  BOOST_TEST(contains(refused(8, 12), "triangle 1 has the index 4294967295, but there are 8 vertices"));
  for (const double scale : {0.0, -1.0, std::nan(""), HUGE_VAL})
    BOOST_TEST(contains(refusal([&] { Mesh(cube_points(), cube_triangles(), scale); }), "the scale is not a positive number"));
  BOOST_TEST(contains(refusal([&] { Mesh(2 * cube_points(), cube_triangles(), 1e308); }), "vertex 1 is too far away for the scalar of the mesh"));
  const std::array<double, 9> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::array<signed char, 3> numbers{0, 1, 2}, negative{0, 1, -3};
  BOOST_TEST(Mesh::reason_against(corners.data(), 3, numbers.data(), 1) == "");
  BOOST_TEST(contains(Mesh::reason_against(corners.data(), 3, negative.data(), 1), "has the index -3"));
}

BOOST_AUTO_TEST_CASE(a_report_tells_the_size_and_warns_of_what_looks_like_millimetres) {
  const Mesh small(0.05 * cube_points(), cube_triangles()), large(100 * cube_points(), cube_triangles());
  BOOST_TEST((small.report().upper == std::array<double, 3>{0.05, 0.05, 0.05}));
  BOOST_TEST(small.report().width() == 0.05);
  BOOST_TEST(contains(to_string(small.report()), "a closed surface. It is 0.05 by 0.05 by 0.05 m."));
  BOOST_TEST(!contains(to_string(small.report()), "millimetres"));
  BOOST_TEST(contains(to_string(large.report()), "It is 100 by 100 by 100 m. If its numbers are millimetres, give the mesh the scale 0.001."));
  BOOST_TEST(!contains(to_string(Mesh(100 * cube_points(), cube_triangles(), 0.001).report()), "millimetres"));
}

BOOST_AUTO_TEST_CASE(points_and_lines_alone_are_no_closed_surface) {
  const auto p = points({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  for (const auto& t : {rows({{0, 0, 0}}), rows({{0, 1, 1}}), rows({{0, 1, 1}, {2, 2, 3}}), rows({{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}})}) {
    BOOST_TEST(!Mesh(p, t).report().is_closed_manifold());
    BOOST_TEST(contains(to_string(Mesh(p, t).report()), "not a closed surface"));
  }
}

BOOST_AUTO_TEST_CASE(float_and_long_double_meshes_have_the_same_topology) {
  const feeler::TriangleMesh<float> narrow(cube_points().cast<float>(), cube_triangles());
  const feeler::TriangleMesh<long double> wide(cube_points().cast<long double>(), cube_triangles());
  BOOST_TEST(narrow.report().is_closed_manifold());
  BOOST_TEST(wide.report().is_closed_manifold());
  for (int t = 0; t < 12; ++t)
    for (int k = 0; k < 3; ++k) BOOST_TEST((narrow.topology().edge_convexity(t, k) == wide.topology().edge_convexity(t, k)));
  BOOST_TEST(feeler::edge_cone_contains<float>(narrow, 0, 0, feeler::Vector3<float>(-1, 0, -1).normalized(), 0.0F));
}

BOOST_AUTO_TEST_CASE(the_ends_of_an_edge_of_four_triangles_are_at_a_boundary) {
  Points<double> p(16, 3);
  p.topRows(8) = cube_points();
  p.bottomRows(8) = cube_points().rowwise() + Eigen::RowVector3d(1, 1, 0);  // they share an edge along z
  Triangles t(24, 3);
  t.topRows(12) = cube_triangles();
  t.bottomRows(12) = cube_triangles().array() + 8;
  const Mesh mesh(p, t);
  BOOST_TEST(mesh.report().non_manifold_edges == 1);
  BOOST_TEST(mesh.report().boundary_edges == 0);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const bool is_shared = mesh.vertex(v).x() == 1 && mesh.vertex(v).y() == 1;
    BOOST_TEST((mesh.topology().vertex_convexity(v) == (is_shared ? Convexity::boundary : Convexity::convex)));
  }
}

BOOST_AUTO_TEST_CASE(triangles_without_area_at_a_vertex_are_no_sheets_of_their_own) {
  Triangles t(14, 3);
  t.topRows(12) = cube_triangles();
  t.row(12) << 5, 5, 7;
  t.row(13) << 6, 6, 6;
  const Mesh mesh(cube_points(), t);
  BOOST_TEST(mesh.report().degenerate_triangles == 2);
  BOOST_TEST(mesh.report().non_manifold_vertices == 0);
  BOOST_TEST(mesh.report().boundary_edges == 0);
  BOOST_TEST(mesh.report().is_closed_manifold());
}

BOOST_AUTO_TEST_CASE(a_surface_of_which_a_triangle_is_turned_is_no_closed_manifold) {
  Triangles t = cube_triangles();
  std::swap(t(4, 0), t(4, 1));
  const Mesh mesh(cube_points(), t);
  BOOST_TEST(mesh.report().boundary_edges + mesh.report().non_manifold_edges + mesh.report().non_manifold_vertices == 0);
  BOOST_TEST(!mesh.report().is_closed_manifold());
}

BOOST_AUTO_TEST_CASE(vertices_of_no_triangle_are_left_out_and_tell_nothing_of_the_size) {
  Points<double> p(11, 3);
  p.topRows(8) = cube_points();
  p.row(8) << 50, 0, 0;
  p.row(9) << 50, 0, 0;
  p.row(10) << 1, 1, 1;  // where another one is
  const Mesh mesh(p, cube_triangles());
  BOOST_TEST(mesh.vertex_count() == 8);
  BOOST_TEST(mesh.report().vertices == 8);
  BOOST_TEST(mesh.report().welded_vertices == 0);
  BOOST_TEST((mesh.bounds().max() == Vector(1, 1, 1)));
  BOOST_TEST(!mesh.report().looks_like_millimetres());
}

BOOST_AUTO_TEST_CASE(the_width_of_a_mesh_is_its_longest_side_whichever_that_is) {
  for (int axis = 0; axis < 3; ++axis) {
    Points<double> p = cube_points();
    p.col(axis) *= 12;
    const Mesh mesh(p, cube_triangles());
    BOOST_TEST(mesh.report().width() == 12);
    BOOST_TEST(mesh.report().looks_like_millimetres());
  }
}

BOOST_AUTO_TEST_CASE(at_a_corner_the_edges_of_the_triangle_itself_are_no_neighbours) {
  std::mt19937 bits(13);
  const Mesh alone(points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), rows({{0, 1, 2}}));
  const Mesh two(points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}), rows({{0, 1, 2}, {0, 2, 3}}));
  for (int i = 0; i < 200; ++i) {
    const Vector any = Vector(unit(bits), unit(bits), unit(bits)).normalized();
    for (int corner = 0; corner < 3; ++corner) BOOST_TEST(feeler::neighbours_point_away<double>(alone, 0, corner, any, 0.0));
    // The other triangle has an edge along −x there.
    BOOST_TEST(feeler::neighbours_point_away<double>(two, 0, 0, any, 0.0) == (any.x() >= 0));
  }
}

BOOST_AUTO_TEST_SUITE_END()
