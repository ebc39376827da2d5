// Evaluates a linear model of the wrench and keeps it from pulling.
#include "feeler/device/wrench_extrapolator.hpp"

#include <algorithm>
#include <cmath>

#include "feeler/device/conversion.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {
namespace {

using Axes = std::array<double, 6>;  // linear, then angular

/// Flattened for the reason given in simulated_hand.cpp.
[[gnu::flatten]] Axes motion_of(const DevicePose& from, const DevicePose& to) noexcept {
  const auto twist = motion_between(from_device<Pose<double>>(from).normalized(), from_device<Pose<double>>(to).normalized());
  return {twist.linear[0], twist.linear[1], twist.linear[2], twist.angular[0], twist.angular[1], twist.angular[2]};
}

void shorten(double* vector, double longest) noexcept {
  const double length = std::hypot(vector[0], vector[1], vector[2]);
  if (!(length > longest)) return;
  for (int i = 0; i < 3; ++i) vector[i] *= longest / length;
}

/// Drops the part of the change that turns the vector against itself.
void push_only(const double (&rendered)[3], double (&vector)[3]) noexcept {
  double along = 0;
  double square = 0;
  for (int i = 0; i < 3; ++i) {
    along += rendered[i] * vector[i];
    square += rendered[i] * rendered[i];
  }
  if (!(along < 0) || !(square > 0)) return;
  for (int i = 0; i < 3; ++i) vector[i] -= along / square * rendered[i];
}

}  // namespace

DeviceWrench extrapolated(const WrenchModel& model, const DevicePose& pose, const ExtrapolationLimits& limits) noexcept {
  Axes motion = motion_of(model.pose, pose);
  shorten(motion.data(), limits.distance);
  shorten(motion.data() + 3, limits.angle);
  DeviceWrench result = model.wrench;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 6; ++column) {
      result.force[row] += model.derivative[6 * row + column] * motion[column];
      result.torque[row] += model.derivative[6 * (row + 3) + column] * motion[column];
    }
  }
  push_only(model.wrench.force, result.force);
  push_only(model.wrench.torque, result.torque);
  return result;
}

}  // namespace feeler
