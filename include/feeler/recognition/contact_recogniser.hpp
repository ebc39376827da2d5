// Tells which features of a tool and an object touch: the contact formation of a pose.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/requirement.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/closest_on_segment.hpp"
#include "feeler/recognition/contact_formation.hpp"
#include "feeler/recognition/contact_measures.hpp"
#include "feeler/recognition/contact_spots.hpp"
#include "feeler/recognition/contact_witness.hpp"
#include "feeler/recognition/principal_contact.hpp"
#include "feeler/recognition/surface_features.hpp"
#include "feeler/recognition/witness_search.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/swept_tool.hpp"
#include "feeler/tool/tool_incidence.hpp"

namespace feeler {

/// Up to it features touch by default [m]: twice the renderer's margin, so what is at the margin from walls at right angles touches where they meet.
inline constexpr double default_contact_tolerance = 2e-6;

/// Recognises principal contacts from geometry alone, whoever found the pose.
///
/// 1. Witnesses: the smallest features within tolerance at each place of touching (`WitnessSearch`).
/// 2. Candidates: a pair of features (T, O) touches if T is the smallest feature of the tool, and O of the surface, that holds all
///    witnesses in the closures of both, and these span what T and O have in common: a line for edges on faces, an area for faces.
/// 3. Principal contacts are the candidates in the closures of no other (Xiao and Ji, 2001). But a valley stands for the faces that meet
///    in it: where a larger contact covers some of them only, the tool feature also touches the others.
/// 4. In a valley sharper than the tolerance allows for, a tool vertex or edge that touches all of its faces touches the valley.
/// 5. Regions: contacts with witnesses less than four tolerances apart are in one region.
///
/// Features smaller than the tolerance are not told apart. A tool edge or face that touches both sides of a gap between faces of one plane, or in one
/// that is not convex, touches across it.
/// @tparam Tool_, MeshScalar_  of tool and object; scalars narrower than double are widened
template <ConvexTool Tool_, RealScalar MeshScalar_ = typename Tool_::Scalar>
class ContactRecogniser {
 public:
  static_assert(!SweptTool<Tool_>, "ContactRecogniser tells features apart, and a swept tool has none on its surface: give it the core");
  using Scalar = WorkingScalar<typename Tool_::Scalar>;
  using Tool = ToolCast<Tool_, Scalar>;
  using MeshScalar = MeshScalar_;
  using Formation = ContactFormation<Scalar>;
  using Contact = PrincipalContact<Scalar>;
  using Vector = Vector3<Scalar>;

  /// Allocates. Refers to the object and its features, which must outlive it; copies the tool. Refuses a tolerance that is not positive and finite.
  /// @param tolerance  distance up to which features touch [m]
  ContactRecogniser(const TriangleMesh<MeshScalar>& object, const SurfaceFeatures<MeshScalar>& surface, const Tool_& tool,
                    Scalar tolerance = Scalar(default_contact_tolerance))
      : surface_(surface),
        search_(tool.template cast<Scalar>(), object, surface),
        tool_incidence_(incidence_of(search_.tool())),
        tolerance_(tolerance) {
    refuse_for(reason_against(object, surface, tool, tolerance));
  }
  /// The sentence with which the constructor refuses what it is given; empty where it does not.
  static std::string reason_against(const TriangleMesh<MeshScalar>&, const SurfaceFeatures<MeshScalar>&, const Tool_&,
                                    Scalar tolerance = Scalar(default_contact_tolerance)) {
    if (tolerance > Scalar(0) && tolerance < std::numeric_limits<Scalar>::infinity()) return {};
    return "ContactRecogniser: the tolerance is not a positive length; give some micrometres, such as 2e-6";
  }
  ContactRecogniser(const TriangleMesh<MeshScalar>&&, const SurfaceFeatures<MeshScalar>&, const Tool_&, Scalar = Scalar(0)) = delete;
  ContactRecogniser(const TriangleMesh<MeshScalar>&, const SurfaceFeatures<MeshScalar>&&, const Tool_&, Scalar = Scalar(0)) = delete;

  /// The principal contacts of a pose; none where it is not finite.
  /// @param world_from_tool  pose of the tool; contacts deeper than the tolerance are not found
  /// @return valid until the next call
  /// @cost   noexcept, no allocation; microseconds for a few contacts, about a millisecond where the capacities are full
  const Formation& recognise(const Pose<typename Tool_::Scalar>& world_from_tool) noexcept {
    formation_.contacts.clear();
    formation_.region_count = formation_.dropped_contacts = formation_.dropped_witnesses = formation_.dropped_triangles = 0;
    if (!world_from_tool.is_finite()) return formation_;
    search_.find(world_from_tool.template cast<Scalar>(), tolerance_, witnesses_);
    witnesses_.keep_smallest(tool_incidence_, surface_.incidence());
    formation_.dropped_witnesses = witnesses_.dropped();
    formation_.dropped_triangles = search_.dropped_triangles();
    if (witnesses_.size() == 0) return formation_;
    find_candidates();
    keep_maximal();
    restore_valleys();
    close_sharp_valleys();
    number_spots();
    write_contacts();
    return formation_;
  }

  const Formation& formation() const noexcept { return formation_; }
  Scalar tolerance() const noexcept { return tolerance_; }
  const FeatureIncidence& tool_incidence() const noexcept { return tool_incidence_; }
  const SurfaceFeatures<MeshScalar>& surface() const noexcept { return surface_; }

 private:
  using Witness = ContactWitness<Scalar>;
  using Set = typename ContactWitnesses<Scalar>::Set;
  struct Candidate : TouchingFeatures<Scalar> {
    bool touches = false;  // false for a pair that only leads to larger ones
  };
  static constexpr int candidate_capacity = 256;
  using Candidates = FixedVector<Candidate, candidate_capacity>;

  static bool same_pair(const Candidate& a, const Candidate& b) noexcept { return a.tool == b.tool && a.object == b.object; }
  /// Whether `smaller` is another candidate in the closures of `larger`.
  bool is_part_of(const Candidate& smaller, const Candidate& larger) const noexcept {
    return !same_pair(smaller, larger) && tool_incidence_.contains(larger.tool, smaller.tool) &&
           surface_.incidence().contains(larger.object, smaller.object);
  }
  static bool has(const Candidates& list, const Feature& tool, const Feature& object) noexcept {
    return std::any_of(list.begin(), list.end(), [&](const Candidate& c) { return c.tool == tool && c.object == object; });
  }

  void add_candidate(const Feature& tool, const Feature& object, bool is_witness) noexcept {
    if (has(candidates_, tool, object)) return;
    Candidate candidate{{tool, object, witnesses_.within(tool_incidence_, tool, surface_.incidence(), object)}, true};
    if (!is_witness) {
      const bool is_area = tool.kind == FeatureKind::face && object.kind == FeatureKind::face;
      candidate.touches = witnesses_.dimension(candidate.witnesses, 2 * tolerance_) >= (is_area ? 2 : 1);
    }
    if (!candidates_.push_back(candidate)) ++formation_.dropped_contacts;
  }

  /// The witnesses and their joins, over and over.
  void find_candidates() noexcept {
    candidates_.clear();
    for (int i = 0; i < witnesses_.size(); ++i) add_candidate(witnesses_[i].tool, witnesses_[i].object, true);
    for (int c = 0; c < candidates_.size(); ++c) {
      const Candidate base = candidates_[c];
      for (int i = 0; i < witnesses_.size(); ++i) {
        if (base.witnesses[std::size_t(i)]) continue;
        const FeatureJoin objects = surface_.incidence().join(base.object, witnesses_[i].object);
        if (objects.empty()) continue;  // the rule, far apart
        for (const Feature& tool : tool_incidence_.join(base.tool, witnesses_[i].tool))
          for (const Feature& object : objects) add_candidate(tool, object, false);
      }
    }
  }

  void keep_maximal() noexcept {
    parts_.clear();
    contacts_.clear();
    for (const Candidate& candidate : candidates_) {
      if (!candidate.touches) continue;
      const bool is_part =
          std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& other) { return other.touches && is_part_of(candidate, other); });
      (is_part ? parts_ : contacts_).push_back(candidate);
    }
  }

  /// Adds what larger contacts leave of valleys: contacts with the faces, or smaller valleys, that they do not cover.
  void restore_valleys() noexcept {
    rest_.clear();
    for (const Candidate& part : parts_) {
      if (part.object.kind == FeatureKind::face) continue;
      for_each_valley(part.object, measures().side_at(part), [&](int valley) { restore_uncovered(part, valley); });
    }
    for (const Candidate& extra : rest_) {
      const auto is_larger = [&](const Candidate& other) { return is_part_of(extra, other); };
      if (std::any_of(contacts_.begin(), contacts_.end(), is_larger) || std::any_of(rest_.begin(), rest_.end(), is_larger)) continue;
      if (!contacts_.push_back(extra)) ++formation_.dropped_contacts;
    }
  }

  /// Adds the contact of a part with what no larger contact covers of a valley: the valley, or one of its faces.
  void restore_uncovered(const Candidate& part, int valley) noexcept {
    const auto faces = surface_.incidence().edge_faces(valley);
    const bool first = is_covered(part.tool, faces[0]), second = is_covered(part.tool, faces[1]);
    if (first && second) return;
    const Feature object = first    ? Feature{FeatureKind::face, faces[1]}
                           : second ? Feature{FeatureKind::face, faces[0]}
                                    : Feature{FeatureKind::edge, valley};
    if (has(contacts_, part.tool, object) || has(rest_, part.tool, object)) return;
    if (!rest_.push_back({{part.tool, object, part.witnesses}, true})) ++formation_.dropped_contacts;
  }

  template <class Visit>
  void for_each_valley(const Feature& object, SurfaceSide side, const Visit& visit) const noexcept {
    const auto visit_if = [&](int edge) {
      if (surface_.convexity({FeatureKind::edge, edge}, side) == Convexity::concave && surface_.incidence().edge_faces(edge).size() == 2) visit(edge);
    };
    if (object.kind == FeatureKind::edge) visit_if(object.index);
    if (object.kind == FeatureKind::vertex)
      for (const int edge : surface_.incidence().vertex_edges(object.index)) visit_if(edge);
  }

  /// Whether a contact of a larger tool feature, or of this one, is with a face or with a valley of it.
  bool is_covered(const Feature& tool, int face) const noexcept {
    return std::any_of(contacts_.begin(), contacts_.end(), [&](const Candidate& contact) {
      if (!tool_incidence_.contains(contact.tool, tool)) return false;
      if (contact.object.kind == FeatureKind::face) return contact.object.index == face;
      const bool is_beside = surface_.incidence().contains({FeatureKind::face, face}, contact.object);
      return is_beside && surface_.convexity(contact.object, measures().side_at(contact)) == Convexity::concave;
    });
  }

  /// Puts one contact with a valley in place of contacts with all of its faces.
  void close_sharp_valleys() noexcept {
    while (close_sharp_valley()) {}
  }
  /// False where there is none.
  bool close_sharp_valley() noexcept {
    for (int i = 0; i < contacts_.size(); ++i) {
      if (contacts_[i].tool.kind == FeatureKind::face) continue;
      for (int j = i + 1; j < contacts_.size(); ++j) {
        if (contacts_[i].tool != contacts_[j].tool) continue;
        const std::optional<Feature> valley = valley_between(contacts_[i], contacts_[j]);
        if (!valley) continue;
        contacts_[i].object = *valley;
        contacts_[i].witnesses |= contacts_[j].witnesses;
        contacts_.swap_remove(j);
        return true;
      }
    }
    return false;
  }

  /// Whether a contact touches within ten tolerances of an edge or a vertex of the surface.
  bool touches_near(const Feature& feature, const Candidate& contact) const noexcept {
    bool found = false;
    witnesses_.for_each(contact.witnesses, [&](const Witness& w) {
      Vector closest;
      if (feature.kind == FeatureKind::vertex) {
        closest = search_.local(surface_.vertex(feature.index).point);
      } else {
        const auto& edge = surface_.edge(feature.index);
        closest = closest_on_segment<Scalar>(w.on_tool, search_.local(edge.start), search_.local(edge.end));
      }
      found = found || (w.on_tool - closest).squaredNorm() <= Scalar(100) * tolerance_ * tolerance_;
    });
    return found;
  }

  /// What is concave and near a place of touching: the edge between two faces, or the vertex between a face and an edge or between two edges.
  std::optional<Feature> valley_between(const Candidate& a, const Candidate& b) const noexcept {
    const FeatureIncidence& incidence = surface_.incidence();
    const SurfaceSide side = measures().side_at(a.object.kind == FeatureKind::face ? a : b);
    const auto is_near = [&](const Feature& feature) { return surface_.convexity(feature, side) == Convexity::concave && touches_near(feature, a); };
    if (a.object.kind == FeatureKind::face && b.object.kind == FeatureKind::face) {
      const auto first = incidence.face_edges(a.object.index), second = incidence.face_edges(b.object.index);
      for (const int edge : first.size() < second.size() ? first : second) {
        const Feature valley{FeatureKind::edge, edge};
        if (incidence.contains(a.object, valley) && incidence.contains(b.object, valley) && is_near(valley)) return valley;
      }
      return {};
    }
    if (a.object.kind == FeatureKind::vertex || b.object.kind == FeatureKind::vertex || a.tool.kind != FeatureKind::vertex) return {};
    const Feature& edge = a.object.kind == FeatureKind::edge ? a.object : b.object;
    const Feature& other = a.object.kind == FeatureKind::edge ? b.object : a.object;
    for (const int vertex : incidence.edge_vertices(edge.index)) {
      const Feature valley{FeatureKind::vertex, vertex};
      if (incidence.contains(other, valley) && incidence.vertex_faces(vertex).size() == 3 && is_near(valley)) return valley;
    }
    return {};
  }

  void number_spots() noexcept {
    spots_.start(witnesses_, 4 * tolerance_);
    for (const Candidate& contact : contacts_) spots_.join(contact.witnesses);
  }

  void write_contacts() noexcept {
    const auto measures = this->measures();
    for (const Candidate& candidate : contacts_) {
      Contact contact = measures.contact_of(candidate);
      int first = 0;
      while (!candidate.witnesses[std::size_t(first)]) ++first;
      contact.region = spots_.of(first);
      const bool is_known = std::any_of(formation_.begin(), formation_.end(), [&](const Contact& c) { return c.has_features_of(contact); });
      if (!is_known && !formation_.contacts.push_back(contact)) ++formation_.dropped_contacts;
    }
    formation_.sort();
    std::array<int, Formation::capacity> known{};
    for (Contact& contact : formation_.contacts) {
      int number = 0;
      while (number < formation_.region_count && known[std::size_t(number)] != contact.region) ++number;
      if (number == formation_.region_count) known[std::size_t(formation_.region_count++)] = contact.region;
      contact.region = number;
    }
  }

  ContactMeasures<Tool, MeshScalar> measures() const noexcept { return {surface_, search_, tool_incidence_, witnesses_, tolerance_}; }

  const SurfaceFeatures<MeshScalar>& surface_;
  WitnessSearch<Tool, MeshScalar> search_;
  FeatureIncidence tool_incidence_;
  Scalar tolerance_;

  ContactWitnesses<Scalar> witnesses_;
  Candidates candidates_, contacts_, parts_, rest_;
  ContactSpots<Scalar> spots_;
  Formation formation_;
};

}  // namespace feeler
