// A contact of a swept tool as the optimisation sees it: its core is as far away as the radius, so the normal turns slowly, and by how much
// counts.
#pragma once

#include <type_traits>

#include "feeler/contact/contact_row.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// Separation of a feature of the core of a swept tool and a feature of the object, less the radius; the arm is on the core.
///
/// Where both features are points or lines (`core_distance` > 0), `object_edge` and `tool_edge` are the directions of the lines and zero for
/// points, and the separation is the distance of the two less the radius. Else it is that of a `ContactRow`, which the radius does not bend.
template <class ScalarType>
struct SweptContactRow : ContactRow<ScalarType> {
  using Scalar = ScalarType;

  Scalar core_distance = Scalar(0);  ///< between two points, a point and a line, or two lines that are not parallel [m]

  /// The row where a motion ends, exactly, if the same features still meet there.
  SweptContactRow carried(const Displacement<Scalar>& motion) const noexcept {
    SweptContactRow row = *this;
    if (!(core_distance > Scalar(0))) {
      static_cast<ContactRow<Scalar>&>(row) = ContactRow<Scalar>::carried(motion);
      return row;
    }
    row.arm = motion.turn * this->arm;
    row.tool_edge = motion.turn * this->tool_edge;
    Vector3<Scalar> between = core_distance * this->normal + motion.linear + row.arm - this->arm;
    const Vector3<Scalar>&u = row.object_edge, &v = row.tool_edge;
    const Vector3<Scalar> slide = row.nearest_on_line(between, v, u) * v;
    row.arm += slide;
    between += slide;
    between -= u.dot(between) * u;
    row.core_distance = between.norm();
    if (row.core_distance > Scalar(0)) row.normal = between / row.core_distance;
    row.gap = this->gap + row.core_distance - core_distance;
    return row;
  }

  /// As `ContactRow::add_curvature`.
  ///
  /// The distance is the least of |x + a v − y − b u| over a and b, x − y = d n, with x moved by dp + w×x + ½ w×(w×x). With J = [I, −[x]×],
  /// P = I − nnᵀ and Φ the mixed derivatives by the step and (a, b), second derivatives of such a minimum are
  /// C = A(n, x) + JᵀPJ/d − Φ H⁻¹ Φᵀ, where Φ = [Jᵀv/d + (0, v×n), −Jᵀu/d] and H = [1, −u·v; −u·v, 1]/d; for a point its part is left out.
  void add_curvature(const Scalar& multiple, Matrix6<Scalar>& lower) const noexcept {
    if (!(core_distance > Scalar(0))) return ContactRow<Scalar>::add_curvature(multiple, lower);
    using Column = Vector6<Scalar>;
    const Vector3<Scalar>&n = this->normal, &x = this->arm, &u = this->object_edge, &v = this->tool_edge;
    // J as seen by a direction: Jᵀe = (e, x × e).
    const auto moved_along = [&x](const Vector3<Scalar>& e) {
      Column column;
      column << e, x.cross(e);
      return column;
    };
    const auto add_square = [&lower](const Scalar& scale, const Column& column) {
      for (int j = 0; j < 6; ++j) {
        const Scalar scaled = scale * column[j];
        for (int i = j; i < 6; ++i) lower(i, j) += scaled * column[i];
      }
    };
    const Scalar share = multiple / core_distance;
    this->add_chord(multiple, lower);
    for (int k = 0; k < 3; ++k) add_square(share, moved_along(Vector3<Scalar>::Unit(k)));
    add_square(-share, moved_along(n));
    const bool has_tool_edge = !v.isZero(Scalar(0)), has_object_edge = !u.isZero(Scalar(0));
    Column by_tool = moved_along(v);  // Φ and H times d
    by_tool.template tail<3>() += core_distance * v.cross(n);
    const Column by_object = -moved_along(u);
    if (has_tool_edge && has_object_edge) {
      const Scalar cosine = u.dot(v);
      add_square(-share, by_object);
      add_square(-share / (Scalar(1) - cosine * cosine), by_tool + cosine * by_object);
    } else if (has_tool_edge) {
      add_square(-share, by_tool);
    } else if (has_object_edge) {
      add_square(-share, by_object);
    }
  }
};

/// The rows that a tool needs: a tool that is not swept carries nothing for those that are.
template <ConvexTool Tool>
using ContactRowOf = std::conditional_t<SweptTool<Tool>, SweptContactRow<typename Tool::Scalar>, ContactRow<typename Tool::Scalar>>;

}  // namespace feeler
