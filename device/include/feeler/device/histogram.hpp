// A histogram of durations that never allocates, for tails that a mean would hide.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace feeler {

/// Counts of nanoseconds in bins that are 1 ns wide below 64 ns and at most 1/32 of their value above, up to the end of 64 bits.
class Histogram {
 public:
  static constexpr int bins = 32 * 57 + 64;

  /// Constant time, no allocation. A negative duration counts as 0.
  void add(std::int64_t nanoseconds) noexcept {
    const std::int64_t value = std::max<std::int64_t>(nanoseconds, 0);
    ++counts_[std::size_t(bin_of(value))];
    minimum_ = count_ == 0 ? value : (std::min)(minimum_, value);
    maximum_ = (std::max)(maximum_, value);
    ++count_;
  }

  std::int64_t count() const noexcept { return count_; }
  std::int64_t minimum() const noexcept { return minimum_; }  ///< exact [ns]; 0 when empty
  std::int64_t maximum() const noexcept { return maximum_; }  ///< exact [ns]; 0 when empty

  /// The smallest recorded value that at least p percent of the values do not exceed, rounded up to the end of its bin: never below
  /// the true one, and at most 1/32 above it [ns]. 0 when empty.
  /// @param p  from 0 to 100
  std::int64_t percentile(double p) const noexcept {
    const double share = std::clamp(p, 0.0, 100.0) / 100 * double(count_);
    const std::int64_t rank = std::max<std::int64_t>(std::int64_t(std::ceil(share)), 1);
    std::int64_t seen = 0;
    for (int bin = 0; bin < bins; ++bin) {
      seen += counts_[std::size_t(bin)];
      if (seen >= rank) return (std::min)(last_of(bin), maximum_);
    }
    return maximum_;
  }

  std::int64_t count_in(int bin) const noexcept { return counts_[std::size_t(bin)]; }

  /// The bin of a value [ns]; the values of bin i are last_of(i − 1) + 1 … last_of(i).
  static constexpr int bin_of(std::int64_t value) noexcept {
    const int shift = (std::max)(0, int(std::bit_width(std::uint64_t(value))) - 6);
    return 32 * shift + int(value >> shift);
  }
  /// The largest value of a bin [ns].
  static constexpr std::int64_t last_of(int bin) noexcept {
    const int shift = (std::max)(0, bin / 32 - 1);
    const std::uint64_t next = std::uint64_t(bin - 32 * shift + 1) << shift;
    return std::int64_t(next - 1);
  }

 private:
  std::array<std::int64_t, bins> counts_ = {};
  std::int64_t count_ = 0;
  std::int64_t minimum_ = 0;
  std::int64_t maximum_ = 0;
};

}  // namespace feeler
