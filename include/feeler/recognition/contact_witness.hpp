// The places where a tool and an object touch: pairs of features, at least one of them a vertex or both of them edges.
#pragma once

#include <bitset>

#include "feeler/core/feature.hpp"
#include "feeler/core/feature_incidence.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler {

/// A place of touching, between the smallest features that are within tolerance there.
template <class Scalar>
struct ContactWitness {
  Feature tool;
  Feature object;
  Vector3<Scalar> on_tool = Vector3<Scalar>::Zero();
  Vector3<Scalar> on_object = Vector3<Scalar>::Zero();
};

/// The witnesses of a pose. Contacts between faces and edges follow from them: the ends of the place where two features touch are
/// witnesses.
template <class Scalar>
class ContactWitnesses {
 public:
  static constexpr int capacity = 128;
  using Witness = ContactWitness<Scalar>;
  using Set = std::bitset<std::size_t(capacity)>;

  int size() const noexcept { return witnesses_.size(); }
  const Witness& operator[](int i) const noexcept { return witnesses_[i]; }
  int dropped() const noexcept { return dropped_; }
  void clear() noexcept {
    witnesses_.clear();
    dropped_ = 0;
  }

  /// Adds a place, unless one of the same features is known.
  void add(const Witness& witness) noexcept {
    for (const Witness& known : witnesses_)
      if (known.tool == witness.tool && known.object == witness.object) return;
    if (!witnesses_.push_back(witness)) ++dropped_;
  }

  /// Removes what is explained by a smaller feature: a vertex near an edge is also near the faces beside it.
  void keep_smallest(const FeatureIncidence& tool, const FeatureIncidence& object) noexcept {
    for (int i = witnesses_.size() - 1; i >= 0; --i) {
      const Witness& larger = witnesses_[i];
      const auto explains = [&](const Witness& smaller) {
        if (smaller.tool == larger.tool && smaller.object == larger.object) return false;
        const bool at_tool_vertex = larger.tool.kind == FeatureKind::vertex && smaller.tool == larger.tool;
        const bool at_object_vertex = larger.object.kind == FeatureKind::vertex && smaller.object == larger.object;
        return (at_tool_vertex && object.contains(larger.object, smaller.object)) || (at_object_vertex && tool.contains(larger.tool, smaller.tool));
      };
      for (const Witness& smaller : witnesses_) {
        if (!explains(smaller)) continue;
        witnesses_.swap_remove(i);
        break;
      }
    }
  }

  /// The witnesses whose features are in the closures of two features.
  Set within(const FeatureIncidence& tool, const Feature& tool_feature, const FeatureIncidence& object,
             const Feature& object_feature) const noexcept {
    Set set;
    for (int i = 0; i < size(); ++i)
      if (tool.contains(tool_feature, witnesses_[i].tool) && object.contains(object_feature, witnesses_[i].object)) set.set(std::size_t(i));
    return set;
  }

  /// How many dimensions a set spans on the object by more than `least` [m]: 0, 1 or 2.
  int dimension(const Set& set, Scalar least) const noexcept {
    int first = 0;
    while (first < size() && !set[std::size_t(first)]) ++first;
    if (first == size()) return 0;
    const Vector3<Scalar> origin = witnesses_[first].on_object;
    Vector3<Scalar> longest = Vector3<Scalar>::Zero();
    for_each(set, [&](const Witness& w) {
      const Vector3<Scalar> along = w.on_object - origin;
      if (along.squaredNorm() > longest.squaredNorm()) longest = along;
    });
    const Scalar length = longest.norm();
    if (!(length > least)) return 0;
    Scalar width = Scalar(0);
    for_each(set, [&](const Witness& w) { width = (std::max)(width, Vector3<Scalar>(w.on_object - origin).cross(longest).norm() / length); });
    return width > least ? 2 : 1;
  }

  template <class Visit>
  void for_each(const Set& set, const Visit& visit) const noexcept {
    for (int i = 0; i < size(); ++i)
      if (set[std::size_t(i)]) visit(witnesses_[i]);
  }

 private:
  FixedVector<Witness, capacity> witnesses_;
  int dropped_ = 0;
};

}  // namespace feeler
