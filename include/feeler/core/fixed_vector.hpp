// A list with room for a fixed number of elements and no heap.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace feeler {

namespace detail {

/// Room for elements, none of which is made before it is in use.
template <class T, int Capacity>
union UnmadeElements {
  UnmadeElements() noexcept {}
  std::array<T, std::size_t(Capacity)> elements;
};

/// Those that must be destroyed are all made at once.
template <class T, int Capacity>
struct MadeElements {
  std::array<T, std::size_t(Capacity)> elements{};
};

}  // namespace detail

/// A list of at most `Capacity` elements, stored in place. A list costs what is in it: making one makes no element, and copying copies the elements
/// in use only.
template <class T, int Capacity>
class FixedVector {
  static constexpr bool is_made_in_use = std::is_trivially_destructible_v<T>;

 public:
  using value_type = T;

  FixedVector() noexcept = default;
  FixedVector(const FixedVector& other) noexcept { *this = other; }
  FixedVector& operator=(const FixedVector& other) noexcept {
    if (this == &other) return *this;
    size_ = other.size_;
    for (int i = 0; i < size_; ++i) put(i, other[i]);
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
    put(size_++, element);
    return true;
  }
  /// Removes element `i` in constant time; the last element takes its place.
  void swap_remove(int i) noexcept {
    if (i != size_ - 1) (*this)[i] = back();
    pop_back();
  }
  void pop_back() noexcept {
    assert(size_ > 0);
    --size_;
  }

  T& operator[](int i) noexcept { return store_.elements[place(i)]; }
  const T& operator[](int i) const noexcept { return store_.elements[place(i)]; }
  T& back() noexcept { return (*this)[size_ - 1]; }
  const T& back() const noexcept { return (*this)[size_ - 1]; }
  T* begin() noexcept { return store_.elements.data(); }
  T* end() noexcept { return begin() + size_; }
  const T* begin() const noexcept { return store_.elements.data(); }
  const T* end() const noexcept { return begin() + size_; }

 private:
  std::size_t place(int i) const noexcept {
    assert(i >= 0 && i < size_);
    return std::size_t(i);
  }
  void put(int i, const T& element) noexcept {
    if constexpr (is_made_in_use) {
      std::construct_at(&store_.elements[std::size_t(i)], element);
    } else {
      store_.elements[std::size_t(i)] = element;
    }
  }

  int size_ = 0;
  std::conditional_t<is_made_in_use, detail::UnmadeElements<T, Capacity>, detail::MadeElements<T, Capacity>> store_;
};

}  // namespace feeler
