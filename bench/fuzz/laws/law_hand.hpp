// Hands that go about in a scene: slow, quick, still and trembling.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "fuzz/laws/law_scene.hpp"

namespace feeler::laws {

/// Goes at 0.2 m/s a kilohertz from the start to a place that the scene names; then each kind in its way.
template <class Tool>
class LawHand {
 public:
  enum class Kind { slow, quick, still, trembling };

  LawHand(std::mt19937& bits, const LawScene<Tool>& scene)
      : bits_(bits), scene_(scene), radius_(has_turns<Tool> ? radius_of(scene.tool) : 0), kind_(Kind(below(bits, 4))), pose_(scene.start) {
    go_to(scene.random_hand(bits), quick);
  }

  /// The pose of the next tick, in the axes of the scene.
  Pose<double> next() {
    if (steps_ > 0) return step();
    switch (kind_) {
      case Kind::slow: go_to(scene_.random_hand(bits_), slow); return step();
      case Kind::quick: go_to(scene_.random_hand(bits_), quick); return step();
      case Kind::still:
        if (++waited_ % 50 == 0) go_to(scene_.random_hand(bits_), quick);
        return pose_;
      case Kind::trembling: {
        Pose<double> pose{pose_.translation + noise * random_vector(bits_), pose_.rotation};
        if (!scene_.is_turned_as_hand) pose.rotation = (exp_rotation<double>(noise / radius_ * random_vector(bits_)) * pose.rotation).normalized();
        return pose;
      }
    }
    return pose_;
  }

 private:
  static constexpr double slow = 1e-6, quick = 2e-4, noise = 1e-5;  // [m]

  void go_to(const Pose<double>& goal, double speed) {
    from_ = pose_;
    goal_ = goal;
    const Twist<double> way = motion_between(from_, goal_);
    steps_ = all_steps_ = std::max(1, int(std::ceil(std::max(way.linear.norm(), radius_ * way.angular.norm()) / speed)));
  }
  Pose<double> step() {
    --steps_;
    const double share = double(all_steps_ - steps_) / all_steps_;
    pose_ = steps_ == 0
                ? goal_
                : Pose<double>{from_.translation + share * (goal_.translation - from_.translation), from_.rotation.slerp(share, goal_.rotation)};
    return pose_;
  }

  std::mt19937& bits_;
  const LawScene<Tool>& scene_;
  double radius_;
  Kind kind_;
  Pose<double> pose_, from_, goal_;
  int steps_ = 0, all_steps_ = 1, waited_ = 0;
};

}  // namespace feeler::laws
