// A renderer at work in a scene of the laws, and what a law finds there.
#pragma once

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <random>
#include <string>

#include "fuzz/laws/law_hand.hpp"
#include "fuzz/laws/law_scene.hpp"
#include "scenes/renderers.hpp"
#include "scenes/round_renderers.hpp"

namespace feeler::laws {

/// What a law found in a run.
struct LawFinding {
  bool is_refused = false;  ///< where the tool should start; then nothing was run
  long ticks = 0;
  double worst = 0;      ///< of what the law measures
  std::string kind;      ///< how it is broken, in a word or two; empty if it is not
  std::string problem;   ///< the first, with its tick

  /// Keeps the first complaint.
  [[gnu::format(printf, 4, 5)]] void complain(const char* how, long tick, const char* format, ...) {
    if (!kind.empty()) return;
    char text[300];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    kind = how;
    problem = "tick " + std::to_string(tick) + ": " + text;
  }
};

/// Takes hands and gives graphic poses in the axes of the scene.
template <class Tool>
class LawRun {
 public:
  explicit LawRun(const LawScene<Tool>& scene)
      : scene_(scene),
        radius_(has_turns<Tool> ? radius_of(scene.tool) : 0),
        mesh_(placed_vertices(scene), rows_of(scene.surface)),
        renderer_(mesh_, scene.tool, scene.settings) {
    is_started_ = renderer_.reset(compose(scene.placed, scene.start)) == Status::converged;
    hand_ = compose(scene.placed, scene.start);
  }
  LawRun(const LawRun&) = delete;
  LawRun& operator=(const LawRun&) = delete;

  bool is_started() const { return is_started_; }
  const Tick<double>& update(const Pose<double>& hand_in_scene) {
    const Pose<double> hand = compose(scene_.placed, hand_in_scene);
    const Twist<double> step = motion_between(hand_, hand);
    way_ += step.linear.norm(), turned_ += step.angular.norm();
    hand_ = hand;
    ++ticks_;
    return renderer_.update(hand_);
  }
  const Tick<double>& hold() {
    ++ticks_;
    return renderer_.update(hand_);
  }

  const HapticRenderer<Tool>& renderer() const { return renderer_; }
  const Tick<double>& tick() const { return renderer_.tick(); }
  const Pose<double>& hand() const { return hand_; }  ///< in the world
  Pose<double> graphic_in_scene() const { return relative_to(scene_.placed, tick().graphic_pose); }
  Pose<double> hand_in_scene() const { return relative_to(scene_.placed, hand_); }
  long ticks() const { return ticks_; }
  double way() const { return way_; }        ///< of the hand [m]
  double turned() const { return turned_; }  ///< the hand [rad]
  double radius() const { return radius_; }

  /// From the hand to the graphic tool, in the world; a ball does not turn.
  Twist<double> offset(const Pose<double>& graphic) const {
    Twist<double> offset = motion_between(hand_, graphic);
    if (!has_turns<Tool>) offset.angular.setZero();
    return offset;
  }
  double energy(const Pose<double>& graphic) const { return renderer_.metric().energy(offset(graphic)); }
  double energy() const { return energy(tick().graphic_pose); }
  /// What a margin is worth against the pull of a hand [m²].
  double worth_of_margin() const {
    const double margin = scene_.settings.margin;
    return margin * std::sqrt(2 * energy()) + margin * margin;
  }
  /// The most that any point of the tool is apart in two poses [m].
  double distance(const Pose<double>& a, const Pose<double>& b) const {
    const Twist<double> way = motion_between(a, b);
    return way.linear.norm() + radius_ * way.angular.norm();
  }
  /// Ticks that the tool needs to the hand if nothing is in its way.
  int ticks_of_way() const { return int(std::ceil(distance(hand_, tick().graphic_pose) / scene_.settings.trust_radius)); }

 private:
  static Points<double> placed_vertices(const LawScene<Tool>& scene) {
    Surface placed = scene.surface;
    for (Vector& vertex : placed.vertices) vertex = scene.placed * vertex;
    return points_of(placed);
  }

  const LawScene<Tool>& scene_;
  double radius_;
  TriangleMesh<double> mesh_;
  HapticRenderer<Tool> renderer_;
  bool is_started_ = false;
  Pose<double> hand_;
  long ticks_ = 0;
  double way_ = 0, turned_ = 0;
};

}  // namespace feeler::laws
