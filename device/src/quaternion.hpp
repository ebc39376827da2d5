// The little of quaternions that plain numbers need: w, x, y, z.
#pragma once

namespace feeler::quaternion {

using Quaternion = double[4];

inline void multiply(const Quaternion& a, const Quaternion& b, Quaternion& product) noexcept {
  const double w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
  const double x = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
  const double y = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
  const double z = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
  product[0] = w, product[1] = x, product[2] = y, product[3] = z;
}

inline void conjugate(const Quaternion& q, Quaternion& result) noexcept {
  result[0] = q[0];
  for (int i = 1; i < 4; ++i) result[i] = -q[i];
}

/// v + 2 w (u × v) + 2 u × (u × v), with q = (w, u).
inline void rotate(const Quaternion& q, const double (&v)[3], double (&result)[3]) noexcept {
  const double* u = q + 1;
  double once[3];
  for (int i = 0; i < 3; ++i) once[i] = 2 * (u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
  double turned[3];
  for (int i = 0; i < 3; ++i) {
    turned[i] = v[i] + q[0] * once[i] + u[(i + 1) % 3] * once[(i + 2) % 3] - u[(i + 2) % 3] * once[(i + 1) % 3];
  }
  for (int i = 0; i < 3; ++i) result[i] = turned[i];
}

}  // namespace feeler::quaternion
