// A value that lives on the heap.
#pragma once

#include <memory>
#include <utility>

namespace feeler {

/// Keeps a large object off the stack. It is copied with its value; one that was moved from can only be assigned to or destroyed.
/// @cost  allocates when made and copied, and never after
template <class T>
class OnHeap {
 public:
  template <class... Arguments>
  explicit OnHeap(std::in_place_t, Arguments&&... arguments) : value_(std::make_unique<T>(std::forward<Arguments>(arguments)...)) {}
  OnHeap(const OnHeap& other) : value_(std::make_unique<T>(*other)) {}
  OnHeap(OnHeap&&) noexcept = default;
  OnHeap& operator=(const OnHeap& other) { return *this = OnHeap(other); }
  OnHeap& operator=(OnHeap&&) noexcept = default;
  ~OnHeap() = default;

  T& operator*() noexcept { return *value_; }
  const T& operator*() const noexcept { return *value_; }
  T* operator->() noexcept { return value_.get(); }
  const T* operator->() const noexcept { return value_.get(); }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace feeler
