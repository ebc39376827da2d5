// From the rotation matrix that a device reports, which is only nearly one, to a unit quaternion.
#pragma once

#include "feeler/core/no_fast_math.hpp"

namespace feeler {

/// The unit quaternion of the rotation nearest to a matrix (in the Frobenius norm).
///
/// Encoders and single precision leave the matrices of devices slightly skewed. The nearest rotation is the
/// orthogonal factor of the polar decomposition, by Newton's iteration R ← (R + R⁻ᵀ)/2 (Higham 1986,
/// eq. 3.5), which converges quadratically.
/// @param matrix      row by row
/// @param quaternion  w, x, y, z with w ≥ 0; untouched on failure
/// @return false for a matrix that is not finite, a mirror, or more than 0.2 from orthonormal in any product
/// of two rows: not a pose
/// @cost   no allocation, at most 12 iterations
bool nearest_rotation(const double (&matrix)[3][3], double (&quaternion)[4]) noexcept;

}  // namespace feeler
