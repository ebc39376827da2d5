#include "feeler/contact/contact_row.hpp"

#include <boost/test/unit_test.hpp>

#include <functional>
#include <random>

#include "feeler/spatial/twist.hpp"
#include "support/finite_differences.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(contact_row)

using feeler::ContactRow;
using feeler::FeaturePair;
using namespace feeler_test;

namespace {

using Real = WideNumber;
using Wide = WidePoint;
using Wide6 = WideStep;
using Separation = std::function<Real(const Wide6&)>;

struct Contact {
  ContactRow<double> row;
  Separation separation;  // of the step, from the definition of the pair
};

Contact vertex_face(std::mt19937& bits) {
  ContactRow<double> row;
  row.kind = FeaturePair::vertex_face;
  row.normal = random_direction(bits);
  row.arm = random_vector(bits);
  row.gap = 1e-3 * unit(bits);
  const Wide n = row.normal.cast<Real>(), vertex = row.arm.cast<Real>(), on_plane = vertex - Real(row.gap) * n;
  return {row, [=](const Wide6& d) { return n.dot(Wide(d.head<3>()) + turned(d.tail<3>(), vertex) - on_plane); }};
}

Contact face_vertex(std::mt19937& bits) {
  ContactRow<double> row;
  row.kind = FeaturePair::face_vertex;
  row.normal = random_direction(bits);  // from the object to the tool: into the tool's face
  row.arm = random_vector(bits);        // the object's vertex
  row.gap = 1e-3 * unit(bits);
  const Wide n = row.normal.cast<Real>(), vertex = row.arm.cast<Real>(), on_face = vertex + Real(row.gap) * n;
  return {row, [=](const Wide6& d) { return turned(d.tail<3>(), n).dot(Wide(d.head<3>()) + turned(d.tail<3>(), on_face) - vertex); }};
}

/// @param gap  the row's curvature is that at contact: it leaves out a term of gap / sine²
Contact edge_edge(std::mt19937& bits, double gap) {
  ContactRow<double> row;
  row.kind = FeaturePair::edge_edge;
  row.object_edge = random_direction(bits);
  do {
    row.tool_edge = random_direction(bits);
  } while (row.tool_edge.cross(row.object_edge).norm() < 0.2);
  row.normal = row.tool_edge.cross(row.object_edge).normalized() * (below(bits, 2) == 0 ? 1 : -1);
  row.arm = random_vector(bits);
  row.gap = gap;
  const Wide u = row.object_edge.cast<Real>(), v = row.tool_edge.cast<Real>(), on_tool = row.arm.cast<Real>();
  const Wide n = v.cross(u).normalized() * (row.normal.dot(row.tool_edge.cross(row.object_edge)) > 0 ? 1 : -1);
  const Wide on_object = on_tool - Real(gap) * n;
  return {row, [=](const Wide6& d) {
            Wide normal = turned(d.tail<3>(), v).cross(u).normalized();
            if (normal.dot(n) < 0) normal = -normal;
            return normal.dot(Wide(d.head<3>()) + turned(d.tail<3>(), on_tool) - on_object);
          }};
}

void check_gradient(const Contact& contact, Real tolerance, Real rounding = 1e-15L) {
  BOOST_TEST(std::abs(contact.separation(Wide6::Zero()) - Real(contact.row.gap)) < rounding);
  const Wide6 slopes = gradient_by_differences(contact.separation);
  const auto gradient = contact.row.gradient();
  for (int i = 0; i < 6; ++i) BOOST_TEST(std::abs(slopes[i] - Real(gradient[i])) < tolerance);
}

Real curvature_error(const Contact& contact) { return largest_difference(curvature_by_differences(contact.separation), curvature_of(contact.row)); }

}  // namespace

BOOST_AUTO_TEST_CASE(gradient_and_curvature_of_a_vertex_on_a_face_are_derivatives_of_its_height) {
  constexpr unsigned seed = 1;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 300; ++i) {
    const Contact contact = vertex_face(bits);
    check_gradient(contact, 1e-9L);
    BOOST_TEST(curvature_error(contact) < 1e-7L);
  }
}

BOOST_AUTO_TEST_CASE(gradient_and_curvature_of_a_face_on_a_vertex_are_derivatives_of_its_depth_in_the_face) {
  constexpr unsigned seed = 2;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 300; ++i) {
    const Contact contact = face_vertex(bits);
    check_gradient(contact, 1e-9L);
    BOOST_TEST(curvature_error(contact) < 1e-7L);
  }
}

BOOST_AUTO_TEST_CASE(gradient_and_curvature_of_crossing_edges_are_derivatives_of_the_distance_of_their_lines) {
  constexpr unsigned seed = 3;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 300; ++i) {
    const Contact contact = edge_edge(bits, 0);
    check_gradient(contact, 1e-8L);
    BOOST_TEST(curvature_error(contact) < 1e-6L);
    // Off contact the normal's own curvature is left out: at most gap · |δn|², |δn| ≤ |w| / sine.
    const double gap = 1e-3 * unit(bits);
    const Contact apart = edge_edge(bits, gap);
    check_gradient(apart, 1e-8L);
    const Real sine = Real(apart.row.tool_edge.cross(apart.row.object_edge).norm());
    BOOST_TEST(curvature_error(apart) < 1e-6L + 2 * std::abs(Real(gap)) / (sine * sine));
  }
}

BOOST_AUTO_TEST_CASE(a_carried_row_is_the_row_where_a_motion_ends) {
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 300; ++i)
    for (const Contact& contact : {vertex_face(bits), face_vertex(bits), edge_edge(bits, 1e-3 * unit(bits))}) {
      const feeler::Twist<double> motion{0.1 * random_vector(bits), 0.1 * random_vector(bits)};
      const Wide6 step = motion.vector().cast<Real>();
      const ContactRow<double> carried = contact.row.carried(motion);
      check_gradient({carried, [&](const Wide6& d) { return contact.separation(composed(step, d)); }}, 1e-8L, 2e-15L);
    }
}

BOOST_AUTO_TEST_CASE(rows_repeat_each_other_where_gap_and_gradient_are_the_same_but_for_rounding) {
  std::mt19937 bits(6);
  for (int i = 0; i < 100; ++i) {
    const ContactRow<double> row = vertex_face(bits).row;
    const auto repeats = [&row](double gap, const feeler::Vector3<double>& arm, const feeler::Vector3<double>& tilt) {
      ContactRow<double> other = row;
      other.kind = FeaturePair::edge_edge;
      other.triangle = 7;
      other.gap += gap;
      other.arm += arm;
      other.normal += tilt;
      return row.repeats(other) && other.repeats(row);
    };
    const feeler::Vector3<double> across = row.normal.unitOrthogonal(), none = feeler::Vector3<double>::Zero();
    BOOST_TEST(repeats(0, none, none));
    BOOST_TEST(repeats(1e-14 * row.arm.norm(), 1e-14 * row.arm.norm() * across, 1e-14 * across));
    BOOST_TEST(repeats(0, 0.3 * row.normal, none));  // the same lever
    BOOST_TEST(!repeats(1e-11, none, none));
    BOOST_TEST(!repeats(0, 1e-11 * across, none));
    BOOST_TEST(!repeats(0, none, 1e-11 * across));
    ContactRow<double> assumed = row;
    assumed.is_assumed = true;
    BOOST_TEST(!assumed.repeats(row));
  }
}

BOOST_AUTO_TEST_CASE(a_contact_outlasts_a_slide_of_a_quarter_of_its_room_whether_the_tool_is_moved_or_turned) {
  ContactRow<double> row;
  row.arm = {0.1, 0, 0};
  row.room = 1e-3;
  const auto outlasts = [&row](int axis, double length) { return row.outlasts(length * feeler::Vector6<double>::Unit(axis)); };
  for (const int axis : {0, 1}) {
    BOOST_TEST(outlasts(axis, 2.49e-4));
    BOOST_TEST(!outlasts(axis, 2.51e-4));
  }
  BOOST_TEST(outlasts(2, 1));  // along its normal
  BOOST_TEST(outlasts(3, 1));  // about its arm
  BOOST_TEST(outlasts(5, 2.49e-3));
  BOOST_TEST(!outlasts(5, 2.51e-3));
}

BOOST_AUTO_TEST_CASE(a_contact_outlasts_a_turn_about_it_however_far_the_reference_point_moves) {
  ContactRow<double> row;
  row.arm = {0.1, 0, 0};
  row.room = 1e-4;
  feeler::Vector6<double> about_it;
  about_it << 0, -1e-3, 0, 0, 0, 1e-2;
  BOOST_TEST(row.outlasts(about_it));
  feeler::Vector6<double> farther = about_it;
  farther[1] = 1e-3;
  BOOST_TEST(!row.outlasts(farther));
}

BOOST_AUTO_TEST_CASE(curvature_is_symmetric) {
  std::mt19937 bits(4);
  for (int i = 0; i < 100; ++i)
    for (const Contact& contact : {vertex_face(bits), face_vertex(bits), edge_edge(bits, 1e-6)}) {
      const auto curvature = curvature_of(contact.row);
      BOOST_TEST((curvature - curvature.transpose()).norm() < 1e-13);
    }
}

BOOST_AUTO_TEST_SUITE_END()
