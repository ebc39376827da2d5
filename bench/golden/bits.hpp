// One number for many: a hash over the bits of whatever is fed to it.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>

namespace feeler::bench {

/// FNV-1a of 64 bits over numbers, eight bytes each, the lowest first whatever the machine.
class BitHash {
 public:
  /// Both zeros count as one: which of them a sum ends at is no part of a trajectory, and rewriting a − b as
  /// −(b − a) changes it.
  void add(std::floating_point auto value) noexcept { add_word(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : double(value))); }
  void add(std::integral auto value) noexcept { add_word(std::uint64_t(value)); }
  /// All numbers of an array of Eigen's.
  template <class Numbers>
    requires requires(const Numbers& numbers) { numbers.reshaped(); }
  void add(const Numbers& numbers) noexcept {
    for (const auto value : numbers.reshaped()) add(value);
  }

  std::uint64_t value() const noexcept { return hash_; }

 private:
  void add_word(std::uint64_t word) noexcept {
    for (int byte = 0; byte < 8; ++byte, word >>= 8) hash_ = (hash_ ^ (word & 0xff)) * 0x100000001b3U;
  }

  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace feeler::bench
