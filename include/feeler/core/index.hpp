// A place in a list, as the standard library counts.
#pragma once

#include <cstddef>

namespace feeler {

/// @param i  not negative
constexpr std::size_t as_index(int i) noexcept { return std::size_t(i); }

}  // namespace feeler
