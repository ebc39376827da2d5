#include "feeler/contact/contact_patch.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "feeler/proximity/separation.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/round_solids.hpp"
#include "feeler/tool/tool_incidence.hpp"
#include "scenes/height_field.hpp"
#include "support/random_tools.hpp"
#include "support/sanitized.hpp"

BOOST_AUTO_TEST_SUITE(contact_patch)

using feeler::ContactPatch;
using feeler::FeaturePair;
using feeler::PatchRows;
using feeler::TriangleMesh;
using feeler::test::trials_to_run;
using namespace feeler_test;
using Box = feeler::Box<double>;
using Mesh = TriangleMesh<double>;

namespace {

constexpr double band = 2.5e-4, in_touch = 1e-6;

Mesh mesh_of(std::initializer_list<Vector> points, std::initializer_list<std::array<int, 3>> rows) {
  feeler::Points<double> vertices(Eigen::Index(points.size()), 3);
  feeler::Triangles triangles(Eigen::Index(rows.size()), 3);
  Eigen::Index i = 0;
  for (const Vector& p : points) vertices.row(i++) = p.transpose();
  i = 0;
  for (const auto& t : rows) triangles.row(i++) << t[0], t[1], t[2];
  return {vertices, triangles};
}

/// The floor z = 0 within 1 m, in two triangles that meet in the line x = y.
Mesh floor() { return mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}); }
/// A roof whose ridge is the y axis; slopes of 45° and no bottom.
Mesh roof() { return mesh_of({{0, -1, 0}, {0, 1, 0}, {1, 0, -1}, {-1, 0, -1}}, {{0, 2, 1}, {0, 1, 3}}); }
/// A floor of cells of two triangles each.
Mesh floor(const feeler::scenes::Grid& grid) {
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
  feeler::scenes::mesh_height_field(grid, [](double, double) { return 0.0; }, vertices, triangles);
  return {vertices, triangles};
}
/// A floor cut along y into strips of a width, from x = −5 to 5 of them.
Mesh strips(double width) { return floor({-5 * width, 5 * width, -1, 1, 10, 1}); }
/// A spike that points up, with its tip at the origin.
Mesh spike() { return mesh_of({{0, 0, 0}, {1, -1, -3}, {1, 1, -3}, {-1, 0, -3}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}); }

struct Found {
  bool has_rows = false;
  PatchRows<double> rows;
  double distance = 0;
  bool is_ghost = false;
  int nearer = -1;  // the triangle that the patch names
  std::vector<int> continuations;  // those that it visits, of a plane nearer than `in_touch`
  std::set<int> at_rim;            // those that it visits at the rim of the wall
  bool is_filler = false;

  int count(FeaturePair kind) const {
    int n = 0;
    for (const auto& row : rows) n += row.kind == kind ? 1 : 0;
    return n;
  }
};

template <class Tool>
Found find(const Tool& tool, const Mesh& mesh, int triangle, const feeler::Pose<double>& pose, bool keep_ghost = false,
           const Vector& reference = Vector::Zero(), bool may_assume = false) {
  const Eigen::Matrix3d axes = pose.rotation.toRotationMatrix();
  // pose.translation is where the reference point is.
  const Eigen::Matrix3d corners = (axes.transpose() * (mesh.corners(triangle).colwise() - pose.translation)).colwise() + reference;
  const auto closest = feeler::separation(tool, corners, {}, 1e-8);
  const feeler::FeatureIncidence incidence = feeler::incidence_of(tool);
  feeler::VertexSet near(tool.vertex_count());
  ContactPatch<Tool, double> patch(tool, incidence, mesh, axes, reference, band, may_assume, near);
  Found found;
  found.has_rows = patch.find(triangle, corners, closest, keep_ghost, found.rows);
  found.is_ghost = patch.is_ghost();
  found.distance = closest.distance;
  found.nearer = patch.nearer_triangle(closest);
  patch.visit_continuations(in_touch, [&](int continuation) { found.continuations.push_back(continuation); });
  patch.visit_rim([](int) { return false; }, [&](int other) { found.at_rim.insert(other); });
  found.is_filler = patch.is_filler();
  return found;
}

feeler::Pose<double> at(const Vector& translation, const Eigen::Quaterniond& rotation = Eigen::Quaterniond::Identity()) {
  return {translation, rotation};
}
Eigen::Quaterniond turn(double angle, const Vector& axis) { return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())); }

}  // namespace

BOOST_AUTO_TEST_CASE(a_box_flat_on_a_triangle_has_its_four_bottom_vertices_on_it) {
  const Mesh mesh = floor();
  const Vector half(0.03, 0.02, 0.01);
  const Box box(half);
  for (const double gap : {1e-9, 1e-6, 1e-5, 0.0, -1e-9}) {
    const Vector place(0.5, -0.5, half.z() + gap);  // in the first triangle, turned about the vertical
    for (const double angle : {0.0, 0.3, 2.0}) {
      const auto pose = at(place, turn(angle, Vector::UnitZ()));
      const Found found = find(box, mesh, 0, pose);
      BOOST_TEST(found.has_rows);
      BOOST_TEST(found.rows.size() == 4);
      BOOST_TEST(found.count(FeaturePair::vertex_face) == 4);
      std::vector<Vector> arms;
      for (const auto& row : found.rows) {
        BOOST_TEST((row.normal - Vector::UnitZ()).norm() < 1e-15);
        BOOST_TEST(std::abs(row.gap - gap) < 1e-16);
        arms.push_back(pose.rotation.conjugate() * row.arm);
        BOOST_TEST((arms.back().cwiseAbs() - half).norm() < 1e-15);
        BOOST_TEST(arms.back().z() < 0);
      }
      for (std::size_t i = 0; i < arms.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) BOOST_TEST((arms[i] - arms[k]).norm() > 0.03);
    }
  }
}

BOOST_AUTO_TEST_CASE(features_meet_within_a_quarter_of_the_band_and_of_a_pair_farther_away_only_the_closest_do) {
  const Mesh mesh = floor();
  const Vector half(0.03, 0.02, 0.01);
  const Box box(half);
  // Tilted about y: two bottom vertices lie at the distance given, and two higher by `rise`.
  const auto rows_at = [&](double distance, double rise) {
    const Eigen::Quaterniond tilt = turn(std::asin(rise / (2 * half.x())), Vector::UnitY());
    const Eigen::Matrix3d axes = tilt.toRotationMatrix();
    const double lowest = -axes.row(2).cwiseAbs().dot(half);
    const Found found = find(box, mesh, 0, at({0.5, -0.5, distance - lowest}, tilt));
    BOOST_TEST(found.has_rows);
    BOOST_TEST(std::abs(found.distance - distance) < 1e-11);
    return found.rows.size();
  };
  BOOST_TEST(rows_at(0.05 * band, 0.19 * band) == 4);
  BOOST_TEST(rows_at(0.05 * band, 0.21 * band) == 2);  // the gaps of the other two are too wide
  BOOST_TEST(rows_at(0.24 * band, 0.0) == 4);
  BOOST_TEST(rows_at(0.26 * band, 0.0) == 1);
}

BOOST_AUTO_TEST_CASE(a_face_goes_on_where_a_vertex_touches_its_plane_beside_the_triangle) {
  const Box box(Vector(0.03, 0.02, 0.01));
  const auto continuations = [&](const Mesh& mesh, double x, double gap) { return find(box, mesh, 0, at({x, 0.0, 0.01 + gap})).continuations; };
  const std::vector<int> none, both_left_vertices{1, 1};
  BOOST_TEST((continuations(floor(), 0.0, 0.5e-6) == both_left_vertices));  // over the diagonal
  BOOST_TEST((continuations(floor(), 0.5, 0.5e-6) == none));                // whole over the triangle
  BOOST_TEST((continuations(floor(), 0.0, 1.5e-6) == none));                // too far
  const Mesh bent = mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, -1e-5}}, {{0, 1, 2}, {0, 2, 3}});
  BOOST_TEST((continuations(bent, 0.0, 0.5e-6) == none));  // what is beside it is another face
}

BOOST_AUTO_TEST_CASE(arms_are_from_the_reference_point_and_normals_in_world_axes_wherever_the_scene_is) {
  constexpr unsigned seed = 1;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const Box box(Vector(0.03, 0.02, 0.01));
  for (int i = 0; i < 100; ++i) {
    // The whole scene is turned and moved.
    const Eigen::Quaterniond q = random_rotation(bits);
    const Vector p = random_vector(bits);
    const Mesh mesh = mesh_of({p + q * Vector(-1, -1, 0), p + q * Vector(1, -1, 0), p + q * Vector(1, 1, 0)}, {{0, 1, 2}});
    const Vector reference = 0.1 * random_vector(bits);
    const Vector centre = p + q * Vector(0.5, -0.3, 0.01 + 1e-6);
    const Found found = find(box, mesh, 0, at(centre + q * reference, q), false, reference);
    BOOST_TEST_REQUIRE(found.rows.size() == 4);
    for (const auto& row : found.rows) {
      BOOST_TEST((row.normal - q * Vector::UnitZ()).norm() < 1e-13);
      BOOST_TEST(std::abs(row.gap - 1e-6) < 1e-14);
      const Vector corner = q.conjugate() * (centre + q * reference + row.arm - centre);
      BOOST_TEST((corner.cwiseAbs() - Vector(0.03, 0.02, 0.01)).norm() < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_box_on_a_spike_has_the_tip_in_its_face) {
  const Mesh mesh = spike();
  const Box box(Vector(0.1, 0.1, 0.1));
  for (const double gap : {1e-6, 1e-5, 0.0}) {
    for (int triangle = 0; triangle < 3; ++triangle) {
      const auto pose = at(Vector(0.02, -0.03, 0.1 + gap), turn(0.4, Vector::UnitZ()));
      const Found found = find(box, mesh, triangle, pose);
      BOOST_TEST(found.has_rows);
      BOOST_TEST_REQUIRE(found.rows.size() == 1);
      const auto& row = found.rows[0];
      BOOST_TEST((row.kind == FeaturePair::face_vertex));
      BOOST_TEST((row.normal - Vector::UnitZ()).norm() < 1e-15);  // into the box
      BOOST_TEST(std::abs(row.gap - gap) < 1e-15);
      BOOST_TEST((row.arm + pose.translation).norm() < 1e-15);  // the tip is the origin
      const Vector tip = pose.rotation.conjugate() * -pose.translation;
      BOOST_TEST(row.room == 0.1 - std::max(std::abs(tip.x()), std::abs(tip.y())), boost::test_tools::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_corner_amid_a_wall_is_none_for_a_face_that_lies_on_it) {
  const Mesh mesh = mesh_of({{0, 0, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  const Box box(Vector(0.03, 0.02, 0.01));
  for (int triangle = 0; triangle < 4; ++triangle) {
    const Found found = find(box, mesh, triangle, at(Vector(0.01, 0.005, 0.01 + 1e-6)));
    BOOST_TEST(found.has_rows);
    BOOST_TEST(found.count(FeaturePair::vertex_face) == found.rows.size());
  }
}

BOOST_AUTO_TEST_CASE(beside_a_valley_the_plane_across_is_assumed_within_four_bands_where_that_is_asked_for) {
  const Mesh mesh = mesh_of({{0, -1, 0}, {0, 1, 0}, {1, 0, 0.5}, {-1, 0, 0.5}}, {{0, 2, 1}, {0, 1, 3}});  // z = |x| / 2
  const double half = 1e-4;
  const Box box(Vector::Constant(half));
  const Vector left = Vector(0.5, 0, 1).normalized();
  for (const double x : {3e-4, 3e-3}) {  // of its middle; its lowest edge on the right touches the slope there
    const auto pose = at(Vector(x, 0, (x + half) / 2 + half + in_touch));
    BOOST_TEST(!find(box, mesh, 1, pose).has_rows);
    const Found found = find(box, mesh, 1, pose, false, Vector::Zero(), true);
    BOOST_TEST_CONTEXT("x " << x << " distance " << found.distance) {
      BOOST_TEST((found.distance < 4 * band) == (x < 1e-3));
      BOOST_TEST(found.has_rows == (x < 1e-3));
      if (!found.has_rows) continue;
      BOOST_TEST_REQUIRE(found.rows.size() == 1);
      BOOST_TEST(found.rows[0].is_assumed);
      BOOST_TEST((found.rows[0].normal - left).norm() < 1e-12);
      BOOST_TEST(found.rows[0].gap == left.dot(pose.translation - half * Vector(1, 0, 1)), boost::test_tools::tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_vertex_beyond_a_shallow_valley_is_held_by_the_face_before_it_for_a_band_only) {
  const Mesh mesh = mesh_of({{0, -1, 0}, {0, 1, 0}, {1, 0, 0.1}, {-1, 0, 0}}, {{0, 2, 1}, {0, 1, 3}});
  for (const double beyond : {0.8 * band, 1.6 * band}) {
    const feeler::Segment<double> tool(Vector(-2 * band, 0, in_touch), Vector(beyond, 0, 0.1 * beyond + in_touch));
    const Found found = find(tool, mesh, 1, {});
    BOOST_TEST_CONTEXT("beyond by " << beyond) {
      BOOST_TEST(found.has_rows);
      int held = 0;
      for (const auto& row : found.rows) held += row.kind == FeaturePair::vertex_face && (row.arm - tool.vertex(1)).norm() < 1e-15;
      BOOST_TEST(held == (beyond < band ? 1 : 0));
    }
  }
}

BOOST_AUTO_TEST_CASE(of_shapes_that_overlap_no_row_holds_a_vertex_that_is_beside_the_triangle) {
  const Mesh mesh = floor();
  const Vector half(0.03, 0.02, 0.01);
  const Box box(half);
  // Astride the line between the two triangles, 20 µm deep beyond it and 10 µm on this side.
  const double tilt = 5e-6 / 0.03;
  const auto pose = at(Vector(0.5, 0.5, 0.01 - 1.5e-5), turn(-std::acos(-1.0) / 4, Vector::UnitZ()) * turn(tilt, Vector::UnitY()));
  for (const bool keep_ghost : {false, true}) {
    for (int triangle = 0; triangle < 2; ++triangle) {
      const Found found = find(box, mesh, triangle, pose, keep_ghost);
      BOOST_TEST(found.has_rows);
      BOOST_TEST(found.rows.size() == 2);
      for (const auto& row : found.rows) {
        const Vector point = pose.translation + row.arm;
        BOOST_TEST((point.x() > point.y()) == (triangle == 0));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_round_end_has_a_corner_in_its_face_however_many_facets_it_has) {
  // An edge of the triangle leaves the end across its rim, hardly lower than the corner: of the two only the corner is as close as the shapes.
  const double height = 0.04;
  for (const int facets : {8, 16, 17, 24, 64, 128}) {
    const auto tool = feeler::cylinder<double>(0.0264, 2 * height, facets);
    for (const double gap : {1e-6, 1e-7, 8e-9, 0.0}) {
      const Mesh mesh =
          mesh_of({{0.004, -0.001, -height - gap}, {-0.016, 0.032, -height - 1e-3}, {0.043, 0.002, -height - gap - 1.4e-7}}, {{0, 1, 2}});
      const Found found = find(tool, mesh, 0, {});
      BOOST_TEST_CONTEXT("facets " << facets << " gap " << gap) {
        BOOST_TEST(std::abs(found.distance - gap) < 1e-12);
        BOOST_TEST(found.count(FeaturePair::face_vertex) >= 1);
        const auto least = std::min_element(found.rows.begin(), found.rows.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
        BOOST_TEST_REQUIRE(least != found.rows.end());
        BOOST_TEST((least->kind == FeaturePair::face_vertex));
        BOOST_TEST(std::abs(least->gap - gap) < 1e-15);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_round_end_flat_on_a_triangle_stands_on_rows_all_around) {
  const Mesh mesh = mesh_of({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const double radius = 0.015, pi = std::acos(-1.0);
  for (const int facets : {12, 16, 17, 32, 100, 128}) {
    const auto tool = feeler::cylinder<double>(radius, 0.02, facets);
    for (const double tilt : {0.0, 1e-6, 1e-4}) {
      const Found found =
          find(tool, mesh, 0, at(Vector(0.01, -0.02, 0.01 + 1e-6 + radius * tilt), turn(tilt, Vector(std::cos(1.0), std::sin(1.0), 0))));
      BOOST_TEST_CONTEXT("facets " << facets << " tilt " << tilt) {
        BOOST_TEST(found.rows.size() >= std::min(facets, 12));
        BOOST_TEST(found.count(FeaturePair::vertex_face) == found.rows.size());
        std::vector<double> angles;
        double least = 1;
        for (const auto& row : found.rows) {
          angles.push_back(std::atan2(row.arm.y(), row.arm.x()));
          least = std::min(least, row.gap);
        }
        BOOST_TEST(std::abs(least - found.distance) < 1e-9);  // the lowest is among them
        std::sort(angles.begin(), angles.end());
        double widest = angles.front() + 2 * pi - angles.back();
        for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
        // All of 16, or no farther apart than a sixteenth of a turn and what a facet takes to each side.
        if (tilt <= 1e-6) BOOST_TEST(widest < 2 * pi / std::min(facets, 16) + (facets > 16 ? 2 * 2 * pi / facets : 1e-5));
        BOOST_TEST(angles.size() == std::size_t(std::unique(angles.begin(), angles.end()) - angles.begin()));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(edges_that_cross_give_one_row_along_their_common_normal) {
  // The box stands on an edge, across the ridge of the roof.
  const Mesh mesh = roof();
  const double h = 0.02;
  const Box box(Vector(0.05, h, h));
  for (const double gap : {1e-9, 1e-6, 1e-5}) {
    for (const double angle : {0.0, 0.2, -0.7}) {
      const double height = std::sqrt(2.0) * h + gap;
      const auto pose = at(Vector(0.001, 0.002, height), turn(angle, Vector::UnitZ()) * turn(std::acos(-1.0) / 4, Vector::UnitX()));
      for (int triangle = 0; triangle < 2; ++triangle) {
        const Found found = find(box, mesh, triangle, pose);
        BOOST_TEST(found.has_rows);
        BOOST_TEST_REQUIRE(found.rows.size() == 1);
        const auto& row = found.rows[0];
        BOOST_TEST((row.kind == FeaturePair::edge_edge));
        BOOST_TEST((row.normal - Vector::UnitZ()).norm() < 1e-9);
        BOOST_TEST(std::abs(row.gap - gap) < 1e-15);
        BOOST_TEST(std::abs(row.object_edge.y()) > 1 - 1e-12);
        BOOST_TEST(row.tool_edge.cross(Vector(std::cos(angle), std::sin(angle), 0)).norm() < 1e-12);
        // The point is on the tool's edge, above the ridge.
        const Vector point = pose.translation + row.arm;
        BOOST_TEST(std::abs(point.x()) < 1e-12);
        BOOST_TEST(std::abs(point.z() - gap) < 1e-15);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(room_of_edges_that_cross_is_what_is_left_to_the_nearest_end) {
  const Mesh mesh = roof();
  const double h = 0.02;
  const Box box(Vector(0.05, h, h));
  for (const double off : {0.01, -0.01}) {
    for (const double along : {0.0, 0.97, -0.97}) {  // the ridge ends at ±1
      const Found found = find(box, mesh, 0, at(Vector(off, along, std::sqrt(2.0) * h + in_touch), turn(std::acos(-1.0) / 4, Vector::UnitX())));
      BOOST_TEST_REQUIRE(found.rows.size() == 1);
      BOOST_TEST(found.rows[0].room == std::min(0.05 - std::abs(off), 1 - std::abs(along)), boost::test_tools::tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(parallel_edges_give_a_row_at_both_ends_of_the_interval_where_they_meet) {
  const Mesh mesh = roof();
  const double h = 0.02, gap = 1e-6;
  const Box box(Vector(0.05, h, h));
  // The box's long edge along the ridge, both of its ends on it.
  const auto upright = turn(std::acos(0.0), Vector::UnitZ()) * turn(std::acos(-1.0) / 4, Vector::UnitX());
  const Found found = find(box, mesh, 0, at(Vector(0, 0.3, std::sqrt(2.0) * h + gap), upright));
  BOOST_TEST(found.has_rows);
  BOOST_TEST_REQUIRE(found.rows.size() == 2);
  for (const auto& row : found.rows) {
    BOOST_TEST((row.normal - Vector::UnitZ()).norm() < 1e-9);
    BOOST_TEST(std::abs(row.gap - gap) < 1e-14);
    BOOST_TEST(std::abs(std::abs(row.arm.y()) - 0.05) < 1e-12);
  }
  BOOST_TEST(found.rows[0].arm.y() * found.rows[1].arm.y() < 0);
  // Half of it beyond the end of the ridge at y = 1.
  const Found end = find(box, mesh, 0, at(Vector(0, 1, std::sqrt(2.0) * h + gap), upright));
  BOOST_TEST_REQUIRE(end.rows.size() == 2);
  const double first = std::min(end.rows[0].arm.y(), end.rows[1].arm.y());
  const double last = std::max(end.rows[0].arm.y(), end.rows[1].arm.y());
  BOOST_TEST(std::abs(first + 0.05) < 1e-12);
  BOOST_TEST(std::abs(last) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_neighbour_in_the_same_plane_gives_no_row_that_holds_the_tool_sideways) {
  const Mesh mesh = floor();
  const Box box(Vector(0.03, 0.02, 0.01));
  constexpr unsigned seed = 2;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int ghosts = 0, kept = 0, ghosts_with_rows = 0;
  for (int i = 0; i < 2000; ++i) {
    // About the diagonal, a little above the floor: flat, on an edge or on a vertex.
    const double s = 0.5 * unit(bits), off = 0.06 * unit(bits);
    Eigen::Quaterniond q = turn(3 * unit(bits), Vector::UnitZ());
    if (i % 3 == 1) q = q * turn(0.3 * unit(bits), Vector::UnitX());
    if (i % 3 == 2) q = q * turn(0.3 * unit(bits), random_direction(bits));
    double low = 0;
    for (int v = 0; v < 8; ++v) low = std::min(low, (q * box.vertex(v)).z());
    const auto pose = at(Vector(s + off, s - off, magnitude(bits, -8, -5) - low), q);
    for (int triangle = 0; triangle < 2; ++triangle) {
      const Found found = find(box, mesh, triangle, pose);
      BOOST_TEST(found.has_rows == !found.rows.empty());
      for (const auto& row : found.rows)
        if (row.gap < 1e-4) BOOST_TEST((row.normal - Vector::UnitZ()).norm() < 1e-5);
      // A neighbour that is nearer is told of, whether or not the triangle has rows of other vertices.
      const double nearer_by = found.distance - find(box, mesh, 1 - triangle, pose).distance;
      if (nearer_by > 1e-9) BOOST_TEST(found.is_ghost);
      if (found.is_ghost) BOOST_TEST(nearer_by > 0);
      if (found.is_ghost) BOOST_TEST(found.nearer == 1 - triangle);
      ghosts_with_rows += found.is_ghost && found.has_rows ? 1 : 0;
      if (found.has_rows) continue;
      ++ghosts;
      const Found asked = find(box, mesh, triangle, pose, true);
      BOOST_TEST(asked.has_rows);
      BOOST_TEST(asked.rows.size() == 1);
      kept += asked.rows.empty() ? 0 : 1;
    }
  }
  BOOST_TEST(ghosts > 200);
  BOOST_TEST(kept == ghosts);
  BOOST_TEST(ghosts_with_rows > 5);
}

BOOST_AUTO_TEST_CASE(the_neighbour_of_a_ghost_that_the_patch_names_is_nearer) {
  const Box box(Vector(0.03, 0.02, 0.01));
  constexpr unsigned seed = 8;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int ghosts = 0;
  for (const Mesh& mesh : {spike(), roof(), floor()}) {
    for (int i = 0; i < 1000; ++i) {
      const auto pose = at(0.1 * random_vector(bits) + Vector(0, 0, 0.02), turn(3 * unit(bits), random_direction(bits)));
      for (int triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
        const Found found = find(box, mesh, triangle, pose);
        if (found.has_rows || found.distance <= 0) continue;
        ++ghosts;
        BOOST_REQUIRE(found.nearer >= 0);
        BOOST_TEST(find(box, mesh, found.nearer, pose).distance < found.distance);
      }
    }
  }
  BOOST_TEST(ghosts > 1000);
}

BOOST_AUTO_TEST_CASE(shapes_that_touch_have_a_row_as_close_as_they_are) {
  constexpr unsigned seed = 9;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int touching = 0;
  for (int i = 0; i < trials_to_run(20000); ++i) {
    const auto tool = random_hull(bits, 4 + below(bits, 30));
    const Eigen::Matrix3d corners = triangle_near(tool, bits, Shape::ordinary, magnitude(bits, -10, -8));
    const Found found = find(tool, mesh_of({corners.col(0), corners.col(1), corners.col(2)}, {{0, 1, 2}}), 0, {}, true);
    if (!(found.distance < 1e-8) || !(found.distance > 0)) continue;
    ++touching;
    double least = 1;
    for (const auto& row : found.rows) least = std::min(least, row.gap);
    BOOST_TEST(least <= 1.01 * found.distance + 3e-9);  // where two features hardly differ either will do
  }
  BOOST_TEST(touching > trials_to_run(1000));
}

BOOST_AUTO_TEST_CASE(the_rows_of_any_pair_are_separations_that_are_true_at_the_pose) {
  constexpr unsigned seed = 3;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 2000; ++i) {
    const auto tool = random_hull(bits, 4 + below(bits, 16));
    const double gap = magnitude(bits, -7, -4);
    const Shape shape = random_shape(bits);
    const Eigen::Matrix3d corners = triangle_near(tool, bits, shape, gap);
    const Mesh mesh = mesh_of({corners.col(0), corners.col(1), corners.col(2)}, {{0, 1, 2}});
    const bool keeps_ghost = i % 2 == 0;
    const Found found = find(tool, mesh, 0, {}, keeps_ghost);
    // All edges and corners of a triangle alone stick out, so none is a ghost; but which corner of a needle
    // is closest, rounding decides.
    const bool is_plain = shape == Shape::ordinary || shape == Shape::small || shape == Shape::large;
    BOOST_TEST_CONTEXT("pair " << i << " shape " << int(shape) << " gap " << gap) {
      BOOST_TEST(found.has_rows == !found.rows.empty());
      if (keeps_ghost || is_plain) BOOST_TEST(found.has_rows);
      if (found.rows.empty()) continue;
      double least = 1;
      for (const auto& row : found.rows) {
        BOOST_TEST(std::abs(row.normal.norm() - 1) < 1e-13);
        least = std::min(least, row.gap);
      }
      // The closest row is no farther than the closest points, nor nearer, but for the rounding of directions
      // at such a gap.
      const double size = 0.2 + corners.cwiseAbs().maxCoeff();
      const double rounding = 1e-9 + 1e-13 * size * size / gap;
      BOOST_TEST(least <= gap * 1.002 + rounding);
      BOOST_TEST(least >= gap * 0.999 - rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_contact_about_a_corner_does_not_outlast_a_slide_in_which_its_normal_turns_by_a_hundredth) {
  const Box box(Vector(0.03, 0.02, 0.01));
  const Mesh mesh = spike();
  const Eigen::Quaterniond on_its_corner = Eigen::Quaterniond::FromTwoVectors(Vector(-0.03, -0.02, -0.01), -Vector::UnitZ());
  for (const double gap : {1e-6, 1e-5}) {
    const double height = Vector(0.03, 0.02, 0.01).norm() + gap;
    const Found found = find(box, mesh, 0, at({0, 0, height}, on_its_corner));
    BOOST_TEST_REQUIRE(found.rows.size() == 1);
    const auto& row = found.rows[0];
    BOOST_TEST(std::abs(row.gap - gap) < 1e-15);
    const auto slide = [](double length) {
      feeler::Vector6<double> step = feeler::Vector6<double>::Zero();
      step[0] = length;
      return step;
    };
    BOOST_TEST(row.outlasts(slide(gap / 1000)));
    BOOST_TEST(!row.outlasts(slide(gap / 100)));
  }
}

BOOST_AUTO_TEST_CASE(a_triangle_under_a_face_whose_vertices_are_over_others_of_its_wall_only_fills_it) {
  const Box box(Vector(0.035, 0.02, 0.01));
  const Mesh mesh = strips(0.01);
  for (const double gap : {1e-6, 0.0}) {
    for (int triangle = 0; triangle < 20; ++triangle) {
      const Found found = find(box, mesh, triangle, at({0, 0, 0.01 + gap}));
      const bool has_vertices = triangle / 2 == 1 || triangle / 2 == 8, is_under = triangle / 2 > 1 && triangle / 2 < 8;
      BOOST_TEST_CONTEXT("triangle " << triangle << " gap " << gap) {
        if (is_under) BOOST_TEST(found.is_filler);
        if (has_vertices) BOOST_TEST(!found.is_filler);
        if (!is_under) continue;
        BOOST_TEST_REQUIRE(found.rows.size() == 1);
        BOOST_TEST((found.rows[0].kind == FeaturePair::vertex_face));  // of the triangle's plane, which does not turn with the tool
        BOOST_TEST((found.rows[0].normal - Vector::UnitZ()).norm() < 1e-9);
        BOOST_TEST(std::abs(found.rows[0].gap - gap) < 1e-12);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_triangle_with_rows_that_are_not_as_close_as_it_is_does_not_only_fill_its_wall) {
  // The left end of the box is lower by 60 nm, over the strip beside; the right end stands over this one.
  const Box box(Vector(0.06, 0.02, 0.01));
  const double tilt = 5e-7;
  const Found found = find(box, strips(0.1), 2 * 5 + 1, at({0, 0.5, 0.01 + 1e-6 + 0.06 * tilt}, turn(-tilt, Vector::UnitY())));
  BOOST_TEST(found.count(FeaturePair::vertex_face) >= 2);
  BOOST_TEST(!found.is_filler);
}

BOOST_AUTO_TEST_CASE(amid_a_wall_a_triangle_without_vertices_over_it_has_no_rows_and_holds_all_the_same) {
  // A floor of 20 × 20 squares of 1 cm, under a box of 7 × 5 cm.
  const Mesh mesh = floor({-0.1, 0.1, -0.1, 0.1, 20, 20});
  const Found found = find(Box(Vector(0.035, 0.025, 0.01)), mesh, 2 * (10 * 20 + 10), at({0, 0, 0.01 + in_touch}));
  BOOST_TEST(found.has_rows);
  BOOST_TEST(found.rows.size() == 0);
}

BOOST_AUTO_TEST_CASE(a_face_that_ends_over_the_rim_of_a_wall_names_the_triangles_there) {
  const Box box(Vector(0.03, 0.02, 0.01));
  const std::set<int> none, right{0}, both{0, 1};
  const auto rim = [&](double x, double y, double tilt = 0) {
    const double height = 0.02 * std::sin(tilt) + 0.01 * std::cos(tilt) + in_touch;
    return find(box, floor(), 0, at({x, y, height}, turn(tilt, Vector::UnitX()))).at_rim;
  };
  BOOST_TEST((rim(0.5, -0.5) == none));
  BOOST_TEST((rim(1, -0.5) == right));  // the rim at x = 1 is of the first triangle alone
  BOOST_TEST((rim(1, 1) == both));      // and that at y = 1 of the second
  BOOST_TEST((rim(1, -0.5, 0.3) == none));  // it stands on an edge
}

BOOST_AUTO_TEST_CASE(a_patch_finds_the_same_whatever_it_found_before) {
  const Box box(Vector(0.03, 0.02, 0.01));
  const Mesh mesh = floor();
  const feeler::FeatureIncidence incidence = feeler::incidence_of(box);
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  feeler::VertexSet near(8);
  ContactPatch<Box, double> used(box, incidence, mesh, axes, Vector::Zero(), band, false, near);
  // Beside the diagonal one triangle is a ghost, the other is not; high above they know of no vertices.
  for (const Vector& place : {Vector(0.3, -0.3, 0.01 + in_touch), Vector(0.3, -0.3, 0.011), Vector(-0.3, 0.3, 0.01 + in_touch)}) {
    for (const int triangle : {1, 0, 1}) {
      const Eigen::Matrix3d corners = mesh.corners(triangle).colwise() - place;
      const auto closest = feeler::separation(box, corners, {}, 1e-8);
      feeler::VertexSet others(8);
      ContactPatch<Box, double> fresh(box, incidence, mesh, axes, Vector::Zero(), band, false, others);
      PatchRows<double> rows, expected;
      BOOST_TEST(used.find(triangle, corners, closest, false, rows) == fresh.find(triangle, corners, closest, false, expected));
      BOOST_TEST(used.is_ghost() == fresh.is_ghost());
      BOOST_TEST(used.is_ghost() == ((triangle == 1) == (place.x() > 0)));
      BOOST_TEST(used.is_filler() == fresh.is_filler());
      BOOST_TEST_REQUIRE(rows.size() == expected.size());
      for (int i = 0; i < rows.size(); ++i) BOOST_TEST((rows[i].arm == expected[i].arm && rows[i].gap == expected[i].gap));
      BOOST_TEST(std::vector<int>(near.begin(), near.end()) == std::vector<int>(others.begin(), others.end()), boost::test_tools::per_element());
    }
  }
}

BOOST_AUTO_TEST_CASE(beyond_the_end_of_a_ridge_edges_are_assumed_to_cross_where_it_runs_into_the_object_and_nowhere_else) {
  // A roof along y with a gable at y = 1 that rises from the end of its ridge by a half, with or without what joins the two; at y = −1 there is nothing.
  const feeler::Points<double> vertices{{0, -1, 0}, {0, 1, 0}, {1, 0, -1}, {-1, 0, -1}, {1, 3, 1}, {-1, 3, 1}};
  const double beyond = 5e-6;
  const feeler::Segment<double> across(Vector(-0.05, 0, 0), Vector(0.05, 0, 0));
  for (const bool is_joined : {true, false}) {
    const Mesh mesh(vertices, is_joined ? feeler::Triangles{{0, 2, 1}, {0, 1, 3}, {1, 4, 5}, {1, 2, 4}, {1, 5, 3}}
                                        : feeler::Triangles{{0, 2, 1}, {0, 1, 3}, {1, 4, 5}});
    for (int triangle = 0; triangle < 2; ++triangle) {
      // How many are found, and how many of them are assumed.
      const auto edges_at = [&](double y, bool assumes) {
        const Found found = find(across, mesh, triangle, at({0, y, 4 * beyond}), true, Vector::Zero(), assumes);
        const auto is_assumed = [](const auto& row) { return row.kind == FeaturePair::edge_edge && row.is_assumed; };
        return std::pair(found.count(FeaturePair::edge_edge), int(std::count_if(found.rows.begin(), found.rows.end(), is_assumed)));
      };
      BOOST_TEST_CONTEXT("triangle " << triangle << (is_joined ? ", joined" : ", alone")) {
        for (const bool assumes : {true, false}) {
          const int past = assumes && is_joined ? 1 : 0;
          BOOST_TEST((edges_at(1 + beyond, assumes) == std::pair(past, past)));
          BOOST_TEST((edges_at(1 - beyond, assumes) == std::pair(1, 0)));
          BOOST_TEST((edges_at(-1 + beyond, assumes) == std::pair(1, 0)));
          BOOST_TEST((edges_at(-1 - beyond, assumes) == std::pair(0, 0)));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_vertex_beside_a_lone_face_by_less_than_a_seam_is_over_it) {
  const Mesh mesh = mesh_of({{0, -1, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const double seam = band / 100000;
  for (const double beside : {0.9 * seam, 1.1 * seam}) {
    const feeler::Segment<double> tool(Vector(-beside, 0, in_touch), Vector(0.01, 0, in_touch));
    int over = 0;
    for (const auto& row : find(tool, mesh, 0, {}).rows) over += row.kind == FeaturePair::vertex_face && row.arm == tool.vertex(0) ? 1 : 0;
    BOOST_TEST(over == (beside < seam ? 1 : 0));
  }
}

BOOST_AUTO_TEST_CASE(a_contact_without_a_gap_outlasts_a_slide_by_rounding) {
  const Box box(Vector(0.03, 0.02, 0.01));
  const Eigen::Quaterniond on_its_corner = Eigen::Quaterniond::FromTwoVectors(Vector(-0.03, -0.02, -0.01), -Vector::UnitZ());
  const Found found = find(box, floor(), 0, at({0.5, -0.5, Vector(0.03, 0.02, 0.01).norm()}, on_its_corner));
  const Found on_spike = find(box, spike(), 0, at({0, 0, Vector(0.03, 0.02, 0.01).norm()}, on_its_corner), true);
  BOOST_TEST(!found.rows.empty());
  BOOST_TEST(!on_spike.rows.empty());
  feeler::Vector6<double> slide = feeler::Vector6<double>::Zero();
  slide[0] = 1e-13;
  for (const auto& rows : {found.rows, on_spike.rows})
    for (const auto& row : rows) BOOST_TEST(row.outlasts(slide));
}

BOOST_AUTO_TEST_CASE(of_shapes_that_touch_the_vertices_in_the_band_alone_are_near) {
  const Box box(Vector(0.03, 0.02, 0.01));
  const Mesh mesh = floor();
  for (const double turned : {0.0, std::acos(-1.0)}) {  // upside down the first of its vertices is on top
    const Eigen::Matrix3d axes = turn(turned, Vector::UnitX()).toRotationMatrix();
    const Eigen::Matrix3d corners = axes.transpose() * (mesh.corners(0).colwise() - Vector(0.5, -0.5, 0.01));
    const auto closest = feeler::separation(box, corners, {}, 1e-8);
    BOOST_TEST_REQUIRE(closest.is_touching);
    const feeler::FeatureIncidence incidence = feeler::incidence_of(box);
    feeler::VertexSet near(8);
    ContactPatch<Box, double> patch(box, incidence, mesh, axes, Vector::Zero(), band, false, near);
    PatchRows<double> rows;
    BOOST_TEST(patch.find(0, corners, closest, false, rows));
    BOOST_TEST(near.size() == 4);
    for (const int vertex : near) BOOST_TEST((axes * box.vertex(vertex)).z() < 0);
  }
}

BOOST_AUTO_TEST_CASE(no_plane_is_assumed_that_the_tool_is_below) {
  // It has sunk into the slope on the right of a valley, below the plane of that on the left.
  const Mesh mesh = mesh_of({{0, -1, 0}, {0, 1, 0}, {1, 0, 0.5}, {-1, 0, 0.5}}, {{0, 2, 1}, {0, 1, 3}});  // z = |x| / 2
  const double half = 1e-4;
  const Box box(Vector::Constant(half));
  for (const double sunk : {3.5e-4, 3.9e-4}) {
    const Found found = find(box, mesh, 1, at({3e-4, 0, half - sunk}), false, Vector::Zero(), true);
    BOOST_TEST(found.is_ghost);
    for (const auto& row : found.rows) BOOST_TEST(!row.is_assumed);
  }
}

BOOST_AUTO_TEST_SUITE_END()
