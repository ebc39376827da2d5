// A number for each of some rows.
#pragma once

#include <array>
#include <cstddef>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler::detail {

/// One number for each row, read and written in groups.
template <RealScalar Scalar, int lanes, int capacity>
struct alignas(64) RowValues : std::array<Scalar, std::size_t(capacity)> {
  using Group = Lanes<Scalar, lanes>;

  Group at(int k) const noexcept { return load<Group>(&(*this)[std::size_t(k)]); }
  void set(int k, const Group& group) noexcept { store(&(*this)[std::size_t(k)], group); }
};

}  // namespace feeler::detail
