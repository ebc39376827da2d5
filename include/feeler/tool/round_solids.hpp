// Cylinders and cones as polytopes with many facets, inside or outside of the round shape by a stated error.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "feeler/core/result.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/tool/convex_polytope.hpp"

namespace feeler {

/// On which side of the round shape its facets lie.
enum class Facets {
  inscribed,      ///< edges on the round surface: nothing of the tool is outside of it
  circumscribed,  ///< facets touch the round surface: nothing of it is outside of the tool
};

/// Largest distance of a circle from a regular polygon in or about it [m]: r (1 − cos(π/n)), or r (1/cos(π/n) − 1); about 4.93 r/n².
template <RealScalar Scalar>
Scalar facet_error(Scalar radius, int facets, Facets side = Facets::inscribed) noexcept {
  using std::cos;
  using std::sin;
  const Scalar half_angle = std::numbers::pi_v<Scalar> / Scalar(facets);
  const Scalar sine = sin(half_angle / 2);  // 1 − cos a = 2 sin²(a/2), without cancellation
  const Scalar inside = 2 * radius * sine * sine;
  return side == Facets::inscribed ? inside : inside / cos(half_angle);
}

namespace detail {
/// What no cylinder or cone has, as a sentence that begins with its name, or nothing.
template <RealScalar Scalar>
std::string reason_against_round_solid(const char* name, Scalar radius, Scalar height, int facets, int most_facets) {
  const Scalar infinity = std::numeric_limits<Scalar>::infinity();
  if (!(radius > Scalar(0) && radius < infinity && height > Scalar(0) && height < infinity))
    return std::string(name) + ": the radius or the height is not a positive length; give two finite lengths";
  if (facets < 3 || facets > most_facets)
    return std::string(name) + ": " + std::to_string(facets) + " facets; give 3 to " + std::to_string(most_facets) +
           ", as a polytope has no more vertices";
  return {};
}

/// Writes a regular polygon about the z axis into rows of `points`.
template <RealScalar Scalar>
void write_polygon(Scalar radius, Scalar z, int facets, Facets side, int first_row, Points<Scalar>& points) {
  using std::cos;
  using std::sin;
  const Scalar pi = std::numbers::pi_v<Scalar>;
  const Scalar reach = side == Facets::inscribed ? radius : radius / cos(pi / Scalar(facets));
  for (int i = 0; i < facets; ++i) {
    const Scalar angle = 2 * pi * Scalar(i) / Scalar(facets);
    points.row(first_row + i) << reach * cos(angle), reach * sin(angle), z;
  }
}
}  // namespace detail

/// A cylinder about the z axis of the tool frame, from −height/2 to height/2 [m], as a prism with `facets` sides.
///
/// Its side is off by at most `facet_error(radius, facets, side)`: with 32 facets 0.5 % of the radius, with 128 0.03 %. Its ends are exact.
/// Facets can be felt when the tool rolls; a shaft with round ends is exact as a `Capsule`.
/// @param facets  3 to 16383
template <RealScalar Scalar>
Result<ConvexPolytope<Scalar>> try_cylinder(Scalar radius, Scalar height, int facets = 32, Facets side = Facets::inscribed) {
  using Hull = ConvexPolytope<Scalar>;
  std::string reason = detail::reason_against_round_solid("cylinder", radius, height, facets, Hull::maximum_vertex_count / 2);
  if (!reason.empty()) return Result<Hull>::refused(std::move(reason));
  Points<Scalar> points(2 * facets, 3);
  detail::write_polygon<Scalar>(radius, -height / 2, facets, side, 0, points);
  detail::write_polygon<Scalar>(radius, height / 2, facets, side, facets, points);
  return Hull::try_hull_of(points);
}
/// The same; refuses where there is a reason.
template <RealScalar Scalar>
ConvexPolytope<Scalar> cylinder(Scalar radius, Scalar height, int facets = 32, Facets side = Facets::inscribed) {
  return try_cylinder(radius, height, facets, side).value();
}

/// A cone about the z axis of the tool frame, its tip at the origin and its round base at −height [m], as a pyramid with `facets` sides.
///
/// Across its axis it is off by at most `facet_error(radius, facets, side)`, at its base; the tip and the base's plane are exact.
/// @param facets  3 to 32766
template <RealScalar Scalar>
Result<ConvexPolytope<Scalar>> try_cone(Scalar radius, Scalar height, int facets = 32, Facets side = Facets::inscribed) {
  using Hull = ConvexPolytope<Scalar>;
  std::string reason = detail::reason_against_round_solid("cone", radius, height, facets, Hull::maximum_vertex_count - 1);
  if (!reason.empty()) return Result<Hull>::refused(std::move(reason));
  Points<Scalar> points(facets + 1, 3);
  detail::write_polygon<Scalar>(radius, -height, facets, side, 0, points);
  points.row(facets).setZero();
  return Hull::try_hull_of(points);
}
/// The same; refuses where there is a reason.
template <RealScalar Scalar>
ConvexPolytope<Scalar> cone(Scalar radius, Scalar height, int facets = 32, Facets side = Facets::inscribed) {
  return try_cone(radius, height, facets, side).value();
}

}  // namespace feeler
