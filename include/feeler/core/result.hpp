// A value or the reason why there is none, for programs that must neither throw nor abort.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "feeler/core/requirement.hpp"

namespace feeler {

/// What came of making a value: it, or a sentence that says what was wrong, where, and what to do.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  template <class... Arguments>
  explicit Result(std::in_place_t, Arguments&&... arguments) : value_(std::in_place, std::forward<Arguments>(arguments)...) {}
  static Result refused(std::string reason) { return Result(Refused(), std::move(reason)); }

  explicit operator bool() const noexcept { return value_.has_value(); }
  /// Empty where there is a value.
  const std::string& reason() const noexcept { return reason_; }

  /// The value; only where there is one.
  T& operator*() noexcept { return *value_; }
  const T& operator*() const noexcept { return *value_; }
  T* operator->() noexcept { return &*value_; }
  const T* operator->() const noexcept { return &*value_; }
  /// The value; refuses for the reason where there is none.
  T value() && {
    refuse_for(reason_);
    return *std::move(value_);
  }

 private:
  struct Refused {};
  Result(Refused, std::string reason) : reason_(std::move(reason)) {}

  std::optional<T> value_;
  std::string reason_;
};

/// Makes a T as its constructor does of the same arguments, and where that would refuse them returns the reason: nothing is thrown, nothing aborted.
///
/// For whatever refuses by a constructor, in the device module too; `ConvexPolytope::try_hull_of`, `CompoundTool::try_hulls_of`, `try_cylinder` and
/// `try_cone` make hulls. Memory that runs out is still an exception.
/// @tparam T  has a static `reason_against`
template <class T, class... Arguments>
Result<T> try_make(Arguments&&... arguments) {
  std::string reason = T::reason_against(std::as_const(arguments)...);
  if (!reason.empty()) return Result<T>::refused(std::move(reason));
  return Result<T>(std::in_place, std::forward<Arguments>(arguments)...);
}

}  // namespace feeler
