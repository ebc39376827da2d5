// The distances that a certificate keeps between tool and object.
#pragma once

#include <algorithm>

namespace feeler {

/// The separations that a certificate insists on, and the lengths that it rounds to: shares of the margin, and of the length of usual motions, so that a
/// scene and its copy in another size are certified alike.
template <class Scalar>
struct Clearance {
  Scalar kept;  ///< separation required wherever there is that much to begin with [m]
  Scalar rounding = Scalar(0);  ///< of the poses that are returned: where there is that much to begin with, no motion leaves less [m]
  Scalar allowance;  ///< overlap accepted where there is no clearance at all; rounding, never accumulated [m]
  Scalar touching;  ///< see `touching_distance` [m]
  Scalar resolution;  ///< advance too small to look for [m]
  Scalar probe;  ///< length of motion over which all blockers are wanted, not only the first [m]

  /// With the defaults of the settings.
  Clearance() noexcept : Clearance(Scalar(1e-6), Scalar(4e-4)) {}
  /// @param margin  that is wanted [m]
  /// @param way     length of a motion near the object [m]
  Clearance(Scalar margin, Scalar way) noexcept
      : kept(margin / 10), allowance(way / 400 / 200000), touching(way / 400 / 100), resolution(way / 400 / 4), probe(way / 4) {}

  /// A separation up to it is none: rounding decided how much there is [m].
  Scalar negligible() const noexcept { return 2 * allowance; }
  /// What a step must leave of a separation at a certified pose: half of it, but no less than `kept`; all of it where there is less than `kept`, or a
  /// fit without clearance would lose what holds it; 0 where it is negligible [m].
  Scalar to_leave(Scalar separation) const noexcept {
    return separation > negligible() ? (std::min)(separation, (std::max)(separation / 2, kept)) : Scalar(0);
  }
  /// With a separation below it a wall is slid along without clearance, whichever of its triangles was measured [m].
  Scalar none() const noexcept { return 20 * allowance; }
  /// Separation required along a motion that starts `start` away: tight fits may halve it, an overlap may stay but not grow. To halve
  /// what is negligible too would stop a tool that slides in such a fit.
  Scalar required(Scalar start) const noexcept {
    if (start >= 2 * kept) return (std::min)(kept, start);  // kept may be an overlap itself
    if (start > negligible()) {
      // A motion that left no more than `rounding` ended a last bit below it, or above: the next one may lose such a bit, and not half.
      const Scalar least = start > rounding / 2 ? (std::min)(rounding, start - allowance / 32) : Scalar(0);
      return (std::max)(start / 2, least);
    }
    return std::clamp(start, -2 * allowance, -allowance);
  }
};

}  // namespace feeler
