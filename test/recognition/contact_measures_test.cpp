// Place, normal and gap of contacts that were made by hand, so that all of them are known beforehand.
#include "feeler/recognition/contact_measures.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "feeler/recognition/contact_recogniser.hpp"
#include "support/contact_scenes.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(contact_measures)

using namespace feeler_test;

using feeler::PrincipalContactType;
using feeler::SurfaceFeatures;
using Box = feeler::Box<double>;
using Contact = feeler::PrincipalContact<double>;
using Measures = feeler::ContactMeasures<Box, double>;
using Witness = feeler::ContactWitness<double>;

namespace {

constexpr double tolerance = 2e-6;

/// The contact of two features with one witness, in the axes of `WitnessSearch`.
Contact measured(const Soup& object, const Box& box, const Pose& pose, const Feature& tool, const Feature& on_object, const Witness& witness) {
  const auto mesh = object.mesh();
  const SurfaceFeatures<double> surface(mesh);
  feeler::WitnessSearch<Box, double> search(box, mesh, surface);
  feeler::ContactWitnesses<double> found, witnesses;
  search.find(pose, tolerance, found);
  witnesses.add(witness);
  feeler::ContactWitnesses<double>::Set all;
  all.set(0);
  const feeler::FeatureIncidence incidence = incidence_of(box);
  return Measures(surface, search, incidence, witnesses, tolerance).contact_of({tool, on_object, all});
}

/// The concave edge of a valley, or the concave vertex of a pit.
Feature concave_feature(const Soup& object, FeatureKind kind) {
  const SurfaceFeatures<double> surface(object.mesh());
  const int count = kind == FeatureKind::edge ? surface.edge_count() : surface.vertex_count();
  for (int i = 0; i < count; ++i)
    if (surface.convexity({kind, i}, feeler::SurfaceSide::front) == feeler::Convexity::concave) return {kind, i};
  return {};
}

/// The only contact that a tool has.
template <class Tool>
Contact recognised(const Soup& object, const Tool& tool, const Pose& pose) {
  const auto mesh = object.mesh();
  const SurfaceFeatures<double> surface(mesh);
  feeler::ContactRecogniser<Tool> recogniser(mesh, surface, tool, tolerance);
  const auto& formation = recogniser.recognise(pose);
  BOOST_TEST_REQUIRE(formation.size() == 1);
  return formation[0];
}

}  // namespace

BOOST_AUTO_TEST_CASE(of_a_tool_feature_too_large_for_a_valley_the_contact_is_of_its_edge_or_vertex_nearest_to_where_it_touches) {
  std::mt19937 bits(1);
  const Soup valley = roof(1e-3), pit = fan(4, 1e-3);
  const Feature edge_of_valley = concave_feature(valley, FeatureKind::edge), tip_of_pit = concave_feature(pit, FeatureKind::vertex);
  for (int round = 0; round < 200; ++round) {
    const Box box = random_box(bits);
    // A face looks down, and touches at the middle of one of its sides or at a corner.
    const int f = below(bits, 6), corner = below(bits, 4);
    const auto face = box.face(f);
    const int start = face.vertices[std::size_t(corner)], end = face.vertices[std::size_t((corner + 1) % 4)];
    int side = 0;
    while (std::minmax(box.edge(side).start, box.edge(side).end) != std::minmax(start, end)) ++side;
    const Eigen::Quaterniond down = feeler::scenes::rotation_between(face.normal, -Vector::UnitZ());
    const Pose pose{random_vector(bits), Eigen::Quaterniond(Eigen::AngleAxisd(3 * unit(bits), Vector::UnitZ())) * down};
    const auto at = [&](int vertex) { return Vector(pose.rotation * box.vertex(vertex)); };
    const auto nearest_to = [&](const Vector& place) { return Witness{{}, {}, place, place + 1e-4 * random_vector(bits)}; };

    const Contact in_valley = measured(valley, box, pose, {FeatureKind::face, f}, edge_of_valley, nearest_to((at(start) + at(end)) / 2));
    BOOST_TEST((in_valley.type == PrincipalContactType::edge_concave_edge));
    BOOST_TEST((in_valley.tool == Feature{FeatureKind::edge, side}));

    const Contact of_face = measured(pit, box, pose, {FeatureKind::face, f}, tip_of_pit, nearest_to(at(start)));
    BOOST_TEST((of_face.type == PrincipalContactType::vertex_concave_vertex));
    BOOST_TEST((of_face.tool == Feature{FeatureKind::vertex, start}));

    const Contact of_edge = measured(pit, box, pose, {FeatureKind::edge, side}, tip_of_pit, nearest_to(at(end)));
    BOOST_TEST((of_edge.type == PrincipalContactType::vertex_concave_vertex));
    BOOST_TEST((of_edge.tool == Feature{FeatureKind::vertex, end}));
  }
}

BOOST_AUTO_TEST_CASE(the_gap_of_a_face_in_a_valley_is_along_the_normal_of_the_face) {
  std::mt19937 bits(2);
  for (int round = 0; round < 100; ++round) {
    const Soup valley = roof(0.01 + fraction(bits));
    const Box box = random_box(bits);
    const double height = tolerance * unit(bits), half = box.half_extents().z();
    const Pose pose{{0, 0.5 * unit(bits), half + height}, Eigen::Quaterniond::Identity()};
    // The bottom of the box, over the edge of the valley, relative to the middle of the box.
    const Vector below_middle(0, 0, -half);
    const Contact contact = measured(valley, box, pose, {FeatureKind::face, 4}, concave_feature(valley, FeatureKind::edge),
                                     {{}, {}, below_middle, below_middle - height * Vector::UnitZ()});
    BOOST_TEST(std::abs(contact.gap - height) < 1e-15);
    BOOST_TEST((contact.normal_world - Vector::UnitZ()).norm() < 1e-15);
    BOOST_TEST((contact.point_world - Vector(0, pose.translation.y(), 0)).norm() < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(an_edge_that_crosses_the_rim_of_a_sheet_is_pushed_to_where_the_tool_is_also_where_it_overlaps) {
  // The tool is beyond the rim x = 1 of a floor, with an edge across it in the plane x = 1.
  std::mt19937 bits(3);
  const Eigen::Quaterniond aside(Eigen::AngleAxisd(std::acos(0.0), Vector::UnitY()));  // what looked down looks to −x
  for (int round = 0; round < 200; ++round) {
    const Box box = random_box(bits);
    const ToolFeature edge = tool_feature(box, {FeatureKind::edge, below(bits, 12)});
    const double gap = below(bits, 3) == 0 ? 0.0 : 1e-6 * unit(bits);
    const Pose over = set_down(edge, Vector::Zero(), gap, (below(bits, 2) == 0 ? 1 : -1) * (0.3 + 1.2 * fraction(bits)));
    const Pose pose{aside * over.translation + Vector(1, 0.5 * unit(bits), 0), aside * over.rotation};
    const Soup floor = below(bits, 2) == 0 ? floor_object() : floor_object().reversed();
    const Contact contact = recognised(floor, box, pose);
    BOOST_TEST((contact.type == PrincipalContactType::edge_convex_edge));
    BOOST_TEST((contact.normal_world - Vector::UnitX()).norm() < 1e-9);
    BOOST_TEST(std::abs(contact.gap - gap) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(where_closest_points_coincide_the_normal_of_a_corner_or_a_ridge_is_amid_those_of_its_faces) {
  // Vertices and edges on a tip, and vertices on a ridge, all of which point upwards; wherever they are, rounding parts the points a little.
  std::mt19937 bits(4);
  for (int round = 0; round < 200; ++round) {
    const Box box = random_box(bits);
    const bool is_edge = below(bits, 2) == 0, is_tip = is_edge || below(bits, 2) == 0;
    const Soup object = is_tip ? fan(3 + below(bits, 4), -0.2 - fraction(bits)) : roof(-0.2 - fraction(bits));
    const Feature feature = is_edge ? Feature{FeatureKind::edge, below(bits, 12)} : Feature{FeatureKind::vertex, below(bits, 8)};
    const Pose rest = set_down(tool_feature(box, feature), Vector::Zero(), 0, 3 * unit(bits));
    const Pose move{random_vector(bits), random_rotation(bits)};
    const Contact contact = recognised(object.moved(move, 1.0), box, {move * rest.translation, move.rotation * rest.rotation});
    BOOST_TEST((contact.type == (is_edge  ? PrincipalContactType::edge_convex_vertex
                                 : is_tip ? PrincipalContactType::vertex_convex_vertex
                                          : PrincipalContactType::vertex_convex_edge)));
    BOOST_TEST((contact.normal_world - move.rotation * Vector::UnitZ()).norm() < 1e-9);
    BOOST_TEST((contact.point_world - move.translation).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
