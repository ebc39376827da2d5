// A corner of the object at a face of the tool: in the frame of a box whether it is over the face is two comparisons.
#include "feeler/recognition/witness_search.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "support/contact_scenes.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(witness_search)

using namespace feeler_test;

using feeler::SurfaceFeatures;
using Box = feeler::Box<double>;

BOOST_AUTO_TEST_CASE(a_corner_touches_a_face_of_a_box_that_it_is_over_and_within_tolerance_of_and_no_face_whose_plane_it_only_is_near) {
  constexpr double tolerance = 2e-6;
  std::mt19937 bits(1);
  int over = 0, beside = 0;
  for (int round = 0; round < 100; ++round) {
    const Soup tip = fan(3 + below(bits, 4), -0.2 - fraction(bits));
    const Box box = random_box(bits);
    for (int f = 0; f < box.face_count(); ++f) {
      const Vector normal = box.face(f).normal, half = box.half_extents();
      const double height = 1.5 * tolerance * unit(bits);  // outside of the face
      if (std::abs(std::abs(height) - tolerance) < 1e-9) continue;
      Vector corner = 1.5 * half.cwiseProduct(random_vector(bits));
      corner = corner.cwiseProduct(Vector(Vector::Ones() - normal.cwiseAbs())) + (half.dot(normal.cwiseAbs()) + height) * normal;
      const Vector share = (corner.cwiseAbs() - half).cwiseProduct(Vector(Vector::Ones() - normal.cwiseAbs()));
      if ((share.cwiseAbs().array() < 1e-4).count() > 1) continue;  // the share along the normal is zero; near a rim it is an edge that touches
      const bool is_over = share.maxCoeff() <= 0 && std::abs(height) <= tolerance;
      ++(is_over ? over : beside);
      // The face looks down on the tip, with an edge anywhere.
      const Eigen::Quaterniond down = feeler::scenes::rotation_between(normal, -Vector::UnitZ());
      const Eigen::Quaterniond rotation = Eigen::Quaterniond(Eigen::AngleAxisd(3 * unit(bits), Vector::UnitZ())) * down;
      const Pose move{random_vector(bits), random_rotation(bits)};
      const auto mesh = tip.moved(move, 1.0).shuffled(bits).mesh();
      const SurfaceFeatures<double> surface(mesh);
      feeler::WitnessSearch<Box, double> search(box, mesh, surface);
      feeler::ContactWitnesses<double> witnesses;
      search.find({move * Vector(-(rotation * corner)), move.rotation * rotation}, tolerance, witnesses);
      BOOST_TEST(witnesses.size() == (is_over ? 1 : 0), "round " << round << ", face " << f);
      if (!is_over || witnesses.size() != 1) continue;
      BOOST_TEST((witnesses[0].tool == Feature{FeatureKind::face, f}));
      BOOST_TEST((witnesses[0].object.kind == FeatureKind::vertex));
      BOOST_TEST((witnesses[0].on_tool - witnesses[0].on_object).norm() == std::abs(height), boost::test_tools::tolerance(1e-6));
    }
  }
  BOOST_TEST(over > 50);
  BOOST_TEST(beside > 50);
}

BOOST_AUTO_TEST_SUITE_END()
