// How far a tool of several pieces may go down on chips of different heights, one under each piece: by subtraction.
#include "feeler/render/motion_certificate.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "feeler/tool/compound_tool.hpp"
#include "feeler/tool/convex_polytope.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(motion_certificate)

using namespace feeler_test;

using Hull = feeler::ConvexPolytope<double>;
using Compound = feeler::CompoundTool<Hull>;
using Pairs = feeler::WorkingSet<double>;
using Vector = Eigen::Vector3d;

namespace {

constexpr double pitch = 0.01;  // of the pieces [m]
constexpr int unlimited = std::numeric_limits<int>::max();

/// Cubes in a row along x, in some order; piece i is at place `places[i]`, and its bottom at z = 0.
struct Row {
  std::vector<int> places;
  std::vector<double> depths;  ///< of the chip under each piece, below it [m]
  feeler::TriangleMesh<double> object;
  feeler::RenderedScene<Compound> scene;

  Row(std::mt19937& bits, const std::vector<double>& depths_of_chips)
      : places(shuffled(bits, int(depths_of_chips.size()))), depths(depths_of_chips), object(chips()), scene(object, tool(), {}) {}

  static std::vector<int> shuffled(std::mt19937& bits, int count) {
    std::vector<int> numbers;
    for (int i = 0; i < count; ++i) numbers.insert(numbers.begin() + below(bits, i + 1), i);
    return numbers;
  }
  /// Triangle i is under piece i.
  feeler::TriangleMesh<double> chips() const {
    const auto count = Eigen::Index(places.size());
    feeler::Points<double> vertices(3 * count, 3);
    feeler::Triangles triangles(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
      const double x = pitch * places[std::size_t(i)], z = -depths[std::size_t(i)];
      vertices.row(3 * i) << x + 0.003, 0.003, z;
      vertices.row(3 * i + 1) << x + 0.005, 0.003, z;
      vertices.row(3 * i + 2) << x + 0.003, 0.005, z;
      triangles.row(i) << int(3 * i), int(3 * i + 1), int(3 * i + 2);
    }
    return {vertices, triangles};
  }
  Compound tool() const {
    std::vector<Hull> pieces;
    for (const int place : places) {
      feeler::Points<double> corners(8, 3);
      for (int c = 0; c < 8; ++c) corners.row(c) << pitch * place + 0.008 * (c & 1), 0.008 * (c >> 1 & 1), 0.008 * (c >> 2);
      pieces.push_back(Hull::hull_of(corners));
    }
    return Compound(pieces);
  }
};

feeler::Twist<double> down_by(double way) { return {{0, 0, -way}, Vector::Zero()}; }

std::vector<double> random_depths(std::mt19937& bits, double least, double most) {
  std::vector<double> depths(std::size_t(2 + below(bits, 8)));
  for (double& depth : depths) depth = least + (most - least) * fraction(bits);
  return depths;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_motion_is_free_up_to_the_piece_that_is_stopped_first_and_its_chip_blocks_it) {
  std::mt19937 bits(1);
  for (int round = 0; round < 60; ++round) {
    const std::vector<double> depths = random_depths(bits, 1e-5, 1e-3);
    const Row row(bits, depths);
    const double way = 2e-3, least = *std::min_element(depths.begin(), depths.end());
    const int first = int(std::min_element(depths.begin(), depths.end()) - depths.begin());
    feeler::MotionCertificate<Compound> certificate(row.scene);
    int work = 0;
    const auto result = certificate.certify(row.scene, {}, down_by(way), work, unlimited);
    BOOST_TEST(!result.is_exhausted);
    BOOST_TEST(result.time * way < least);
    BOOST_TEST(result.time * way > least - 2 * row.scene.margin());
    bool names_first = false;
    for (const auto& blocker : result.blockers) {
      BOOST_TEST(blocker.piece == blocker.triangle);
      BOOST_TEST(blocker.time * way < depths[std::size_t(blocker.triangle)]);
      names_first = names_first || blocker.triangle == first;
    }
    BOOST_TEST(names_first);
    BOOST_TEST(certificate.certify(row.scene, {}, down_by(least / 2), work, unlimited).is_whole());
  }
}

BOOST_AUTO_TEST_CASE(a_certificate_whose_work_ran_out_certifies_nothing_and_when_it_is_done_no_more_than_is_free) {
  std::mt19937 bits(2);
  int most_calls = 0;
  for (int round = 0; round < 30; ++round) {
    const std::vector<double> depths = random_depths(bits, 1e-5, 1e-3);
    const Row row(bits, depths);
    feeler::MotionCertificate<Compound> certificate(row.scene);
    const Pairs none;
    const double way = 2e-3;
    int work = 0, calls = 1;
    auto result = certificate.certify(row.scene, {}, down_by(way), work, 1, none);
    for (; result.is_exhausted && calls < 1000; ++calls) {
      BOOST_TEST(result.time == 0.0);
      BOOST_TEST(!result.is_whole());
      for (const auto& blocker : result.blockers) BOOST_TEST(blocker.piece == blocker.triangle);
      result = certificate.go_on(row.scene, work, work + 1, none);
    }
    BOOST_TEST(!result.is_exhausted);
    BOOST_TEST(!result.blockers.empty());
    BOOST_TEST(result.time * way < *std::min_element(depths.begin(), depths.end()));
    most_calls = std::max(most_calls, calls);
  }
  BOOST_TEST(most_calls > 5);
}

BOOST_AUTO_TEST_CASE(what_is_nearer_than_the_margin_where_a_motion_ends_is_noticed_with_the_piece_that_it_is_near) {
  std::mt19937 bits(3);
  for (int round = 0; round < 60; ++round) {
    // The motion ends a part of the margin above some chips, and far above the others.
    std::vector<double> depths = random_depths(bits, 1.2e-7, 9e-7);
    for (double& depth : depths)
      if (below(bits, 2) == 0) depth = 1e-5;
    const Row row(bits, depths);
    feeler::MotionCertificate<Compound> certificate(row.scene);
    const Pairs none;
    int work = 0;
    const double height = 1e-4;
    const feeler::Pose<double> start{{0, 0, height}, Eigen::Quaterniond::Identity()};
    const auto result = certificate.certify(row.scene, start, down_by(height), work, unlimited, none);
    BOOST_TEST(result.is_whole());
    const auto noticed = certificate.notice(row.scene, {}, row.scene.noticed(), work, unlimited, none, std::numeric_limits<double>::infinity());
    BOOST_TEST(!noticed.is_exhausted);
    std::vector<int> found;
    for (const auto& near : noticed) {
      BOOST_TEST(near.piece == near.triangle);
      found.push_back(near.triangle);
    }
    std::sort(found.begin(), found.end());
    std::vector<int> expected;
    for (std::size_t i = 0; i < depths.size(); ++i)
      if (depths[i] < row.scene.noticed()) expected.push_back(int(i));
    BOOST_TEST(found == expected, boost::test_tools::per_element());
  }
}

BOOST_AUTO_TEST_SUITE_END()
