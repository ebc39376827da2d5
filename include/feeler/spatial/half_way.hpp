// The pose half way of a turn so long that the poses at its ends do not tell which way round it went.
#pragma once

#include <cmath>
#include <optional>

#include "feeler/spatial/pose.hpp"

namespace feeler {

/// Half way from one pose to another by the shorter way round, where they are turned from each other by 3 rad or more; where by less there is none,
/// as the two tell by themselves. At half a turn it is one of the two ways round.
///
/// The two quaternions are a quarter turn of their sphere apart or nearly so, so that their middle is as exact as they are.
template <class Scalar>
std::optional<Pose<Scalar>> half_way_of_long_turn(const Pose<Scalar>& from, const Pose<Scalar>& to) noexcept {
  using std::abs;
  const Scalar cosine_of_half = Scalar(0.0708);  // of 2.9999 rad
  const Scalar cosine = from.rotation.dot(to.rotation);
  if (abs(cosine) > cosine_of_half) return std::nullopt;
  Pose<Scalar> middle;
  middle.translation = (from.translation + to.translation) / 2;
  middle.rotation.coeffs() = (from.rotation.coeffs() + (cosine < Scalar(0) ? Scalar(-1) : Scalar(1)) * to.rotation.coeffs()).normalized();
  return middle;
}

}  // namespace feeler
