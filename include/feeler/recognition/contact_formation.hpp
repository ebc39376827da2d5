// Contact formations: the set of principal contacts at one moment, and the event that it changed.
#pragma once

#include <algorithm>
#include <tuple>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/recognition/principal_contact.hpp"

namespace feeler {

/// The principal contacts of a pose (paper, eq. 9), sorted by tool feature, then by object feature. A plain copyable value.
template <class ScalarType>
struct ContactFormation {
  using Scalar = ScalarType;
  using Contact = PrincipalContact<Scalar>;
  static constexpr int capacity = 32;

  FixedVector<Contact, capacity> contacts;
  int region_count = 0;
  int dropped_contacts = 0;   ///< found, but there was no room
  int dropped_witnesses = 0;  ///< places of touching that were not looked at for want of room: contacts may be missing or too small
  int dropped_triangles = 0;  ///< as above

  int size() const noexcept { return contacts.size(); }
  bool empty() const noexcept { return contacts.empty(); }
  bool is_complete() const noexcept { return dropped_contacts == 0 && dropped_witnesses == 0 && dropped_triangles == 0; }
  const Contact& operator[](int i) const noexcept { return contacts[i]; }
  const Contact* begin() const noexcept { return contacts.begin(); }
  const Contact* end() const noexcept { return contacts.end(); }

  int count(PrincipalContactType type) const noexcept {
    return int(std::count_if(begin(), end(), [type](const Contact& contact) { return contact.type == type; }));
  }

  void sort() noexcept {
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& a, const Contact& b) { return std::tie(a.tool, a.object) < std::tie(b.tool, b.object); });
  }
};

/// Whether the same features touch, whatever the regions.
template <class Scalar>
bool same_features(const ContactFormation<Scalar>& a, const ContactFormation<Scalar>& b) noexcept {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return x.has_features_of(y); });
}

/// Whether the same types occur equally often, in as many regions: what remains the same on another triangulation.
template <class Scalar>
bool same_types(const ContactFormation<Scalar>& a, const ContactFormation<Scalar>& b) noexcept {
  if (a.size() != b.size() || a.region_count != b.region_count) return false;
  for (int type = 1; type <= 12; ++type)
    if (a.count(PrincipalContactType(type)) != b.count(PrincipalContactType(type))) return false;
  return true;
}

/// A contact switch (paper, section III.C).
template <class Scalar>
struct ContactSwitch {
  ContactFormation<Scalar> before;
  ContactFormation<Scalar> after;
};

/// Tells contact switches from ticks in which only the places of contact moved. Starts without contact.
template <class Scalar>
class FormationTracker {
 public:
  /// @return the switch, valid until the next call, or null where the same features touch as before
  const ContactSwitch<Scalar>* observe(const ContactFormation<Scalar>& formation) noexcept {
    if (same_features(switch_.after, formation)) {
      switch_.after = formation;
      return nullptr;
    }
    switch_.before = switch_.after;
    switch_.after = formation;
    return &switch_;
  }
  /// The formation seen last.
  const ContactFormation<Scalar>& current() const noexcept { return switch_.after; }
  void reset() noexcept { switch_ = {}; }

 private:
  ContactSwitch<Scalar> switch_;
};

}  // namespace feeler
