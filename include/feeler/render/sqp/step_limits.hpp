// How long a motion may be proposed: the trust region near the object, and a limit of its own away from it.
#pragma once

#include <algorithm>
#include <limits>

namespace feeler {

/// Lengths up to which a linearisation, or the certificate's work, is trusted. They learn from what became of the motions.
template <class ScalarType>
class StepLimits {
 public:
  using Scalar = ScalarType;

  /// As before the first motion.
  /// @param radius  of the trust region [m]
  void reset(Scalar radius) noexcept {
    radius_ = trust_ = radius;
    flight_ = std::numeric_limits<Scalar>::infinity();
    unhindered_ = 0;
  }
  /// For the next tick, which goes on with the motion that this one left: a long slide half as fast again as it would begin.
  void carry_over() noexcept {
    const Scalar least = radius_ / 4000;
    trust_ = std::clamp(trust_, least, is_long_slide() ? 3 * radius_ / 2 : radius_);
    flight_ = (std::max)(flight_, least);
  }

  /// Longest motion near the object [m].
  Scalar trust() const noexcept { return trust_; }
  /// Longest motion [m]; in flight nothing is near, and only the work of the certificate limits it.
  Scalar longest(bool is_in_flight) const noexcept { return is_in_flight ? flight_ : trust_; }

  /// After a motion that nothing stopped. Long slides pass wide faces: after some such motions, or one with little near, the trust region
  /// outgrows its radius.
  /// @param work  that it took to certify, in the unit of `Settings::work_budget`
  void widen(int work) noexcept {
    const bool fills_radius = trust_ >= radius_;
    if (fills_radius) unhindered_ += work <= work_with_little_near ? long_slide : 1;
    trust_ = (std::min)(2 * trust_, fills_radius && is_long_slide() ? 8 * radius_ : (std::max)(trust_, radius_));
    flight_ *= 2;
  }
  /// After one that was too long.
  void narrow(Scalar length) noexcept {
    trust_ = length;
    unhindered_ = 0;
  }
  /// After one that met something new: what is known of it holds within the radius.
  void narrow_to_radius() noexcept { narrow((std::min)(trust_, radius_)); }
  /// After one that took more work to certify than there was.
  void shorten(bool is_in_flight, Scalar length) noexcept { (is_in_flight ? flight_ : trust_) = length; }

 private:
  static constexpr int long_slide = 4;  // motions
  static constexpr int work_with_little_near = 2;

  bool is_long_slide() const noexcept { return unhindered_ >= long_slide; }

  Scalar radius_ = Scalar(0);
  Scalar trust_ = Scalar(0);
  Scalar flight_ = Scalar(0);
  int unhindered_ = 0;  // motions of the radius and more in a row that nothing stopped, or as much
};

}  // namespace feeler
