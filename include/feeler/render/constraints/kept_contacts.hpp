// The contacts at the start of a motion that must hold until its end.
#pragma once

#include <algorithm>

#include "feeler/contact/contact_row.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// Rows of the pairs that touch where a motion begins.
///
/// A motion is linearised again where its first step ends, and there other features are closest: a point that has slid over a ridge knows
/// the far side alone. The chord to a point on that side runs through the ridge, and would be blocked at once. So the rows of the start are
/// carried along, and kept where a motion would break them: the tool leaves the ridge along the tangent, and comes down in the next iteration.
template <class Row, int capacity>
class KeptContacts {
 public:
  using Scalar = typename Row::Scalar;

  void clear() noexcept { contacts_.clear(); }
  /// @param row            at the start of the motion
  /// @param required_gap  `StepProblem::Standing::required_gap` of it [m]
  void add(const Row& row, Scalar required_gap) noexcept { contacts_.push_back({row, required_gap, false}); }

  /// Before another linearisation: no row is in the problem.
  void release() noexcept {
    for (Contact& contact : contacts_) contact.is_in_problem = false;
  }
  /// Adds to a problem, linearised where the motion has come `so_far()`, the rows that the `whole` motion would break; false if it breaks none.
  template <class Problem, class SoFar>
  bool keep_broken(const SoFar& so_far, const Displacement<Scalar>& whole, Scalar margin, Problem& problem) noexcept {
    bool breaks_any = false;
    for (Contact& contact : contacts_) {
      const Scalar enough = (std::min)(margin, contact.row.gap) / 10;
      if (contact.is_in_problem || !(carried_gap(contact.row, whole) < enough)) continue;
      contact.is_in_problem = problem.keep(contact.row.carried(so_far()), contact.required_gap);
      breaks_any = breaks_any || contact.is_in_problem;
    }
    return breaks_any;
  }

 private:
  struct Contact {
    Row row;
    Scalar required_gap;
    bool is_in_problem;
  };

  FixedVector<Contact, capacity> contacts_;
};

}  // namespace feeler
