// Polar decomposition and Shepperd's quaternion, in plain numbers.
#include "feeler/device/rotation_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace feeler {
namespace {

using Matrix = double[3][3];

double dot(const double (&a)[3], const double (&b)[3]) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Rows b × c, c × a, a × b of the rows a, b, c: the determinant times the inverse transpose.
void cofactors(const Matrix& m, Matrix& result) noexcept {
  for (int i = 0; i < 3; ++i) {
    const double(&b)[3] = m[(i + 1) % 3];
    const double(&c)[3] = m[(i + 2) % 3];
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3;
      const int l = (j + 2) % 3;
      result[i][j] = b[k] * c[l] - b[l] * c[k];
    }
  }
}

/// False for a NaN, too.
bool is_nearly_orthonormal(const Matrix& m) noexcept {
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      if (!(std::abs(dot(m[i], m[j]) - (i == j ? 1 : 0)) <= 0.2)) return false;
    }
  }
  return true;
}

/// Shepperd (1978): the largest of the four components first, so that nothing cancels.
void to_quaternion(const Matrix& r, double (&q)[4]) noexcept {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  const double squares[4] = {trace, r[0][0], r[1][1], r[2][2]};
  const auto largest = std::max_element(squares, squares + 4) - squares;
  if (largest == 0) {
    q[0] = 1 + trace;
    q[1] = r[2][1] - r[1][2];
    q[2] = r[0][2] - r[2][0];
    q[3] = r[1][0] - r[0][1];
  } else {
    const int i = int(largest) - 1;
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    q[0] = r[k][j] - r[j][k];
    q[1 + i] = 1 + 2 * r[i][i] - trace;
    q[1 + j] = r[j][i] + r[i][j];
    q[1 + k] = r[k][i] + r[i][k];
  }
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  const double scale = (q[0] < 0 ? -1 : 1) / length;
  for (double& component : q) component *= scale;
}

}  // namespace

bool nearest_rotation(const double (&matrix)[3][3], double (&quaternion)[4]) noexcept {
  if (!is_nearly_orthonormal(matrix)) return false;
  Matrix r;
  std::copy(&matrix[0][0], &matrix[0][0] + 9, &r[0][0]);
  for (int iteration = 0; iteration < 12; ++iteration) {
    Matrix inverse_transpose;
    cofactors(r, inverse_transpose);
    const double determinant = dot(r[0], inverse_transpose[0]);
    if (!(determinant > 0)) return false;
    double change = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double next = (r[i][j] + inverse_transpose[i][j] / determinant) / 2;
        change = std::max(change, std::abs(next - r[i][j]));
        r[i][j] = next;
      }
    }
    if (change < 1e-15) break;
  }
  to_quaternion(r, quaternion);
  return true;
}

}  // namespace feeler
