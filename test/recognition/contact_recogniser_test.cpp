#include "feeler/recognition/contact_recogniser.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "feeler/core/result.hpp"
#include "support/allocation_count.hpp"
#include "support/contact_scenes.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(contact_recogniser)

using namespace feeler_test;

using feeler::ContactFormation;
using feeler::ContactRecogniser;
using feeler::PrincipalContactType;
using feeler::SurfaceFeatures;
using Box = feeler::Box<double>;
using Hull = feeler::ConvexPolytope<double>;
using Segment = feeler::Segment<double>;
using Formation = ContactFormation<double>;

namespace {

std::string text(const Formation& formation) {
  std::string result = std::to_string(formation.region_count) + " regions:";
  for (const auto& contact : formation)
    result += " [" + std::to_string(number_of(contact.type)) + " " + to_string(contact.tool.kind) + std::to_string(contact.tool.index) + "-" +
              to_string(contact.object.kind) + std::to_string(contact.object.index) + " r" + std::to_string(contact.region) + "]";
  return result;
}

template <class Tool>
Formation recognised(const Soup& soup, const Tool& tool, const Pose& pose, double tolerance = 2e-6) {
  const auto mesh = soup.mesh();
  const SurfaceFeatures<double> surface(mesh);
  ContactRecogniser<Tool> recogniser(mesh, surface, tool, tolerance);
  return recogniser.recognise(pose);
}

Box scaled(const Box& box, double scale) { return Box(scale * box.half_extents()); }
Segment scaled(const Segment& segment, double scale) { return Segment(scale * segment.vertex(0), scale * segment.vertex(1)); }
Hull scaled(const Hull& hull, double scale) {
  feeler::Points<double> points(hull.vertex_count(), 3);
  for (int i = 0; i < hull.vertex_count(); ++i) points.row(i) = scale * hull.vertex(i).transpose();
  return Hull::hull_of(points);
}

/// An object and a pose that touch in one contact of a type.
struct Example {
  int type = 0;
  Soup object;
  Pose pose;
  Feature tool;
  FeatureKind object_kind = FeatureKind::face;
};

/// @return nothing where the tool is too blunt to reach into any valley
template <class Tool>
std::optional<Example> example(const Tool& tool, int type, std::mt19937& bits) {
  const FeatureKind tool_kind = type == 1 || type == 3 || type == 4 || type == 8 || type == 9 ? FeatureKind::vertex
                                : type == 7 || type == 11 || type == 12                       ? FeatureKind::face
                                                                                              : FeatureKind::edge;
  const int count = tool_kind == FeatureKind::vertex ? tool.vertex_count() : tool_kind == FeatureKind::edge ? tool.edge_count() : tool.face_count();
  if (count == 0) return std::nullopt;
  Example result;
  result.type = type;
  result.tool = {tool_kind, below(bits, count)};
  const ToolFeature feature = tool_feature(tool, result.tool);
  const double rise = rise_of(tool, feature);
  if (rise < 1e-2) return std::nullopt;
  for (int i = 0; i < tool.vertex_count(); ++i) {  // nothing but the feature may come within tolerance
    const bool is_own = std::find(feature.vertices.begin(), feature.vertices.end(), i) != feature.vertices.end();
    if (!is_own && feature.outward.dot(Vector(tool.vertex(i)) - feature.point) > -1e-5) return std::nullopt;
  }
  const double slope = std::min(1.0, rise / 2);
  double angle = type == 2 ? 0.3 + 1.2 * fraction(bits) : 3 * unit(bits);
  Vector place = Vector::Zero();
  switch (type) {
    case 1:
    case 6:
    case 7:
      result.object = floor_object();
      place = {0.3 * unit(bits), 0.3 * unit(bits), 0};
      break;
    case 2:
    case 8:
    case 12:
      result.object = roof(-0.2 - fraction(bits));
      place.y() = 0.3 * unit(bits);
      break;
    case 3:
    case 5:
      result.object = roof(slope);
      place.y() = 0.3 * unit(bits);
      angle = 0;
      break;
    case 4: result.object = fan(3 + below(bits, 4), slope / 2.5); break;  // mid-way between corners it rises twice as much
    default: result.object = fan(3 + below(bits, 4), -0.2 - fraction(bits)); break;
  }
  result.object_kind = type == 1 || type == 6 || type == 7      ? FeatureKind::face
                       : type == 4 || (type >= 9 && type <= 11) ? FeatureKind::vertex
                                                                : FeatureKind::edge;
  result.pose = set_down(feature, place, below(bits, 3) == 0 ? 0.0 : 1.2e-6 * fraction(bits), angle);
  return result;
}

template <class Tool>
void check(const Formation& formation, const Example& example, const Tool&) {
  const std::string found = text(formation);
  BOOST_TEST_INFO_SCOPE("type " << example.type << " found as " << found);
  BOOST_TEST_REQUIRE(formation.size() == 1);
  BOOST_TEST(number_of(formation[0].type) == example.type);
  BOOST_TEST((formation[0].tool == example.tool));
  BOOST_TEST((formation[0].object.kind == example.object_kind));
  BOOST_TEST(formation.region_count == 1);
  BOOST_TEST(formation.is_complete());
}

/// The example as it is, and moved, scaled, shuffled and divided.
template <class Tool>
int check_all_types(std::mt19937& bits, const Tool& tool) {
  int checked = 0;
  for (int type = 1; type <= 12; ++type) {
    const auto found = example(tool, type, bits);
    if (!found) continue;
    ++checked;
    check(recognised(found->object, tool, found->pose), *found, tool);
    const Pose move{random_vector(bits), random_rotation(bits)};
    const double scale = std::pow(10.0, below(bits, 7) - 3);
    Soup object = found->object;
    for (int i = below(bits, 4); i > 0; --i) object = object.divided();
    object = object.moved({scale * move.translation, move.rotation}, scale).shuffled(bits);
    const Pose pose{scale * move.translation + move.rotation * (scale * found->pose.translation), move.rotation * found->pose.rotation};
    const auto formation = recognised(object, scaled(tool, scale), pose, 2e-6 * scale);
    if constexpr (std::is_same_v<Tool, Hull>) {  // may number its features anew
      BOOST_TEST_INFO_SCOPE("moved: " << text(formation));
      BOOST_TEST(same_types(formation, recognised(found->object, tool, found->pose)));
    } else {
      check(formation, *found, tool);
    }
    const auto& contact = formation[0];
    const Vector up = move.rotation * Vector::UnitZ();
    BOOST_TEST(contact.normal_world.norm() == 1.0, boost::test_tools::tolerance(1e-9));
    if (type != 8 && type != 9 && type != 10) BOOST_TEST(contact.normal_world.dot(up) > 0.7);
    BOOST_TEST(std::abs(contact.gap) <= 2e-6 * scale);
  }
  return checked;
}

}  // namespace

BOOST_AUTO_TEST_CASE(box_in_all_twelve_contacts) {
  std::mt19937 bits(1);
  for (int round = 0; round < 40; ++round) BOOST_TEST(check_all_types(bits, random_box(bits)) == 12);
}
BOOST_AUTO_TEST_CASE(segment_in_the_contacts_that_need_no_face) {
  std::mt19937 bits(2);
  for (int round = 0; round < 40; ++round) BOOST_TEST(check_all_types(bits, random_segment(bits)) == 9);
}
BOOST_AUTO_TEST_CASE(hull_in_all_twelve_contacts) {
  std::mt19937 bits(3);
  int checked = 0;
  for (int round = 0; round < 40; ++round) checked += check_all_types(bits, random_hull(bits, 4 + below(bits, 20)));
  BOOST_TEST(checked > 300);
}

BOOST_AUTO_TEST_CASE(tool_behind_an_open_sheet_sees_ridges_as_valleys) {
  std::mt19937 bits(4);
  for (int round = 0; round < 100; ++round) {
    const Box tool = random_box(bits);
    for (int type = 1; type <= 12; ++type) {
      const auto found = example(tool, type, bits);
      BOOST_TEST_REQUIRE(found.has_value());
      check(recognised(found->object.reversed(), tool, found->pose), *found, tool);
    }
  }
}

namespace {

/// A floor, z = 0, that meets a wall, x = 0, where x is positive, at some angle between them.
Soup floor_and_wall(double angle) {
  const double x = std::cos(angle), z = std::sin(angle);
  return {{{0, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0}, {x, -1, z}, {x, 1, z}}, {{0, 1, 2}, {0, 2, 3}, {4, 0, 3}, {4, 3, 5}}};
}
constexpr double right_angle = 1.57079632679489661923;

Formation with_box(const Soup& object, const Vector& half, const Pose& pose) { return recognised(object, Box(half), pose); }
int count(const Formation& formation, int type) { return formation.count(PrincipalContactType(type)); }

}  // namespace

BOOST_AUTO_TEST_CASE(box_on_a_floor_and_against_a_wall_has_two_face_contacts_in_one_region) {
  for (const double gap : {0.0, 1e-6}) {
    const Pose pose{{0.1 + gap, 0.2, 0.1 + gap}, Eigen::Quaterniond::Identity()};
    const auto formation = with_box(floor_and_wall(right_angle), {0.1, 0.1, 0.1}, pose);
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST(formation.size() == 2);
    BOOST_TEST(count(formation, 7) == 2);
    BOOST_TEST(formation.region_count == 1);
  }
}
BOOST_AUTO_TEST_CASE(box_on_a_floor_whose_edge_meets_a_leaning_wall_touches_both) {
  const Pose pose{{0.1, 0.2, 0.1}, Eigen::Quaterniond::Identity()};
  const auto formation = with_box(floor_and_wall(2.0), {0.1, 0.1, 0.1}, pose);
  BOOST_TEST_INFO_SCOPE(text(formation));
  BOOST_TEST(formation.size() == 2);
  BOOST_TEST(count(formation, 7) == 1);
  BOOST_TEST(count(formation, 6) == 1);
}
BOOST_AUTO_TEST_CASE(segment_on_a_floor_whose_end_meets_a_wall_touches_both) {
  const Segment tool({0, 0, 0}, {0.5, 0.1, 0});
  const auto formation = recognised(floor_and_wall(1.2), tool, {{0, 0, 0}, Eigen::Quaterniond::Identity()});
  BOOST_TEST_INFO_SCOPE(text(formation));
  BOOST_TEST(formation.size() == 2);
  BOOST_TEST(count(formation, 6) == 1);
  BOOST_TEST(count(formation, 1) == 1);
}
BOOST_AUTO_TEST_CASE(vertex_in_a_sharp_valley_touches_its_edge_alone) {
  // 1 µm from both walls it is 1/sin(angle/2) µm from the edge: beyond the tolerance.
  for (const double angle : {0.3, 0.5, 0.8, 1.2}) {
    const double distance = 1e-6 / std::sin(angle / 2);
    const Vector bisector(std::cos(angle / 2), 0, std::sin(angle / 2));
    const Segment tool(Vector::Zero(), 0.2 * bisector + Vector(0, 0.02, 0));
    const auto formation = recognised(floor_and_wall(angle), tool, {distance * bisector, Eigen::Quaterniond::Identity()});
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST(formation.size() == 1);
    BOOST_TEST(count(formation, 3) == 1);
    BOOST_TEST(formation[0].gap == 1e-6, boost::test_tools::tolerance(1e-6));
    if (distance < 2e-6) continue;  // the edge is within the tolerance
    const double middle = distance * std::cos(angle / 2) * std::cos(angle / 2);  // of the points nearest to it on the walls
    BOOST_TEST((formation[0].point_world - middle * bisector).norm() < 1e-12);
  }
}
BOOST_AUTO_TEST_CASE(vertex_in_a_slit_farther_than_ten_tolerances_from_its_edge_touches_both_walls) {
  for (const double angle : {0.11, 0.09}) {
    const Vector bisector(std::cos(angle / 2), 0, std::sin(angle / 2));
    const auto formation = recognised(floor_and_wall(angle), Segment(Vector::Zero(), 0.2 * bisector + Vector(0, 0.02, 0)),
                                      {1e-6 / std::sin(angle / 2) * bisector, Eigen::Quaterniond::Identity()});
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST(count(formation, 3) == (angle > 0.1 ? 1 : 0));
    BOOST_TEST(count(formation, 1) == (angle > 0.1 ? 0 : 2));
  }
}
BOOST_AUTO_TEST_CASE(vertex_that_touches_three_walls_of_a_pit_of_four_does_not_touch_its_corner) {
  // Walls at 60°, along whose rims the corners are; the vertex is 1.95 µm from two that face each other, 1 µm from the third, 2.9 µm from the last.
  const double steepness = std::sqrt(3.0);
  const Soup pit{{{0, 0, 0}, {1, 1, steepness}, {-1, 1, steepness}, {-1, -1, steepness}, {1, -1, steepness}},
                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  const Segment tool(Vector::Zero(), Vector(0.01, 0.02, 0.4));
  for (const double third : {1e-6, 1.95e-6}) {
    const Pose pose{{0, (1.95e-6 - third) / std::sqrt(0.75), 3.9e-6}, Eigen::Quaterniond::Identity()};
    const auto formation = recognised(pit, tool, pose);
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST(count(formation, 4) == 0);
    BOOST_TEST(formation.size() == 2);
  }
}
BOOST_AUTO_TEST_CASE(box_in_a_valley_flat_within_the_tolerance_lies_on_both_its_faces) {
  const auto formation = with_box(roof(2e-6), {0.2, 0.2, 0.1}, {{0, 0, 0.1 + 1e-6}, Eigen::Quaterniond::Identity()});
  BOOST_TEST_INFO_SCOPE(text(formation));
  BOOST_TEST(formation.size() == 2);
  BOOST_TEST(count(formation, 7) == 2);
}
BOOST_AUTO_TEST_CASE(edge_that_ends_on_a_face_two_tolerances_from_its_rim_lies_on_it_and_a_shorter_one_does_not) {
  for (const double inside : {3.5e-6, 5e-6}) {
    const auto formation = recognised(floor_object(), Segment({1 - inside, 0.1, 1e-6}, {1.2, 0.2, 1e-6}), Pose{});
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST(count(formation, 6) == (inside > 4e-6 ? 1 : 0));
    BOOST_TEST(formation.size() == (inside > 4e-6 ? 1 : 2));
  }
}
BOOST_AUTO_TEST_CASE(gap_of_edges_that_cross_is_negative_where_they_overlap) {
  for (const double gap : {1e-6, 0.0, -1e-6}) {
    const auto formation = recognised(roof(-1.0), Segment({-0.2, 0, 0}, {0.2, 0, 0}), {{0, 0, gap}, Eigen::Quaterniond::Identity()});
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST_REQUIRE(formation.size() == 1);
    BOOST_TEST(number_of(formation[0].type) == 2);
    BOOST_TEST(std::abs(formation[0].gap - gap) < 1e-15);
  }
}
BOOST_AUTO_TEST_CASE(vertex_at_the_margin_from_three_walls_touches_their_corner) {
  // A pit of three planes at right angles: at height 1 its corners are √2 away from the axis.
  Soup pit = fan(3, std::sqrt(0.5));
  for (const double gap : {0.0, 0.5e-6, 1e-6}) {
    const Segment tool(Vector::Zero(), Vector(0.01, 0.02, 0.4));
    const auto formation = recognised(pit, tool, {{0, 0, gap * std::sqrt(3.0)}, Eigen::Quaterniond::Identity()});
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST(formation.size() == 1);
    BOOST_TEST(count(formation, 4) == 1);
    BOOST_TEST(formation[0].gap == gap, boost::test_tools::tolerance(1e-6));
  }
}
BOOST_AUTO_TEST_CASE(segment_across_a_valley_touches_in_two_regions) {
  const Soup valley = roof(1.0);
  const Segment tool({-0.2, 0, 0.2}, {0.2, 0, 0.2});
  const auto formation = recognised(valley, tool, Pose{});
  BOOST_TEST_INFO_SCOPE(text(formation));
  BOOST_TEST(formation.size() == 2);
  BOOST_TEST(count(formation, 1) == 2);
  BOOST_TEST(formation.region_count == 2);
}
BOOST_AUTO_TEST_CASE(places_less_than_four_tolerances_apart_are_one_region) {
  for (const double half : {3.9e-6, 4.1e-6}) {
    const auto formation = recognised(roof(1.0), Segment({-half, 0, half}, {half, 0, half}), Pose{});
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST(count(formation, 1) == 2);
    BOOST_TEST(formation.region_count == (half < 4e-6 ? 1 : 2));
  }
}
BOOST_AUTO_TEST_CASE(segment_across_the_diagonal_of_a_floor_is_one_contact) {
  const Segment tool({-0.4, 0.3, 1e-6}, {0.4, -0.2, 1e-6});
  Soup object = floor_object();
  for (int i = 0; i < 5; ++i) {
    const auto formation = recognised(object, tool, Pose{});
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST(formation.size() == 1);
    BOOST_TEST(count(formation, 6) == 1);
    object = object.divided();
  }
}
BOOST_AUTO_TEST_CASE(cone_shaped_tool_in_a_square_hole_touches_its_rims_and_not_its_plane) {
  // A plate with a square hole of half width 0.1, a pyramid whose edges rest on the middles of the rims.
  Soup plate;
  for (const double r : {0.1, 0.5})
    for (int i = 0; i < 4; ++i) plate.vertices.push_back({i == 0 || i == 3 ? r : -r, i < 2 ? r : -r, 0.0});
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    plate.triangles.push_back({i, 4 + i, 4 + j});
    plate.triangles.push_back({i, 4 + j, j});
  }
  feeler::Points<double> points(5, 3);
  points << 0, 0, -0.2, 0.3, 0, 0.4, -0.3, 0, 0.4, 0, 0.3, 0.4, 0, -0.3, 0.4;
  const auto formation = recognised(plate, Hull::hull_of(points), Pose{});
  BOOST_TEST_INFO_SCOPE(text(formation));
  BOOST_TEST(formation.size() == 4);
  BOOST_TEST(count(formation, 2) == 4);
  BOOST_TEST(formation.region_count == 4);
}
BOOST_AUTO_TEST_CASE(regions_are_numbered_in_the_order_of_the_formation) {
  // One face of a box on plates that are not joined: each is a region, and no contact has the number of a later one.
  for (int plates = 1; plates < 20; plates += plates % 7 == 6 ? 2 : 1) {
    Soup comb;
    for (int i = 0; i < plates; ++i) {
      const int first = int(comb.vertices.size());
      const double x = 0.01 * ((7 * i) % plates);  // in another order than they stand in
      comb.vertices.insert(comb.vertices.end(), {{x, -0.1, 0}, {x + 0.005, -0.1, 0}, {x + 0.005, 0.1, 0}, {x, 0.1, 0}});
      comb.triangles.push_back({first, first + 1, first + 2});
      comb.triangles.push_back({first, first + 2, first + 3});
    }
    const auto formation = with_box(comb, {0.6, 0.2, 0.1}, {{0, 0, 0.1}, Eigen::Quaterniond::Identity()});
    BOOST_TEST_INFO_SCOPE(text(formation));
    BOOST_TEST(formation.region_count == plates);
    int next = 0;
    for (const auto& contact : formation) {
      BOOST_TEST(contact.region <= next);
      next = std::max(next, contact.region + 1);
    }
    BOOST_TEST(next == formation.region_count);
  }
}
BOOST_AUTO_TEST_CASE(no_two_contacts_are_of_the_same_features_where_tools_or_valleys_are_as_small_as_the_tolerance) {
  std::mt19937 bits(7);
  int several = 0;
  for (int round = 0; round < 1000; ++round) {
    const double slope = magnitude(bits, -6, 0), size = magnitude(bits, -6, -3);
    const Soup object = below(bits, 2) == 0 ? roof(slope) : fan(3 + below(bits, 4), slope);
    const Box box = scaled(random_box(bits), 10 * size);
    const FeatureKind kind = FeatureKind(below(bits, 3));
    const int number = below(bits, kind == FeatureKind::vertex ? 8 : kind == FeatureKind::edge ? 12 : 6);
    const Vector place = size * Vector(unit(bits), unit(bits), 0);
    const auto formation = recognised(object, box, set_down(tool_feature(box, {kind, number}), place, 2e-6 * unit(bits), 3 * unit(bits)));
    BOOST_TEST_INFO_SCOPE(text(formation));
    if (formation.size() > 1) ++several;
    for (int i = 1; i < formation.size(); ++i) BOOST_TEST(!formation[i].has_features_of(formation[i - 1]));  // they are sorted
  }
  BOOST_TEST(several > 100);
}
BOOST_AUTO_TEST_CASE(nothing_touches_beyond_the_tolerance_or_where_the_pose_is_not_finite) {
  const Box box({0.1, 0.1, 0.1});
  const auto mesh = floor_object().mesh();
  const SurfaceFeatures<double> surface(mesh);
  ContactRecogniser<Box> recogniser(mesh, surface, box);
  BOOST_TEST(recogniser.recognise({{0, 0, 0.1 + 1.99e-6}, Eigen::Quaterniond::Identity()}).size() == 1);
  BOOST_TEST(recogniser.recognise({{0, 0, 0.1 + 2.01e-6}, Eigen::Quaterniond::Identity()}).empty());
  BOOST_TEST(recogniser.recognise({{0, 0, 0.1}, Eigen::Quaterniond::Identity()}).size() == 1);
  BOOST_TEST(recogniser.recognise({{std::nan(""), 0, 0.1}, Eigen::Quaterniond::Identity()}).empty());
  BOOST_CHECK_THROW(ContactRecogniser<Box>(mesh, surface, box, 0.0), std::invalid_argument);
  BOOST_TEST(try_make<ContactRecogniser<Box>>(mesh, surface, box, 0.0).reason().find("not a positive length") != std::string::npos);
  BOOST_TEST(bool(try_make<ContactRecogniser<Box>>(mesh, surface, box)));
}
BOOST_AUTO_TEST_CASE(tools_and_objects_in_float_touch_as_in_double) {
  std::mt19937 bits(6);
  for (int round = 0; round < 40; ++round) {
    const Box tool = random_box(bits);
    for (int type = 1; type <= 12; ++type) {
      const auto found = example(tool, type, bits);
      if (!found) continue;
      const auto object = found->object.divided();
      feeler::Points<float> points(Eigen::Index(object.vertices.size()), 3);
      for (std::size_t i = 0; i < object.vertices.size(); ++i) points.row(Eigen::Index(i)) = object.vertices[i].cast<float>().transpose();
      feeler::Triangles rows(Eigen::Index(object.triangles.size()), 3);
      for (std::size_t i = 0; i < object.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) rows(Eigen::Index(i), k) = object.triangles[i][std::size_t(k)];
      const feeler::TriangleMesh<float> mesh(points, rows);
      const SurfaceFeatures<float> surface(mesh);
      ContactRecogniser recogniser(mesh, surface, tool.cast<float>());
      check(recogniser.recognise(found->pose.cast<float>()), *found, tool);
    }
  }
}
BOOST_AUTO_TEST_CASE(what_does_not_fit_is_counted) {
  // A comb of 100 separate plates, level to rounding, under one face of a box.
  Soup comb;
  for (int i = 0; i < 100; ++i) {
    const double x = -0.5 + 0.01 * i;
    const int first = int(comb.vertices.size());
    comb.vertices.insert(comb.vertices.end(), {{x, -0.1, 0}, {x + 0.005, -0.1, 0}, {x + 0.005, 0.1, 0}, {x, 0.1, 0}});
    comb.triangles.push_back({first, first + 1, first + 2});
    comb.triangles.push_back({first, first + 2, first + 3});
  }
  const auto formation = with_box(comb, {0.6, 0.2, 0.1}, {{0, 0, 0.1}, Eigen::Quaterniond::Identity()});
  BOOST_TEST(!formation.is_complete());
  BOOST_TEST(formation.dropped_witnesses == 400 - 128);
  BOOST_TEST(formation.size() > 0);
}
BOOST_AUTO_TEST_CASE(triangles_that_are_not_looked_at_are_counted_anew_at_each_pose) {
  Soup floor = floor_object(0.1);
  for (int i = 0; i < 6; ++i) floor = floor.divided();
  const auto mesh = floor.mesh();
  const SurfaceFeatures<double> surface(mesh);
  ContactRecogniser<Box> recogniser(mesh, surface, Box({0.2, 0.2, 0.1}));
  for (int round = 0; round < 2; ++round) {
    BOOST_TEST(recogniser.recognise({{0, 0, 0.1}, Eigen::Quaterniond::Identity()}).dropped_triangles == 2 * 4096 - 4096);
    BOOST_TEST(recogniser.recognise({{0, 0, 1}, Eigen::Quaterniond::Identity()}).is_complete());
  }
}
#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE(recognising_allocates_nothing) {
  BOOST_TEST_REQUIRE(count_works());
  std::mt19937 bits(5);
  for (int round = 0; round < 20; ++round) {
    const Hull tool = random_hull(bits, 12);
    for (int type = 1; type <= 12; ++type) {
      const auto found = example(tool, type, bits);
      if (!found) continue;
      const auto mesh = found->object.divided().mesh();
      const SurfaceFeatures<double> surface(mesh);
      ContactRecogniser<Hull> recogniser(mesh, surface, tool);
      feeler::FormationTracker<double> tracker;
      BOOST_TEST(allocations_during([&] { tracker.observe(recogniser.recognise(found->pose)); }) == 0);
      BOOST_TEST_INFO_SCOPE("type " << type << ": " << text(tracker.current()));
      BOOST_TEST(tracker.current().size() == 1);
    }
  }
}
#endif

BOOST_AUTO_TEST_SUITE_END()
