// The tremor of a hand: a small smooth motion that a seed decides.
#pragma once

#include <array>
#include <cstdint>

namespace feeler {

/// Physiological tremor as three sinusoids of 8 to 12 Hz per axis, with frequencies and phases from a seed.
///
/// A function of time alone, so that any instant can be asked for and the same seed always gives the same motion.
class Tremor {
 public:
  /// @param position_amplitude  root mean square per axis over a long time [m]
  /// @param rotation_amplitude  root mean square per axis over a long time [rad]
  Tremor(double position_amplitude, double rotation_amplitude, std::uint32_t seed);

  /// Displacement x, y, z [m] and rotation vector x, y, z [rad] at a time [s].
  std::array<double, 6> at(double time) const noexcept;

 private:
  struct Wave {
    double angular_frequency;  // [rad/s]
    double phase;              // [rad]
  };
  static constexpr int waves_ = 3;

  double position_amplitude_;
  double rotation_amplitude_;
  std::array<std::array<Wave, waves_>, 6> axes_;
};

}  // namespace feeler
