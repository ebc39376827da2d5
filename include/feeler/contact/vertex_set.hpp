// A set of tool vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace feeler {

/// Some of a tool's vertices, in the order in which they came. Room for all is taken when it is made.
/// @cost  constant time for each, and no allocation; `clear` the members
class VertexSet {
 public:
  VertexSet() = default;
  explicit VertexSet(int vertex_count) : members_(std::size_t(vertex_count)), is_member_(std::size_t(vertex_count), 0) {}

  int size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  int operator[](int i) const noexcept { return members_[std::size_t(i)]; }
  const int* begin() const noexcept { return members_.data(); }
  const int* end() const noexcept { return members_.data() + size_; }
  bool contains(int vertex) const noexcept { return is_member_[std::size_t(vertex)] != 0; }

  void add(int vertex) noexcept {
    if (contains(vertex)) return;
    is_member_[std::size_t(vertex)] = 1;
    members_[std::size_t(size_++)] = vertex;
  }
  void clear() noexcept {
    for (const int vertex : *this) is_member_[std::size_t(vertex)] = 0;
    size_ = 0;
  }

 private:
  std::vector<int> members_;
  std::vector<std::uint8_t> is_member_;  // of each vertex
  int size_ = 0;
};

}  // namespace feeler
