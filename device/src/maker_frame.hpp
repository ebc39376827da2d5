// The base frame that Force Dimension and Haption share: x to the user, y right, z up. Ours: x right, y up, z
// to the user.
#pragma once

#include <type_traits>

namespace feeler::maker_frame {

/// Which of the maker's axes is our axis i. A cyclic permutation, so a rotation: right-handed stays
/// right-handed.
constexpr int axis_of[3] = {1, 2, 0};

template <class From, class To>
void to_ours(const From& maker, To& ours) noexcept {
  for (int i = 0; i < 3; ++i) ours[i] = double(maker[axis_of[i]]);
}

template <class From, class To>
void to_maker(const From& ours, To& maker) noexcept {
  for (int i = 0; i < 3; ++i) maker[axis_of[i]] = static_cast<std::remove_reference_t<decltype(maker[0])>>(ours[i]);
}

/// The axes of the handle are permuted too, so that a handle at rest stays the identity.
inline void to_ours(const double (&maker)[3][3], double (&ours)[3][3]) noexcept {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) ours[i][j] = maker[axis_of[i]][axis_of[j]];
  }
}

}  // namespace feeler::maker_frame
