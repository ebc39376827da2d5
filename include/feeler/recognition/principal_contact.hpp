// Principal contacts: the twelve ways in which features of a convex tool and of an object touch (paper, Table 1).
#pragma once

#include "feeler/core/feature.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/mesh_topology.hpp"

namespace feeler {

/// Types of principal contacts, tool feature first, with the numbers of Table 1.
enum class PrincipalContactType : unsigned char {
  vertex_face = 1,  ///< V-F
  edge_convex_edge = 2,  ///< E-E; crossing or parallel
  vertex_concave_edge = 3,
  vertex_concave_vertex = 4,
  edge_concave_edge = 5,
  edge_face = 6,  ///< left blank in the table; the text counts it as a combination of V-F
  face_face = 7,
  vertex_convex_edge = 8,
  vertex_convex_vertex = 9,
  edge_convex_vertex = 10,
  face_convex_vertex = 11,  ///< F-V
  face_convex_edge = 12,
};

/// How the paper makes constraints of a type (section III.A).
enum class PrincipalContactClass : unsigned char {
  single,       ///< V-F and E-E: one plane, eq. 6 or 7
  combination,  ///< several planes at once, eq. 8, or several V-F or F-V contacts
  degenerate,   ///< the normal is not defined by the features
};

/// The type of a tool feature on an object feature: Table 1, whose rows are the tool.
///
/// A mixed vertex, where ridges and valleys meet, counts as concave for a tool vertex, which its valleys can hold, and as convex for
/// edges and faces, which only its ridges can reach. A tool edge cannot touch a concave vertex, nor a tool face a concave edge or vertex
/// ("----"): what tolerance makes of them gets the type of the next row up whose cell is not empty.
/// @param shape  of the object feature, seen from the tool's side; of faces it is not read
constexpr PrincipalContactType principal_contact_type(FeatureKind tool, FeatureKind object, Convexity shape) noexcept {
  using enum PrincipalContactType;
  const bool is_concave = shape == Convexity::concave || (shape == Convexity::mixed && tool == FeatureKind::vertex);
  constexpr PrincipalContactType table[3][5] = {      // V convex, V concave, E convex, E concave, F
                                                {vertex_convex_vertex, vertex_concave_vertex, vertex_convex_edge, vertex_concave_edge, vertex_face},
                                                {edge_convex_vertex, vertex_concave_vertex, edge_convex_edge, edge_concave_edge, edge_face},
                                                {face_convex_vertex, vertex_concave_vertex, face_convex_edge, edge_concave_edge, face_face}};
  const int column = object == FeatureKind::face ? 4 : (object == FeatureKind::edge ? 2 : 0) + (is_concave ? 1 : 0);
  return table[static_cast<int>(tool)][column];
}

constexpr PrincipalContactClass principal_contact_class(PrincipalContactType type) noexcept {
  using enum PrincipalContactType;
  switch (type) {
    case vertex_face:
    case edge_convex_edge: return PrincipalContactClass::single;
    case vertex_convex_edge:
    case vertex_convex_vertex:
    case edge_convex_vertex: return PrincipalContactClass::degenerate;
    default: return PrincipalContactClass::combination;
  }
}

/// The number in Table 1, 1 to 12.
constexpr int number_of(PrincipalContactType type) noexcept { return static_cast<int>(type); }

constexpr const char* to_string(PrincipalContactType type) noexcept {
  using enum PrincipalContactType;
  switch (type) {
    case vertex_face: return "vertex on face";
    case edge_convex_edge: return "edge on convex edge";
    case vertex_concave_edge: return "vertex in concave edge";
    case vertex_concave_vertex: return "vertex in concave vertex";
    case edge_concave_edge: return "edge in concave edge";
    case edge_face: return "edge on face";
    case face_face: return "face on face";
    case vertex_convex_edge: return "vertex on convex edge";
    case vertex_convex_vertex: return "vertex on convex vertex";
    case edge_convex_vertex: return "edge on convex vertex";
    case face_convex_vertex: return "face on convex vertex";
    case face_convex_edge: return "face on convex edge";
  }
  return "unknown type";
}

constexpr const char* to_string(PrincipalContactClass kind) noexcept {
  switch (kind) {
    case PrincipalContactClass::single: return "single";
    case PrincipalContactClass::combination: return "combination";
    case PrincipalContactClass::degenerate: return "degenerate";
  }
  return "unknown class";
}

/// A pair of touching features that is no part of a larger one: a principal contact (J. Xiao and X. Ji, Int. J. Robotics Research 20,
/// 2001).
template <class ScalarType>
struct PrincipalContact {
  using Scalar = ScalarType;

  PrincipalContactType type = PrincipalContactType::vertex_face;
  Feature tool;    ///< number among the tool's vertices, edges or faces
  Feature object;  ///< number among those of `SurfaceFeatures`
  Vector3<Scalar> point_world = Vector3<Scalar>::Zero();   ///< on the object, amid the places found to touch [m]
  Vector3<Scalar> normal_world = Vector3<Scalar>::UnitZ(); ///< unit, from the object to the tool
  Scalar gap = Scalar(0);  ///< of the nearest place; negative where the features overlap [m]
  int region = 0;          ///< number of the connected place of touching, in the order of the formation

  bool has_features_of(const PrincipalContact& other) const noexcept { return tool == other.tool && object == other.object; }
};

}  // namespace feeler
