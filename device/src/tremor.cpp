// Draws the waves of a tremor from a seed and sums them.
#include "feeler/device/tremor.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace feeler {

Tremor::Tremor(double position_amplitude, double rotation_amplitude, std::uint32_t seed)
    : position_amplitude_(position_amplitude), rotation_amplitude_(rotation_amplitude) {
  // Raw bits, because the distributions of the standard library differ between implementations.
  std::mt19937 bits(seed);
  const auto uniform = [&bits] { return double(bits()) / 4294967296.0; };
  for (auto& axis : axes_) {
    for (Wave& wave : axis) {
      const double frequency = 8.0 + 4.0 * uniform();
      wave.angular_frequency = 2 * std::numbers::pi * frequency;
      wave.phase = 2 * std::numbers::pi * uniform();
    }
  }
}

std::array<double, 6> Tremor::at(double time) const noexcept {
  std::array<double, 6> motion = {};
  if (position_amplitude_ == 0 && rotation_amplitude_ == 0) return motion;
  const double share = std::sqrt(2.0 / waves_);  // n sinusoids of amplitude a have a root mean square of a √(n/2)
  for (std::size_t axis = 0; axis < 6; ++axis) {
    double sum = 0;
    for (const Wave& wave : axes_[axis]) sum += std::sin(wave.angular_frequency * time + wave.phase);
    motion[axis] = (axis < 3 ? position_amplitude_ : rotation_amplitude_) * share * sum;
  }
  return motion;
}

}  // namespace feeler
