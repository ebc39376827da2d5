// A list with room for a fixed number of elements and no heap.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

namespace feeler {

/// A list of at most `Capacity` elements, stored in place; copying copies the elements in use only.
template <class T, int Capacity>
class FixedVector {
 public:
  using value_type = T;

  FixedVector() noexcept = default;
  FixedVector(const FixedVector& other) noexcept { *this = other; }
  FixedVector& operator=(const FixedVector& other) noexcept {
    size_ = other.size_;
    for (int i = 0; i < size_; ++i) elements_[std::size_t(i)] = other.elements_[std::size_t(i)];
    return *this;
  }

  static constexpr int capacity() noexcept { return Capacity; }
  int size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  bool full() const noexcept { return size_ == Capacity; }
  void clear() noexcept { size_ = 0; }

  /// Appends; returns false, and drops the element, when the list is full.
  bool push_back(const T& element) noexcept {
    if (full()) return false;
    elements_[std::size_t(size_++)] = element;
    return true;
  }
  /// Removes element `i` in constant time; the last element takes its place.
  void swap_remove(int i) noexcept {
    assert(i >= 0 && i < size_);
    --size_;
    if (i != size_) elements_[std::size_t(i)] = elements_[std::size_t(size_)];
  }
  void pop_back() noexcept { --size_; }

  T& operator[](int i) noexcept { return elements_[std::size_t(i)]; }
  const T& operator[](int i) const noexcept { return elements_[std::size_t(i)]; }
  T& back() noexcept { return elements_[std::size_t(size_ - 1)]; }
  const T& back() const noexcept { return elements_[std::size_t(size_ - 1)]; }
  T* begin() noexcept { return elements_.data(); }
  T* end() noexcept { return elements_.data() + size_; }
  const T* begin() const noexcept { return elements_.data(); }
  const T* end() const noexcept { return elements_.data() + size_; }

 private:
  int size_ = 0;
  std::array<T, std::size_t(Capacity)> elements_{};
};

}  // namespace feeler
