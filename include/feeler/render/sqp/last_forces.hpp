// The contacts that held the tool when a step was last solved for, with their forces: the next problem is likely to have them too.
#pragma once

#include <algorithm>
#include <limits>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// Multipliers by contact, from one linearisation to the next: rows are measured anew, in any order.
/// @tparam Row  a `ContactRow`
template <class Row>
class LastForces {
 public:
  using Scalar = typename Row::Scalar;
  using Active = decltype(QpSolution<Scalar>::active);

  void clear() noexcept { contacts_.clear(); }
  bool empty() const noexcept { return contacts_.empty(); }

  /// @param rows  of the problem solved
  template <class Rows>
  void remember(const Active& active, const Rows& rows) noexcept {
    contacts_.clear();
    for (const auto& held : active) {
      const Row& row = rows[held.row];
      contacts_.push_back({row.piece, row.normal, row.arm, held.multiplier});
    }
  }

  /// The rows of a problem that are most like the contacts, whatever triangle they are of; false where two are most like the same.
  template <class Rows>
  bool find(const Rows& rows, Active& active) const noexcept {
    active.clear();
    for (const Contact& contact : contacts_) {
      int nearest = -1;
      Scalar least(0);
      for (int k = 0; k < rows.size(); ++k) {
        if (rows[k].piece != contact.piece) continue;
        const Scalar distance = contact.squared_distance(rows[k]);
        if (nearest >= 0 && !(distance < least)) continue;
        nearest = k;
        least = distance;
      }
      if (nearest < 0 || std::any_of(active.begin(), active.end(), [nearest](const auto& other) { return other.row == nearest; })) return false;
      active.push_back({nearest, contact.multiplier});
    }
    return true;
  }

 private:
  struct Contact {
    int piece;
    Vector3<Scalar> normal, arm;
    Scalar multiplier;

    /// Of its place and, on the scale of the arm if there is one, of its direction [m²].
    Scalar squared_distance(const Row& row) const noexcept {
      const Scalar scale = arm.squaredNorm() + (std::numeric_limits<Scalar>::min)();
      return (row.arm - arm).squaredNorm() + scale * (row.normal - normal).squaredNorm();
    }
  };

  FixedVector<Contact, QpSolution<Scalar>::active_capacity> contacts_;
};

}  // namespace feeler
