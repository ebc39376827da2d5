// One contact as the optimisation sees it: separation of two features, its gradient and its curvature.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/spatial/rotation.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// Which features meet: it decides how the normal turns with the tool.
enum class FeaturePair : unsigned char {
  vertex_face,  ///< tool vertex on object face, or no better known: the normal stays with the object
  face_vertex,  ///< tool face on object vertex: the normal turns with the tool
  edge_edge,    ///< two edges that cross: the normal is perpendicular to both
};

/// Separation of a pair of features near contact, s(d) for a step d = (dp, w) of the tool; world axes, points relative to the tool
/// reference point at the pose of linearisation [m].
///
/// s(d) ≈ gap + J d + ½ dᵀ C d with J = [n, r × n] for the contact point at arm r (paper, eq. 6 and 7).
template <class ScalarType>
struct ContactRow {
  using Scalar = ScalarType;

  FeaturePair kind = FeaturePair::vertex_face;
  int piece = 0;  ///< of the tool
  int triangle = -1;
  bool is_assumed = false;  ///< a plane that the tool is not over yet, or an edge past its end: a step that it stops is not the last one
  bool is_repeated = false; ///< rows of other pairs ask the same and were left out for it
  Vector3<Scalar> normal = Vector3<Scalar>::UnitZ();     ///< unit, from the object to the tool
  Vector3<Scalar> arm = Vector3<Scalar>::Zero();         ///< contact point on the tool; for `face_vertex` the object vertex
  Vector3<Scalar> object_edge = Vector3<Scalar>::Zero(); ///< `edge_edge` only: unit directions
  Vector3<Scalar> tool_edge = Vector3<Scalar>::Zero();
  Scalar gap = Scalar(0);
  Scalar room = Scalar(0);  ///< how far the contact may slide before other features meet [m]

  /// Whether the same features surely meet after a step: it slides no farther than a quarter of the room.
  ///
  /// At the end of the room other features take over, and what rests on both may rest on neither.
  bool outlasts(const Vector6<Scalar>& step) const noexcept {
    const Vector3<Scalar> motion = step.template head<3>() + Vector3<Scalar>(step.template tail<3>()).cross(arm);
    return 16 * (motion - normal.dot(motion) * normal).squaredNorm() <= room * room;
  }

  /// Whether another row asks the same of a step, but for rounding; how the two bend may differ. Triangles of one plane or with one edge
  /// have such rows, and so have pieces of a tool with one corner.
  bool repeats(const ContactRow& other) const noexcept {
    using std::abs;
    const Scalar angle = 4096 * std::numeric_limits<Scalar>::epsilon();
    const Scalar squared_angle = angle * angle, squared_length = squared_angle * arm.squaredNorm();
    if (!(abs(normal.x() - other.normal.x()) <= angle)) return false;  // most are told apart by one number
    return (gap - other.gap) * (gap - other.gap) <= squared_length && is_assumed == other.is_assumed &&
           (normal - other.normal).squaredNorm() <= squared_angle && (arm - other.arm).cross(normal).squaredNorm() <= squared_length;
  }

  /// The row where a motion ends, exactly, if the same features still meet there.
  ContactRow carried(const Displacement<Scalar>& motion) const noexcept {
    const Matrix3<Scalar>& turn = motion.turn;
    ContactRow row = *this;
    switch (kind) {
      case FeaturePair::vertex_face:
        row.arm = turn * arm;
        row.gap = gap + normal.dot(motion.linear + row.arm - arm);
        break;
      case FeaturePair::face_vertex:
        row.normal = turn * normal;
        row.arm = arm - motion.linear;
        row.gap = gap - row.normal.dot(row.arm) + normal.dot(arm);
        break;
      case FeaturePair::edge_edge: {
        row.tool_edge = turn * tool_edge;
        const Vector3<Scalar> between = gap * normal + motion.linear + turn * arm - arm;
        const Vector3<Scalar> across = row.tool_edge.cross(object_edge).normalized();
        row.normal = across.dot(normal) < Scalar(0) ? Vector3<Scalar>(-across) : across;
        row.gap = row.normal.dot(between);
        row.arm = turn * arm + nearest_on_line(between, row.tool_edge, object_edge) * row.tool_edge;
        break;
      }
    }
    return row;
  }

  /// Where on the line b + s·v it is nearest to the line t·u; u and v are unit or, for a point, u is zero.
  static Scalar nearest_on_line(const Vector3<Scalar>& b, const Vector3<Scalar>& v, const Vector3<Scalar>& u) noexcept {
    const Scalar cosine = u.dot(v);
    return (cosine * b.dot(u) - b.dot(v)) / (Scalar(1) - cosine * cosine);
  }

  Vector6<Scalar> gradient() const noexcept {
    Vector6<Scalar> j;
    j << normal, arm.cross(normal);
    return j;
  }

  /// Adds a multiple of C, the second derivative of the separation by the step, to the lower triangle of a matrix.
  ///
  /// It does so number by number: whole blocks would wait for each other in memory.
  ///
  /// A vertex on a face moves by Exp(w)r, so its part is A(n, r). A face on a vertex z sees it
  /// move by Exp(−w)(z − dp). Where edges u (object) and v (tool) cross, n ∝ v × u turns by δn = B w, and δn·δx is added.
  void add_curvature(const Scalar& multiple, Matrix6<Scalar>& lower) const noexcept {
    switch (kind) {
      case FeaturePair::vertex_face: add_chord(multiple, lower); break;
      case FeaturePair::face_vertex: add_chord(-multiple, lower);
#pragma GCC unroll 3
        for (int j = 0; j < 3; ++j) {
          const int k = (j + 1) % 3, i = (j + 2) % 3;  // [n]×
          lower(3 + k, j) += multiple * normal[i];
          lower(3 + i, j) -= multiple * normal[k];
        }
        break;
      case FeaturePair::edge_edge: {
        add_chord(multiple, lower);
        const Scalar cosine = object_edge.dot(tool_edge);
        const Scalar scale = multiple / tool_edge.cross(object_edge).dot(normal);  // by the signed sine of the angle between the edges
#pragma GCC unroll 3
        for (int j = 0; j < 3; ++j) {
          const Vector3<Scalar> turn = scale * (object_edge[j] * tool_edge - cosine * (Vector3<Scalar>::Unit(j) - normal[j] * normal));  // of B
          const Vector3<Scalar> carried = turn.cross(arm);
#pragma GCC unroll 3
          for (int i = 0; i < 3; ++i) {
            lower(3 + j, i) += turn[i];
            lower(3 + (std::max)(i, j), 3 + (std::min)(i, j)) -= carried[i];
          }
          lower(3 + j, 3 + j) -= carried[j];
        }
        break;
      }
    }
  }

  /// Adds a multiple of A(n, r) = ½(nrᵀ + rnᵀ) − (n·r)I with wᵀA w = n·w×(w×r), what a turn adds to the height of the arm's end, for the turns.
  void add_chord(const Scalar& multiple, Matrix6<Scalar>& lower) const noexcept {
    const Vector3<Scalar> half = multiple * normal / 2;
    const Scalar height = 2 * half.dot(arm);
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      lower(3 + j, 3 + j) -= height;
#pragma GCC unroll 3
      for (int i = j; i < 3; ++i) lower(3 + i, 3 + j) += half[i] * arm[j] + half[j] * arm[i];
    }
  }
};

/// The gap of a row where a motion ends; all else that `carried` finds is left out.
template <class Row>
FEELER_FLATTEN typename Row::Scalar carried_gap(const Row& row, const Displacement<typename Row::Scalar>& motion) noexcept {
  return row.carried(motion).gap;
}

/// C of a row, whole.
template <class Row>
Matrix6<typename Row::Scalar> curvature_of(const Row& row) noexcept {
  using Scalar = typename Row::Scalar;
  Matrix6<Scalar> lower = Matrix6<Scalar>::Zero();
  row.add_curvature(Scalar(1), lower);
  return lower.template selfadjointView<Eigen::Lower>();
}

}  // namespace feeler
