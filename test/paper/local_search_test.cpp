#include "feeler/paper/local_search.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <set>

#include "feeler/tool/box.hpp"
#include "feeler/tool/segment.hpp"
#include "scenes/cavity.hpp"

BOOST_AUTO_TEST_SUITE(local_search)

using feeler::FeaturePair;
using feeler::LocalSearch;
using feeler::Pose;
using feeler::RegionCandidates;
using Vector = feeler::Vector3<double>;

namespace {

/// A roof: two slopes of 45° that meet in a ridge along y at z = 0, or a valley where `sign` is −1.
feeler::TriangleMesh<double> roof(double sign) {
  feeler::Points<double> vertices(6, 3);
  vertices << -0.1, -0.1, -0.1 * sign, 0, -0.1, 0, 0.1, -0.1, -0.1 * sign, -0.1, 0.1, -0.1 * sign, 0, 0.1, 0, 0.1, 0.1, -0.1 * sign;
  feeler::Triangles triangles(4, 3);
  triangles << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4;
  return {vertices, triangles};
}

int count(const RegionCandidates& region, FeaturePair kind) {
  int result = 0;
  for (const auto& candidate : region.candidates) result += candidate.constraints[0].kind == kind ? 1 : 0;
  return result;
}

/// The numbers of different planes in a candidate.
std::size_t planes(const feeler::TriangleMesh<double>& mesh, const feeler::Candidate& candidate) {
  std::set<std::array<long, 3>> normals;
  for (const auto& constraint : candidate.constraints) {
    const Vector n = mesh.normal(constraint.triangle);
    normals.insert({std::lround(1e6 * n.x()), std::lround(1e6 * n.y()), std::lround(1e6 * n.z())});
  }
  return normals.size();
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_line_over_a_ridge_may_rest_on_either_slope_or_on_the_edge) {
  const auto mesh = roof(1);
  const feeler::Segment<double> tool(Vector(-0.03, 0, 0), Vector(0.03, 0, 0));
  const Pose<double> pose{{0, 0.01, 1e-6}, Eigen::Quaterniond::Identity()};
  feeler::VertexSet near(tool.vertex_count());
  LocalSearch<feeler::Segment<double>, double> search(tool, mesh, pose, 1e-3, near);
  RegionCandidates region;
  search.find(feeler::vertex_on_triangle<double>(0, 1, mesh.normal(1)), region);
  BOOST_TEST(region.dropped == 0);
  BOOST_TEST(count(region, FeaturePair::vertex_face) == 2);
  BOOST_TEST(count(region, FeaturePair::edge_edge) >= 1);  // the ridge; rims in reach would count too
  for (const auto& candidate : region.candidates)
    if (candidate.constraints[0].kind == FeaturePair::vertex_face) BOOST_TEST(planes(mesh, candidate) == 1);
}

BOOST_AUTO_TEST_CASE(a_valley_is_one_piece_of_both_its_planes) {
  const auto mesh = roof(-1);
  const feeler::Segment<double> tool(Vector(0, 0, 0.001), Vector(0, 0, 0.03));
  feeler::VertexSet near(tool.vertex_count());
  LocalSearch<feeler::Segment<double>, double> search(tool, mesh, {{0, 0.01, 0}, Eigen::Quaterniond::Identity()}, 1e-3, near);
  RegionCandidates region;
  search.find(feeler::vertex_on_triangle<double>(0, 1, mesh.normal(1)), region);
  BOOST_TEST(count(region, FeaturePair::vertex_face) == 1);
  BOOST_TEST(planes(mesh, region.candidates[0]) == 2);
}

BOOST_AUTO_TEST_CASE(from_behind_a_valley_is_a_ridge) {
  const auto mesh = roof(-1);
  const feeler::Segment<double> tool(Vector(-0.03, 0, 0), Vector(0.03, 0, 0));
  feeler::VertexSet near(tool.vertex_count());
  LocalSearch<feeler::Segment<double>, double> search(tool, mesh, {{0, 0.01, -1e-6}, Eigen::Quaterniond::Identity()}, 1e-3, near);
  RegionCandidates region;
  search.find(feeler::vertex_on_triangle<double>(0, 1, Vector(-mesh.normal(1))), region);
  BOOST_TEST(count(region, FeaturePair::vertex_face) == 2);
  BOOST_TEST(count(region, FeaturePair::edge_edge) >= 1);
  for (const auto& constraint : region.candidates[0].constraints) BOOST_TEST(constraint.is_behind);
}

BOOST_AUTO_TEST_CASE(a_room_is_one_piece_of_all_walls_in_reach) {
  const auto scene = feeler::scenes::cavity(1e-3);
  const feeler::TriangleMesh<double> mesh(scene.vertices, scene.triangles);
  const feeler::Box<double> tool(Vector::Constant(0.01));
  feeler::VertexSet near(tool.vertex_count());
  LocalSearch<feeler::Box<double>, double> search(tool, mesh, {}, 1e-3, near);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    RegionCandidates region;
    search.find(feeler::vertex_on_triangle<double>(3, t, Vector(-mesh.normal(t))), region);  // from inside
    BOOST_TEST(region.dropped == 0);
    BOOST_TEST(region.candidates.size() == 1);
    BOOST_TEST(planes(mesh, region.candidates[0]) >= 5u);
  }
}

BOOST_AUTO_TEST_CASE(past_the_ridge_where_a_wall_ends_it_holds_nothing) {
  // Beside a block that stands on a floor: its wall x = 0 ends at y = 0.
  feeler::Points<double> vertices(9, 3);
  vertices << 0, 0, 0, 0, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, 0, 0, 0, 0, 1, 0, -1, 1, -1, 0, 1;
  feeler::Triangles triangles(8, 3);
  triangles << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 6, 1, 1, 6, 7, 0, 5, 6, 5, 8, 6;
  const feeler::TriangleMesh<double> mesh(vertices, triangles);
  const feeler::Segment<double> tool(Vector(0.02, -0.3, 0.1), Vector(0.02, 0.3, 0.1));
  feeler::VertexSet near(tool.vertex_count());
  LocalSearch<feeler::Segment<double>, double> search(tool, mesh, {}, 1e-3, near);
  RegionCandidates region;
  search.find(feeler::vertex_on_triangle<double>(0, 0, Vector::UnitZ()), region);
  BOOST_TEST_REQUIRE(region.candidates.size() >= 1);
  BOOST_TEST(planes(mesh, region.candidates[0]) == 2u);  // the floor and that wall
  std::set<int> on_floor, on_wall;
  for (const auto& constraint : region.candidates[0].constraints)
    (mesh.normal(constraint.triangle).z() > 0.5 ? on_floor : on_wall).insert(constraint.tool_feature);
  BOOST_TEST((on_floor == std::set<int>{0, 1}));
  BOOST_TEST((on_wall == std::set<int>{0}));
}

BOOST_AUTO_TEST_CASE(a_tip_is_one_candidate_for_each_face_over_it_however_many_triangles_meet_there) {
  feeler::Points<double> vertices(5, 3);
  vertices << 0, 0, 0, 0.1, 0, -0.1, 0, 0.1, -0.1, -0.1, 0, -0.1, 0, -0.1, -0.1;
  feeler::Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1;
  const feeler::TriangleMesh<double> mesh(vertices, triangles);
  const feeler::Box<double> tool(Vector::Constant(0.01));
  feeler::VertexSet near(tool.vertex_count());
  LocalSearch<feeler::Box<double>, double> search(tool, mesh, {{0, 0, 0.01 + 1e-6}, Eigen::Quaterniond::Identity()}, 1e-3, near);
  RegionCandidates region;
  search.find(feeler::vertex_on_triangle<double>(0, 0, mesh.normal(0)), region);
  BOOST_TEST(count(region, FeaturePair::face_vertex) == 1);
}

BOOST_AUTO_TEST_SUITE_END()
