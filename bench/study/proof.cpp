#include "study/proof.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "fuzz/random_object.hpp"
#include "study/checked_pieces.hpp"
#include "study/truth.hpp"

namespace feeler::study {
namespace {

constexpr double kept = 1e-12;  // [m]

/// A scene, its truth, and what the checker needs, which shares no code with either.
struct Scenery {
  explicit Scenery(StudyScene made) : scene(std::move(made)), truth(scene), object(scene.vertices, scene.triangles), pieces(checked_pieces(scene)) {}
  double depth(const Pose<Real>& pose) const { return double(test::deepest_penetration(object, pieces, test::checked_pose(wide(pose))).depth); }

  StudyScene scene;
  Truth truth;
  test::CheckedObject object;
  std::vector<test::CheckedTool> pieces;
};

/// Free poses about a minimum that are nearer to the hand. A step is tried at random, and again turned so that it lowers the energy.
std::pair<int, int> search_around(std::mt19937& bits, const Scenery& scenery, const Pose<double>& hand, const NearestPose& minimum) {
  const auto& truth = scenery.truth;
  int searched = 0, better = 0;
  // As much less as keeping no distance at all would gain.
  const Real energy = truth.energy(hand, minimum.pose) - 2 * kept * minimum.force.norm() / scenery.scene.stiffness().translational.maxCoeff();
  for (int i = 0; i < 40; ++i) {
    const double size = fuzz::magnitude(bits, -9, -4);
    Vector6<Real> step;
    step << (size * fuzz::random_vector(bits)).cast<Real>(), (size / truth.gaps().radius() * fuzz::random_vector(bits)).cast<Real>();
    for (const int sign : {1, -1}) {
      const Pose<Real> pose = Truth::moved(minimum.pose, Vector6<Real>(sign * step));
      if (!(truth.energy(hand, pose) < energy)) continue;
      ++searched;
      better += scenery.depth(pose) <= 0;
    }
  }
  return {searched, better};
}

/// Of a cube of half side a that a hand has turned by θ₀ about its edge and holds at a height h: it stands on that edge at z = a (cos θ + sin θ) + kept, at the θ
/// that minimises ½ (z − h)² + ½ w (θ − θ₀)². By bisection of the derivative.
std::pair<Real, Real> on_an_edge(const Real& a, const Real& weight, const Real& angle, const Real& height) {
  const auto slope = [&](const Real& t) { return Real((a * (cos(t) + sin(t)) + kept - height) * a * (cos(t) - sin(t)) + weight * (t - angle)); };
  Real low = 0, high = angle;
  for (int i = 0; i < 200; ++i) {
    const Real middle = (low + high) / 2;
    (slope(middle) < 0 ? low : high) = middle;
  }
  return {a * (cos(low) + sin(low)) + kept, low};
}

/// The truth of scenes with a closed form, anywhere in space.
void compare_with_formulas(std::mt19937& bits, ProofFigures& figures) {
  constexpr double half = 0.005;
  const Box<double> cube(Vector3<double>::Constant(half));
  for (int i = 0; i < 30; ++i) {
    const int kind = i % 3;
    StudyScene scene;
    scene.length = 0.002 + 0.008 * fuzz::fraction(bits);
    scene.pieces = {Points<double>(8, 3)};
    for (int k = 0; k < 8; ++k) scene.pieces[0].row(k) = cube.vertex(k).transpose();
    const int walls = kind == 2 ? 3 : 1;  // a plate, or a corner of three
    const double reach = 0.05;
    scene.vertices.resize(4 * walls, 3);
    scene.triangles.resize(2 * walls, 3);
    const Vector3<double> shift = fuzz::random_vector(bits);
    for (int wall = 0; wall < walls; ++wall) {
      const Eigen::Index first = 4 * wall;
      for (int k = 0; k < 4; ++k) {
        Vector3<double> corner = Vector3<double>::Zero();
        corner[wall] = (k == 1 || k == 2) ? reach : -reach;
        corner[(wall + 1) % 3] = k >= 2 ? reach : -reach;  // its normal is the third axis
        scene.vertices.row(first + k) = (corner + shift).transpose();
      }
      scene.triangles.row(2 * wall) << int(first), int(first) + 1, int(first) + 2;
      scene.triangles.row(2 * wall + 1) << int(first), int(first) + 2, int(first) + 3;
    }
    const Truth truth(scene);
    const double angle = kind == 1 ? 0.1 + 0.6 * fuzz::fraction(bits) : 0;
    Pose<double> hand{shift + Vector3<double>(0.002 * fuzz::unit(bits), 0.002 * fuzz::unit(bits), -0.003 * fuzz::fraction(bits)),
                      exp_rotation<double>({angle, 0, 0})};
    if (kind == 2) hand.translation = shift - 0.003 * Vector3<double>(fuzz::fraction(bits), fuzz::fraction(bits), fuzz::fraction(bits));
    Vector3<Real> place = hand.translation.cast<Real>();
    Real turn = 0;
    // Walls lie where `double` has rounded the shift.
    const auto above = [&](int axis) { return Real(Real(shift[axis]) + half + kept); };
    if (kind == 0) place.z() = above(2);
    if (kind == 2)
      for (int axis = 0; axis < 3; ++axis) place[axis] = above(axis);
    if (kind == 1) {
      const auto [height, found] =
          on_an_edge(half, Real(scene.stiffness().rotational.x()) / scene.stiffness().translational.x(),
                     atan2(Real(hand.rotation.x()), Real(hand.rotation.w())) * 2, Real(hand.translation.z()) - Real(shift.z()));
      place.z() = Real(shift.z()) + height;
      turn = found;
    }
    // From above the minimum by the margin of a renderer, and somewhat off it.
    Pose<double> near{place.unaryExpr([](const Real& x) { return static_cast<double>(x); }) + Vector3<double>::Constant(kind == 2 ? 1e-6 : 0) +
                          Vector3<double>(0, 0, kind == 2 ? 0 : 1e-6),
                      exp_rotation<double>({static_cast<double>(turn), 0, 0})};
    const auto minimum = truth.nearest(hand, near, 1e-6, kept);
    ++figures.formulas;
    const Vector3<Real> way = minimum ? Vector3<Real>(minimum->pose.translation - place) : Vector3<Real>(Vector3<Real>::Constant(1));
    const Real turned = minimum ? Real(atan2(minimum->pose.rotation.x(), minimum->pose.rotation.w()) * 2 - turn) : Real(1);
    figures.off_formulas = std::max(figures.off_formulas, static_cast<double>(Real(way.norm() + half * abs(turned))));
  }
}

}  // namespace

ProofFigures prove_truth(int cells, unsigned seed, const std::vector<std::string>& only) {
  ProofFigures figures;
  figures.least_curvature = std::numeric_limits<double>::infinity();
  std::mt19937 bits(seed);
  compare_with_formulas(bits, figures);
  auto names = scene_names();
  std::erase_if(names, [&](const std::string& name) { return name.starts_with("terrain_1003"); });  // too large to be searched so often
  for (const std::string& name : only) make_scene({.scene = name}, seed);
  if (!only.empty()) names = only;
  std::map<std::string, Scenery> made;
  for (int i = 0; i < cells; ++i) {
    const std::string name = names[std::size_t(fuzz::below(bits, int(names.size())))];
    if (!made.contains(name)) made.emplace(name, make_scene({.scene = name}, seed));
    const Scenery& scenery = made.at(name);
    const StudyScene& scene = scenery.scene;
    const Truth& truth = scenery.truth;
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
    figures.deep += scenery.depth(minimum->pose) > 0;
    const NearestPose tighter = truth.tightened(hand, *minimum, kept, 2);
    figures.tightened =
        std::max(figures.tightened,
                 static_cast<double>(Real((minimum->pose.translation - tighter.pose.translation).norm() +
                                          2 * truth.gaps().radius() * (minimum->pose.rotation.coeffs() - tighter.pose.rotation.coeffs()).norm())));
    const auto [searched, better] = search_around(bits, scenery, hand, *minimum);
    figures.searched += searched, figures.better += better;
  }
  return figures;
}

}  // namespace feeler::study
