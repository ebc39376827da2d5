// Round tools: a convex core swept by a ball, as spheres, capsules, rounded boxes and rounded polytopes are.
#pragma once

#include <concepts>
#include <limits>
#include <string>

#include "feeler/core/requirement.hpp"
#include "feeler/tool/box.hpp"
#include "feeler/tool/convex_polytope.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/point.hpp"
#include "feeler/tool/segment.hpp"
#include "feeler/tool/swept_tool.hpp"
#include "feeler/tool/symmetry.hpp"

namespace feeler {

/// A convex core swept by a ball: the Minkowski sum of the two, rounded exactly, not by facets. Coordinates are in the tool frame [m].
///
/// Distances are those of the core less the radius, so it costs what its core costs, and less near contact, where the core is still a
/// radius away from the object and no direction is in doubt.
/// @tparam CoreType  any convex tool, a user's own included, that is not swept itself
template <ConvexTool CoreType>
  requires(!SweptTool<CoreType>)
class SphereSwept {
 public:
  using Core = CoreType;
  using Scalar = typename Core::Scalar;
  static constexpr Symmetry symmetry = symmetry_of<Core>;

  /// Refuses a radius that is not finite, or under 1e-7 m: so thin a skin is no more than the margin.
  SphereSwept(const Core& core, Scalar radius) : core_(core), radius_(radius) { refuse_for(reason_against(core, radius)); }
  /// A sphere about the origin.
  explicit SphereSwept(Scalar radius)
    requires(symmetry_of<Core> == Symmetry::about_point && std::default_initializable<Core>)
      : SphereSwept(Core(), radius) {}
  /// A sphere about a point of the tool frame [m].
  SphereSwept(const Vector3<Scalar>& centre, Scalar radius)
    requires(symmetry_of<Core> == Symmetry::about_point && std::constructible_from<Core, const Vector3<Scalar>&>)
      : SphereSwept(Core(centre), radius) {}

  static std::string reason_against(const Core&, Scalar radius) { return reason_against(radius); }
  static std::string reason_against(Scalar radius) {
    if (!(radius < std::numeric_limits<Scalar>::infinity())) return "SphereSwept: the radius is a NaN or infinite; give a finite length";
    if (!(radius >= Scalar(1) / 10'000'000)) return "SphereSwept: the radius is under 1e-7 m; give a larger one, or use the core as the tool";
    return {};
  }
  static std::string reason_against(const Vector3<Scalar>& centre, Scalar radius)
    requires(symmetry_of<Core> == Symmetry::about_point && std::constructible_from<Core, const Vector3<Scalar>&>)
  {
    std::string reason = Core::reason_against(centre);
    return reason.empty() ? reason_against(radius) : reason;
  }

  const Core& core() const noexcept { return core_; }
  Scalar swept_radius() const noexcept { return radius_; }

  int vertex_count() const noexcept { return core_.vertex_count(); }
  decltype(auto) vertex(int i) const noexcept { return core_.vertex(i); }
  int support(const Vector3<Scalar>& direction) const noexcept { return core_.support(direction); }
  int edge_count() const noexcept { return core_.edge_count(); }
  ToolEdge edge(int i) const noexcept { return core_.edge(i); }
  int face_count() const noexcept { return core_.face_count(); }
  ToolFace<Scalar> face(int i) const noexcept { return core_.face(i); }
  int edge_direction_count() const noexcept { return core_.edge_direction_count(); }
  decltype(auto) edge_direction(int i) const noexcept { return core_.edge_direction(i); }
  int face_axis_count() const noexcept { return core_.face_axis_count(); }
  decltype(auto) face_axis(int i) const noexcept { return core_.face_axis(i); }

  /// The same shape in another scalar; a radius that vanishes there is refused.
  template <class Other>
  auto cast() const {  // named in the body, so that a core may do without a cast
    return SphereSwept<ToolCast<Core, Other>>(core_.template cast<Other>(), static_cast<Other>(radius_));
  }

 private:
  Core core_;
  Scalar radius_;
};

/// `Sphere<double>(radius)` about the origin of the tool frame, or `Sphere<double>(centre, radius)`.
template <RealScalar Scalar>
using Sphere = SphereSwept<Point<Scalar>>;
/// `Capsule<double>({start, end}, radius)`: a cylinder with half a sphere at each end.
template <RealScalar Scalar>
using Capsule = SphereSwept<Segment<Scalar>>;
/// `RoundedBox<double>(Box<double>(half_extents), radius)`: outside, its half extents are larger by the radius.
template <RealScalar Scalar>
using RoundedBox = SphereSwept<Box<Scalar>>;
/// `RoundedPolytope<double>(ConvexPolytope<double>::hull_of(points), radius)`.
template <RealScalar Scalar>
using RoundedPolytope = SphereSwept<ConvexPolytope<Scalar>>;

static_assert(SweptTool<Sphere<double>> && SweptTool<Capsule<double>> && SweptTool<RoundedBox<double>> && SweptTool<RoundedPolytope<double>>);
static_assert(symmetry_of<Capsule<double>> == Symmetry::about_axis && symmetry_of<RoundedBox<double>> == Symmetry::none);
static_assert(!SweptTool<Box<double>>);

}  // namespace feeler
