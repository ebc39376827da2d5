// Where a principal contact is, along which normal, and how wide its gap is.
#pragma once

#include <algorithm>
#include <limits>

#include "feeler/core/feature.hpp"
#include "feeler/core/feature_incidence.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/closest_on_segment.hpp"
#include "feeler/recognition/constraint_plane.hpp"
#include "feeler/recognition/contact_witness.hpp"
#include "feeler/recognition/principal_contact.hpp"
#include "feeler/recognition/surface_features.hpp"
#include "feeler/recognition/witness_search.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// A feature of a tool and one of an object that touch, and where they do.
template <RealScalar Scalar>
struct TouchingFeatures {
  Feature tool;
  Feature object;
  typename ContactWitnesses<Scalar>::Set witnesses;
};

/// Measures features that touch at the pose of a search. Refers to all that it is given.
template <ConvexTool Tool, RealScalar MeshScalar>
class ContactMeasures {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  using Contact = PrincipalContact<Scalar>;
  using Features = TouchingFeatures<Scalar>;

  /// @param search     after its `find`
  /// @param witnesses  that it found
  /// @param tolerance  distance up to which features touch [m]
  ContactMeasures(const SurfaceFeatures<MeshScalar>& surface, const WitnessSearch<Tool, MeshScalar>& search, const FeatureIncidence& tool_incidence,
                  const ContactWitnesses<Scalar>& witnesses, Scalar tolerance) noexcept
      : surface_(surface), search_(search), tool_incidence_(tool_incidence), witnesses_(witnesses), tolerance_(tolerance) {}

  /// The contact but for its region.
  Contact contact_of(const Features& touching) const noexcept {
    const SurfaceSide side = side_at(touching);
    const Vector point = mean_point(touching.witnesses);
    const Convexity shape = surface_.convexity(touching.object, side);
    Contact contact;
    contact.tool = touching.tool;
    contact.object = touching.object;
    contact.type = principal_contact_type(touching.tool.kind, touching.object.kind, shape);
    // A cell that the table leaves out got the type of a smaller tool feature.
    if (contact.type == PrincipalContactType::edge_concave_edge) contact.tool = smaller(touching, FeatureKind::edge);
    if (contact.type == PrincipalContactType::vertex_concave_vertex) contact.tool = smaller(touching, FeatureKind::vertex);
    contact.point_world = point + search_.origin();
    contact.normal_world = normal_of(touching, side, shape);
    contact.gap = gap_of(touching, side, shape, contact.normal_world);
    return contact;
  }

  /// The side of the object's feature that the tool is on.
  SurfaceSide side_at(const Features& touching) const noexcept {
    const Vector point = mean_point(touching.witnesses);
    return side_of_tool<MeshScalar>(surface_, touching.object, MeshScalar(tolerance_ / 100), [&](const auto& visit) {
      for (int i = 0; i < search_.tool().vertex_count(); ++i) visit(Vector3<MeshScalar>((search_.vertex(i) - point).template cast<MeshScalar>()));
    });
  }

 private:
  using Witness = ContactWitness<Scalar>;
  using Set = typename ContactWitnesses<Scalar>::Set;

  Vector mean_point(const Set& set) const noexcept {
    Vector sum = Vector::Zero();
    int count = 0;
    witnesses_.for_each(set, [&](const Witness& w) {
      sum += w.on_object;
      ++count;
    });
    return sum / Scalar((std::max)(count, 1));
  }

  /// The vertex or edge of a tool feature nearest to the middle of where it touches.
  Feature smaller(const Features& touching, FeatureKind kind) const noexcept {
    if (touching.tool.kind == kind) return touching.tool;
    const Vector point = mean_point(touching.witnesses);
    Feature best = touching.tool;
    Scalar least = std::numeric_limits<Scalar>::infinity();
    const auto consider = [&](int index, const Vector& closest) {
      const Feature feature{kind, index};
      const Scalar distance_squared = (closest - point).squaredNorm();
      if (!tool_incidence_.contains(touching.tool, feature) || !(distance_squared < least)) return;
      least = distance_squared;
      best = feature;
    };
    const Tool& tool = search_.tool();
    if (kind == FeatureKind::vertex)
      for (int i = 0; i < tool.vertex_count(); ++i) consider(i, search_.vertex(i));
    else
      for (int e = 0; e < tool.edge_count(); ++e)
        consider(e, closest_on_segment<Scalar>(point, search_.vertex(tool.edge(e).start), search_.vertex(tool.edge(e).end)));
    return best;
  }

  /// Unit normal from the object to the tool: of the face that takes part, the object's first; of two edges by eq. 7; in a valley the sum
  /// of its faces' normals; else along the line of closest points, or, where they coincide, the sum of the normals of the faces around.
  Vector normal_of(const Features& touching, SurfaceSide side, Convexity shape) const noexcept {
    const auto wide = [](const auto& v) { return Vector(v.template cast<Scalar>()); };
    if (touching.object.kind == FeatureKind::face) return wide(face_plane(surface_, touching.object.index, side).normal);
    if (touching.tool.kind == FeatureKind::face) return -search_.face_normal(touching.tool.index);
    Vector sum = Vector::Zero();
    for (const auto& plane : planes_around(surface_, touching.object, side)) sum += wide(plane.normal);
    if (shape == Convexity::concave && !sum.isZero()) return sum.normalized();
    Vector between = Vector::Zero(), away = Vector::Zero();
    const Vector point = mean_point(touching.witnesses);
    witnesses_.for_each(touching.witnesses, [&](const Witness& w) { between += w.on_tool - w.on_object; });
    for (int i = 0; i < search_.tool().vertex_count(); ++i) away += search_.vertex(i) - point;
    if (touching.tool.kind == FeatureKind::edge && touching.object.kind == FeatureKind::edge) {
      const auto& edge = surface_.edge(touching.object.index);
      const auto ends = search_.tool().edge(touching.tool.index);
      const Vector along_object = wide(Vector3<MeshScalar>(edge.end - edge.start)).normalized();
      const Vector along_tool = (search_.vertex(ends.end) - search_.vertex(ends.start)).normalized();
      // A segment has no bulk beside its edge: then the outside of the ridge tells the side.
      const Vector toward = has_bulk() ? away : sum.isZero() ? between : sum;
      if (along_object.cross(along_tool).norm() > Scalar(1e-6)) return edge_edge_plane(along_object, along_tool, point, toward).normal;
    }
    if (between.norm() > tolerance_ / 1000) return between.normalized();
    if (sum.norm() > Scalar(1e-6)) return sum.normalized();
    return away.norm() > Scalar(0) ? Vector(away.normalized()) : Vector(Vector::UnitZ());
  }
  bool has_bulk() const noexcept { return search_.tool().face_count() > 0; }

  /// Least height of the witnesses: over the planes that meet in a valley, along the normal where a face or two edges define it, else the
  /// distance.
  Scalar gap_of(const Features& touching, SurfaceSide side, Convexity shape, const Vector& normal) const noexcept {
    Scalar least = std::numeric_limits<Scalar>::infinity();
    const bool is_face = touching.tool.kind == FeatureKind::face || touching.object.kind == FeatureKind::face;
    const bool is_edges = touching.tool.kind == FeatureKind::edge && touching.object.kind == FeatureKind::edge;
    witnesses_.for_each(touching.witnesses, [&](const Witness& w) {
      if (is_face || is_edges) {
        least = (std::min)(least, normal.dot(w.on_tool - w.on_object));
      } else if (shape != Convexity::concave) {
        least = (std::min)(least, (w.on_tool - w.on_object).norm());
      }
      if (shape != Convexity::concave || is_face) return;
      for (const auto& plane : planes_around(surface_, touching.object, side))
        least = (std::min)(least, Scalar(plane.normal.template cast<Scalar>().dot(w.on_tool - search_.local(plane.point))));
    });
    return least;
  }

  const SurfaceFeatures<MeshScalar>& surface_;
  const WitnessSearch<Tool, MeshScalar>& search_;
  const FeatureIncidence& tool_incidence_;
  const ContactWitnesses<Scalar>& witnesses_;
  Scalar tolerance_;
};

}  // namespace feeler
