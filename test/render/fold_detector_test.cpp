// Folds told by `FoldDetector`: a drop over an edge is one fold of its own height, and what is continuous is none.
#include "feeler/render/fold_detector.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "scenes/cavity.hpp"
#include "scenes/plate.hpp"
#include "scenes/steps.hpp"
#include "support/refusal.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(folds)

using namespace feeler;
using namespace feeler::test;

namespace {

/// A tool led along a path of device poses; the folds that were told.
template <class Tool, class Motion>
std::vector<Fold<double>> folds_of(const TriangleMesh<double>& object, const Tool& tool, const Settings<double>& settings, const Motion& motion,
                                   int ticks, double least = 1e-4) {
  HapticRenderer renderer(object, tool, settings);
  BOOST_TEST((renderer.reset(motion(0)) == Status::converged));
  FoldDetector<double> detector(settings, least);
  detector.reset(motion(0), renderer.tick().graphic_pose);
  std::vector<Fold<double>> folds;
  for (int i = 1; i <= ticks; ++i) {
    const Pose<double> device = motion(i);
    if (const auto* fold = detector.observe(device, renderer.update(device))) folds.push_back(*fold);
  }
  return folds;
}

/// The edge of a table: its top at z = 0 for x < 0, and its side at x = 0 below.
TriangleMesh<double> table_edge() {
  scenes::Setting scene;
  scenes::add_plates(scene, {{{-0.05, 0, 0}, {0.05, 0, 0}, {0, 0.05, 0}}, {{0, 0, -0.05}, {0, 0.05, 0}, {0, 0, 0.05}}});
  return {scene.vertices, scene.triangles};
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_jump_that_is_no_length_is_refused) {
  for (const double jump : {-1e-9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const std::string sentence = feeler_test::refusal([&] { FoldDetector<double>(Settings<double>(), jump); });
    BOOST_TEST(sentence.find("not a length") != std::string::npos);
    BOOST_TEST(try_make<FoldDetector<double>>(Settings<double>(), jump).reason() == sentence);
  }
  BOOST_TEST(bool(try_make<FoldDetector<double>>(Settings<double>())));
}

BOOST_AUTO_TEST_CASE(a_drop_over_an_edge_is_one_fold_as_high_as_the_device_was_deep) {
  const TriangleMesh<double> table = table_edge();
  for (const double depth : {0.0008, 0.003, 0.009}) {
    for (const int budget : {400, 20}) {
      BOOST_TEST_CONTEXT("depth " << depth << ", work budget " << budget) {
        Settings<double> settings;
        settings.work_budget = budget;
        const double step = 2e-5;
        // Down into the table, and along under its top over the edge.
        const int down = int((depth + 0.001) / step);
        const auto motion = [&](int i) {
          return Pose<double>{.translation = {-0.005 + step * std::max(i - down, 0), 0.001, 0.001 - step * std::min(i, down)}};
        };
        const auto folds = folds_of(table, Point<double>(), settings, motion, down + 500);
        BOOST_TEST_REQUIRE(folds.size() == 1U);
        BOOST_TEST(std::abs(folds[0].jump - depth) < 0.1 * depth);
        BOOST_TEST(std::abs(folds[0].from.translation.z()) < 3 * settings.margin);
        BOOST_TEST(std::abs(folds[0].to.translation.z() + depth) < 2 * step);
        BOOST_TEST(folds[0].ticks >= 1);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(sliding_turning_and_being_late_are_no_folds) {
  const auto scene = scenes::cavity(1e-3);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  const auto& cube = std::get<Box<double>>(scene.tool);
  const auto hand = [&](int i) { return scene.motion(i * 1e-3); };
  BOOST_TEST(folds_of(object, cube, scene.settings(), hand, ticks_to_run(3000)).empty());
  // Leaps of the device, after which the tool is late for some ticks.
  const TriangleMesh<double> table = table_edge();
  const auto leaps = [](int i) { return Pose<double>{.translation = {-0.03 + 0.01 * (i / 20 % 2), 0.001, i < 5 ? 0.001 : -0.002}}; };
  BOOST_TEST(folds_of(table, Point<double>(), Settings<double>{}, leaps, 200).empty());
}

BOOST_AUTO_TEST_CASE(a_fold_stays_one_however_often_the_device_is_read) {
  if (!runs_all_ticks) return;
  const auto scene = scenes::steps();
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  std::visit(
      [&](const auto& tool) {
        std::vector<std::size_t> counts;
        std::vector<double> sums;
        for (const int rate : {1000, 2000, 4000}) {
          const auto folds = folds_of(object, tool, scene.settings(), [&](int i) { return scene.motion(double(i) / rate); }, 4 * rate, 5e-3);
          double sum = 0;
          for (const auto& fold : folds) sum += fold.jump;
          BOOST_TEST_MESSAGE(rate << " Hz: " << folds.size() << " folds of " << sum << " m together");
          counts.push_back(folds.size());
          sums.push_back(sum);
        }
        BOOST_TEST(counts[0] > 0U);
        BOOST_TEST(counts[1] == counts[2]);
        BOOST_TEST(std::abs(sums[1] - sums[2]) < 0.05 * sums[2]);
      },
      scene.tool);
}

BOOST_AUTO_TEST_SUITE_END()
