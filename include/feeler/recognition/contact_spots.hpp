// Places of touching that are close together.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "feeler/core/scalar.hpp"
#include "feeler/recognition/contact_witness.hpp"

namespace feeler {

/// Numbers witnesses so that those close together, directly or by way of others, have one number.
template <RealScalar Scalar>
class ContactSpots {
 public:
  /// @param reach  how far apart two witnesses of one spot may be [m]
  void start(const ContactWitnesses<Scalar>& witnesses, Scalar reach) noexcept {
    count_ = witnesses.size();
    for (int i = 0; i < count_; ++i) spots_[std::size_t(i)] = i;
    for (int i = 0; i < count_; ++i)
      for (int j = 0; j < i; ++j)
        if ((witnesses[i].on_object - witnesses[j].on_object).squaredNorm() <= reach * reach) join(i, j);
  }
  /// Makes one spot of the witnesses of a contact.
  void join(const typename ContactWitnesses<Scalar>::Set& contact) noexcept {
    int first = -1;
    for (int i = 0; i < count_; ++i) {
      if (!contact[std::size_t(i)]) continue;
      if (first >= 0) join(first, i);
      first = i;
    }
  }
  /// The number of a witness's spot: that of its first witness.
  int of(int witness) const noexcept {
    while (spots_[std::size_t(witness)] != witness) witness = spots_[std::size_t(witness)];
    return witness;
  }

 private:
  void join(int a, int b) noexcept {
    const int first = of(a), second = of(b);
    spots_[std::size_t((std::max)(first, second))] = (std::min)(first, second);
  }

  int count_ = 0;
  std::array<int, std::size_t(ContactWitnesses<Scalar>::capacity)> spots_{};
};

}  // namespace feeler
