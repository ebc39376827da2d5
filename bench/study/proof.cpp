#include "study/proof.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <utility>

#include "fuzz/random_object.hpp"
#include "study/truth.hpp"
#include "support/penetration_checker.hpp"

namespace feeler::study {
namespace {

constexpr double kept = 1e-12;  // [m]

/// A scene, its truth, and what the checker needs, which shares no code with either.
struct Scenery {
  explicit Scenery(StudyScene made) : scene(std::move(made)), truth(scene), object(scene.vertices, scene.triangles) {
    for (const auto& points : scene.pieces) pieces.push_back(test::checked_tool(ConvexPolytope<double>::hull_of(points)));
  }
  StudyScene scene;
  Truth truth;
  test::CheckedObject object;
  std::vector<test::CheckedTool> pieces;
};

test::WideVector wide(const Vector3<Real>& v) { return v.unaryExpr([](const Real& x) { return static_cast<Wide>(x); }); }
Quaternion<Wide> wide(const Quaternion<Real>& q) { return {static_cast<Wide>(q.w()), static_cast<Wide>(q.x()), static_cast<Wide>(q.y()), static_cast<Wide>(q.z())}; }

/// Free poses about a minimum that are nearer to the hand. A step is tried at random, and again turned so that it lowers the energy.
std::pair<int, int> search_around(std::mt19937& bits, const Scenery& scenery, const Pose<double>& hand, const NearestPose& minimum) {
  const auto& [scene, truth, object, pieces] = scenery;
  int searched = 0, better = 0;
  // As much less as keeping no distance at all would gain.
  const Real energy = truth.energy(hand, minimum.pose) - 2 * kept * minimum.force.norm() / scene.stiffness().translational.maxCoeff();
  for (int i = 0; i < 40; ++i) {
    const double size = fuzz::magnitude(bits, -9, -4);
    Vector6<Real> step;
    step << (size * fuzz::random_vector(bits)).cast<Real>(), (size / truth.radius() * fuzz::random_vector(bits)).cast<Real>();
    for (const int sign : {1, -1}) {
      const Pose<Real> pose = Truth::moved(minimum.pose, Vector6<Real>(sign * step));
      if (!(truth.energy(hand, pose) < energy)) continue;
      ++searched;
      better += test::deepest_penetration(object, pieces, test::CheckedPose(wide(pose.translation), wide(pose.rotation))).depth <= 0;
    }
  }
  return {searched, better};
}

}  // namespace

ProofFigures prove_truth(int cells, unsigned seed, const std::string& only) {
  ProofFigures figures;
  figures.least_curvature = std::numeric_limits<double>::infinity();
  std::mt19937 bits(seed);
  auto names = scene_names();
  std::erase_if(names, [&](const std::string& name) { return only.empty() ? name.starts_with("terrain_1003") : name != only; });
  std::map<std::string, Scenery> made;
  for (int i = 0; i < cells; ++i) {
    const std::string name = names[std::size_t(fuzz::below(bits, int(names.size())))];
    if (!made.contains(name)) made.emplace(name, make_scene(name, 1, 0, seed));
    const Scenery& scenery = made.at(name);
    const auto& [scene, truth, object, pieces] = scenery;
    Cell cell{.scene = name, .budget = 1000000, .iterations = 32};
    const auto player = rendering("double").make(scene, cell);
    player->reset(scene.start);
    const double end = 0.4 + 3.6 * fuzz::fraction(bits);
    const int ticks = 40;  // the last hundredths of a second of the motion, and then the hand is held
    Reading reading;
    const Pose<double> hand = scene.motion(end);
    for (int k = 0; k <= ticks; ++k) reading = player->update(scene.motion(end * k / ticks));
    for (int k = 0; k < 400 && !(reading.status == TickStatus::converged && reading.is_at_rest); ++k) reading = player->update(hand);
    ++figures.asked;
    const auto minimum = truth.nearest(hand, reading.pose.cast<double>(), cell.margin, kept);
    if (!minimum) continue;
    ++figures.found;
    if (minimum->active.empty()) continue;
    ++figures.in_contact;
    figures.last_step = std::max(figures.last_step, static_cast<double>(minimum->last_step));
    figures.least_curvature = std::min(figures.least_curvature, minimum->curvature);
    const NearestPose tighter = truth.tightened(hand, *minimum, kept, 2);
    figures.tightened = std::max(figures.tightened, static_cast<double>(Real((minimum->pose.translation - tighter.pose.translation).norm() + 2 * truth.radius() * (minimum->pose.rotation.coeffs() - tighter.pose.rotation.coeffs()).norm())));
    const auto [searched, better] = search_around(bits, scenery, hand, *minimum);
    figures.searched += searched, figures.better += better;
  }
  return figures;
}

}  // namespace feeler::study
