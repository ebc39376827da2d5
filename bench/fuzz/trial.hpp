// One renderer, made and driven at random, and watched by the checker.
#pragma once

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "feeler/feeler.hpp"
#include "fuzz/random_hand.hpp"
#include "fuzz/random_object.hpp"
#include "scenes/renderers.hpp"
#include "scenes/round_renderers.hpp"
#include "support/penetration_checker.hpp"
#include "support/rendering.hpp"

namespace feeler::fuzz {

/// What a trial found.
struct Finding {
  int ticks = 0;             ///< that were run
  double deepest = 0;        ///< penetration at the ends of ticks and on their ways [m]
  std::string problem = {};  ///< the first, with its tick; empty if there is none
};

/// Settings in the ranges that their documentation gives, many of them unwise.
inline Settings<double> random_settings(std::mt19937& bits, bool is_about_centre) {
  Settings<double> settings;
  settings.closed_means_solid = false;  // rooms face either way
  const auto one_in = [&](int count) { return below(bits, count) == 0; };
  if (one_in(2)) settings.margin = magnitude(bits, -8, -4);
  if (one_in(3)) settings.work_budget = int(magnitude(bits, 0, 5));
  if (one_in(3)) settings.trust_radius = magnitude(bits, -5, -2);
  if (one_in(5)) settings.maximum_iterations = 1 + below(bits, 40);
  if (one_in(3) && !is_about_centre) settings.reference_point = magnitude(bits, -3, -0.5) * random_direction(bits);
  const auto weights = [&](double low, double high) {
    return Vector(magnitude(bits, low, high), magnitude(bits, low, high), magnitude(bits, low, high));
  };
  if (one_in(5)) settings.stiffness = Stiffness<double>::uniform(1000, magnitude(bits, -4, 2));
  if (one_in(5)) settings.stiffness = {weights(2, 4), weights(-2, 1)};
  if (one_in(5)) settings.metric = Metric<double>{weights(-1, 1), weights(-5, -2)};
  return settings;
}

/// @tparam Tool  a tool of `double`
template <class Tool>
class Trial {
 public:
  /// @param bits  decides everything; the tool is made of them before
  Trial(std::mt19937& bits, const Tool& tool)
      : bits_(bits), tool_(tool), object_(bits), settings_(random_settings(bits, symmetry_of<Tool> == Symmetry::about_point)) {
    if (below(bits, 5) < 2) placed_.rotation = random_rotation(bits);
    if (below(bits, 7) == 0) placed_.translation = magnitude(bits, -1, 3) * random_direction(bits);
    object_.place(placed_.rotation, placed_.translation);
    pieces_ = test::checked_pieces(tool_);
    checked_.emplace(object_.vertices(), object_.triangles());
    allowed_ = 1e-13 + 4e-13 * placed_.translation.norm();  // rounding: of solutions and of coordinates
  }

  const char* object() const { return object_.name; }

  Finding run(int ticks) {
    const TriangleMesh<double> mesh(object_.vertices(), object_.triangles());
    HapticRenderer renderer(mesh, tool_, settings_);
    Pose<double> start{object_.start, Quaternion<double>::Identity()};
    Status status = renderer.reset(start);
    check_reset(start, status);
    for (int i = 0; i < 60 && status != Status::converged; ++i) {
      start = {object_.start + (i < 30 ? 0.02 : 0.2) * fraction(bits_) * random_direction(bits_), random_rotation(bits_)};
      status = renderer.reset(start);
      check_reset(start, status);
    }
    if (status != Status::converged) return finding_;  // the tool is too large to be anywhere
    RandomHand hand(bits_, object_, placed_, start);
    while (finding_.ticks < ticks && finding_.problem.empty()) {
      const Pose<double> before = renderer.tick().graphic_pose;
      const Pose<double> haptic = hand.next();
      check_tick(before, haptic, renderer.update(haptic));
      ++finding_.ticks;
    }
    return finding_;
  }

 private:
  void complain(const std::string& what) {
    if (finding_.problem.empty()) finding_.problem = what + " (tick " + std::to_string(finding_.ticks) + ", " + object_.name + ")";
  }
  double depth_at(const test::CheckedPose& pose) const { return double(test::deepest_penetration(*checked_, pieces_, pose).depth); }

  void check_reset(const Pose<double>& pose, Status status) {
    const double depth = depth_at(test::checked_pose(pose));
    if (status == Status::converged && depth > allowed_) complain("reset took a pose " + std::to_string(1e9 * depth) + " nm deep");
    if (status != Status::penetrating || depth > 0) return;
    for (int i = 0; i < 40; ++i) {
      const Pose<double> near{pose.translation + 1e-7 * random_direction(bits_), pose.rotation};
      if (depth_at(test::checked_pose(near)) > 0) return;  // it touches, and rounding may decide
    }
    complain("reset refused a pose that is free");
  }

  void check_tick(const Pose<double>& before, const Pose<double>& haptic, const Tick<double>& tick) {
    const Pose<double>& pose = tick.graphic_pose;
    if (!test::is_valid(tick, int(checked_->triangles.rows()))) return complain("an output is not valid");
    if ((tick.status == Status::not_finite) == haptic.is_finite()) return complain("a status about the device is false");
    if (tick.path.empty() && !test::is_same(before, pose)) return complain("the tool moved off its path");
    const int budget = settings_.work_budget;
    if (budget >= 20 && !test::keeps_budget(tick.work, budget))
      complain(std::to_string(tick.work) + " units of work with a budget of " + std::to_string(budget));
    Pose<double> from = before;
    for (const Pose<double>& to : tick.path) {
      check_leg(from, to, tick.path.size() > 3 ? 3 : 7);
      from = to;
    }
    if (finding_.deepest > allowed_) complain("penetration of " + std::to_string(1e9 * finding_.deepest) + " nm");
  }

  /// The pose of the tool frame when the reference point has gone a share of its straight way.
  test::CheckedPose on_leg(const Pose<double>& from, const Pose<double>& to, test::WideReal share) const {
    const test::WideVector reference = settings_.reference_point.template cast<test::WideReal>();
    const auto about_reference = [&](const Pose<double>& pose) {
      const test::CheckedPose checked = test::checked_pose(pose);
      return test::CheckedPose(test::WideVector(checked.translation + checked.rotation * reference), checked.rotation);
    };
    const test::CheckedPose there = test::pose_on_path(about_reference(from), about_reference(to), share);
    return {test::WideVector(there.translation - there.rotation * reference), there.rotation};
  }

  void check_leg(const Pose<double>& from, const Pose<double>& to, int samples) {
    for (int i = 0; i < samples; ++i) {
      const test::WideReal begin = test::WideReal(i) / samples, end = test::WideReal(i + 1) / samples;
      finding_.deepest = std::max(finding_.deepest, depth_at(on_leg(from, to, end)));
      for (const auto& piece : pieces_) {
        if (piece.radius > 0 || piece.vertices.size() > 8) continue;
        for (const auto& vertex : piece.vertices)
          if (crosses(from, to, vertex, begin, end, 0)) complain("a corner of the tool went through a triangle");
      }
    }
  }

  /// Whether a corner of the tool passes through a triangle between two shares of a leg: its chord does, and that of a half, and so on.
  bool crosses(const Pose<double>& from, const Pose<double>& to, const test::WideVector& vertex, test::WideReal begin, test::WideReal end,
               int depth) const {
    const test::CheckedPose first = on_leg(from, to, begin), last = on_leg(from, to, end);
    const test::WideVector p = first.translation + first.rotation * vertex, q = last.translation + last.rotation * vertex;
    const auto volume = [](const test::WideVector& a, const test::WideVector& b, const test::WideVector& c, const test::WideVector& d) {
      return (b - a).cross(c - a).dot(d - a);
    };
    bool is_through = false;
    for (int i = 0; i < int(checked_->triangles.rows()) && !is_through; ++i) {
      const test::WideVector a = checked_->corner(i, 0), b = checked_->corner(i, 1), c = checked_->corner(i, 2);
      if (!(volume(a, b, c, p) * volume(a, b, c, q) < 0)) continue;
      const auto s = volume(p, q, a, b), t = volume(p, q, b, c), u = volume(p, q, c, a);
      is_through = (s > 0 && t > 0 && u > 0) || (s < 0 && t < 0 && u < 0);
    }
    if (!is_through || depth == 20) return is_through;
    const test::WideReal middle = (begin + end) / 2;
    return crosses(from, to, vertex, begin, middle, depth + 1) || crosses(from, to, vertex, middle, end, depth + 1);
  }

  std::mt19937& bits_;
  Tool tool_;
  RandomObject object_;
  Settings<double> settings_;
  Pose<double> placed_;
  std::vector<test::CheckedTool> pieces_;
  std::optional<test::CheckedObject> checked_;
  double allowed_ = 0;
  Finding finding_;
};

}  // namespace feeler::fuzz
