#include "feeler/paper/candidate_constraint.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "feeler/spatial/twist.hpp"
#include "feeler/tool/box.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(candidate_constraint)

using feeler::CandidateConstraint;
using feeler::FeaturePair;
using feeler::Pose;
using feeler::Vector6;
using Vector = feeler::Vector3<double>;
using namespace feeler_test;

namespace {

/// Two slopes of 45° that meet in a ridge along y at z = 0.
feeler::TriangleMesh<double> roof() {
  feeler::Points<double> vertices(6, 3);
  vertices << -0.1, -0.1, -0.1, 0, -0.1, 0, 0.1, -0.1, -0.1, -0.1, 0.1, -0.1, 0, 0.1, 0, 0.1, 0.1, -0.1;
  feeler::Triangles triangles(4, 3);
  triangles << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4;
  return {vertices, triangles};
}

}  // namespace

BOOST_AUTO_TEST_CASE(gaps_and_rooms_are_those_of_a_box_over_a_roof) {
  const auto mesh = roof();
  const Vector half(0.02, 0.03, 0.01);
  const feeler::Box<double> tool(half);
  const double height = 0.004;
  const Pose<double> pose{{0.005, 0.01, half.z() + height}, Eigen::Quaterniond::Identity()};
  constexpr double endless = std::numeric_limits<double>::infinity();

  for (int vertex = 0; vertex < 8; ++vertex) {
    const auto row = row_of(CandidateConstraint{FeaturePair::vertex_face, vertex, 2, 0, false}, tool, mesh, pose, pose.translation);
    const Vector point = pose * tool.vertex(vertex);
    BOOST_TEST(std::abs(row.gap - (point.x() + point.z()) / std::sqrt(2)) < 1e-15);
    BOOST_TEST((row.arm - tool.vertex(vertex)).norm() < 1e-15);
    BOOST_TEST(row.room == endless);
  }
  for (int f = 0; f < tool.face_count(); ++f) {
    if (tool.face(f).normal.z() > -0.5) continue;  // the bottom over the end of the ridge, which is far beside it
    const auto row = row_of(CandidateConstraint{FeaturePair::face_vertex, f, 2, 0, false}, tool, mesh, pose, pose.translation);
    BOOST_TEST(std::abs(row.gap - height) < 1e-15);
    BOOST_TEST((row.normal - Vector::UnitZ()).norm() < 1e-15);
    BOOST_TEST(std::abs(row.room - (-0.1 - (0.01 - half.y()))) < 1e-15);
  }
  int edges = 0;
  for (int e = 0; e < tool.edge_count(); ++e) {
    const Vector start = tool.vertex(tool.edge(e).start), end = tool.vertex(tool.edge(e).end);
    if (start.z() > 0 || end.z() > 0 || start.y() != end.y()) continue;  // those of the bottom across the ridge
    const auto row = row_of(CandidateConstraint{FeaturePair::edge_edge, e, 3, 2, false}, tool, mesh, pose, pose.translation);
    BOOST_TEST(std::abs(row.gap - height) < 1e-15);
    BOOST_TEST((row.normal - Vector::UnitZ()).norm() < 1e-15);
    BOOST_TEST((row.arm - Vector(-0.005, start.y(), -half.z())).norm() < 1e-15);
    BOOST_TEST(std::abs(row.room - (half.x() - 0.005)) < 1e-15);
    ++edges;
  }
  BOOST_TEST(edges == 2);
}

BOOST_AUTO_TEST_CASE(room_of_edges_ends_at_either_end_of_each) {
  const auto mesh = roof();
  const Vector half(0.02, 0.03, 0.01);
  const feeler::Box<double> tool(half);
  for (const double beside : {0.0, 0.015, -0.015}) {
    for (const double along : {0.0, 0.06, -0.06}) {
      const Pose<double> pose{{beside, along, half.z()}, Eigen::Quaterniond::Identity()};
      for (int e = 0; e < tool.edge_count(); ++e) {
        const Vector start = tool.vertex(tool.edge(e).start), end = tool.vertex(tool.edge(e).end);
        if (start.z() > 0 || end.z() > 0 || start.y() != end.y()) continue;
        const auto row = row_of(CandidateConstraint{FeaturePair::edge_edge, e, 3, 2, false}, tool, mesh, pose, pose.translation);
        BOOST_TEST(std::abs(row.room - std::min(half.x() - std::abs(beside), 0.1 - std::abs(along + start.y()))) < 1e-15);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(out_of_a_ridge_is_between_its_slopes_and_out_of_a_rim_is_over_it_on_the_side_of_the_tool) {
  const auto mesh = roof();
  for (const double side : {1.0, -1.0}) {
    const Vector ridge = feeler::detail::out_of_ridge<double>(mesh, 3, 2, side), rim = feeler::detail::out_of_ridge<double>(mesh, 0, 0, side);
    BOOST_TEST((ridge.normalized() - side * Vector::UnitZ()).norm() < 1e-15);
    BOOST_TEST((rim - side * mesh.normal(0) + Vector::UnitY()).norm() < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(rows_are_the_derivatives_of_their_gaps) {
  constexpr unsigned seed = 4;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const auto mesh = roof();
  const feeler::Box<double> tool(Vector(0.01, 0.02, 0.03));
  int checked = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pose<double> pose{0.05 * random_vector(bits), random_rotation(bits)};
    const auto kind = FeaturePair(below(bits, 3));
    const int features = kind == FeaturePair::vertex_face ? 8 : kind == FeaturePair::face_vertex ? 6 : 12;
    const CandidateConstraint constraint{kind, below(bits, features), below(bits, 4), below(bits, 3), below(bits, 2) == 0};
    const auto row = row_of(constraint, tool, mesh, pose, pose.translation);
    if (kind == FeaturePair::edge_edge) {
      const double sine = row.object_edge.cross(row.tool_edge).norm();
      // Near parallel, and where the way out lies along the faces, the plane turns fast or flips.
      const Vector out = feeler::detail::out_of_ridge<double>(mesh, constraint.triangle, constraint.corner, constraint.is_behind ? -1 : 1);
      if (sine < 0.2 || std::abs(row.normal.dot(out)) < 0.1) continue;
    }
    ++checked;
    for (int k = 0; k < 6; ++k) {
      const auto gap = [&](double h) {
        const Pose<double> moved = feeler::moved(pose, feeler::Twist<double>::from_vector(h * Vector6<double>::Unit(k)));
        return row_of(constraint, tool, mesh, moved, moved.translation).gap;
      };
      BOOST_TEST(std::abs((gap(1e-6) - gap(-1e-6)) / 2e-6 - row.gradient()[k]) < 1e-7);
    }
  }
  BOOST_TEST(checked > 2000);
}

BOOST_AUTO_TEST_SUITE_END()
