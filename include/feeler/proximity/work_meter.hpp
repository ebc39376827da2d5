// Work that is less than a unit.
#pragma once

namespace feeler {

/// Counts efforts of which so many are one unit of `Settings::work_budget`.
template <int efforts_per_unit>
class WorkMeter {
 public:
  /// Counts some that are added to the work with the next ones.
  void note(int efforts) noexcept { efforts_ += efforts; }
  /// @param work  grows by the whole units, and what is left is kept
  void add(int efforts, int& work) noexcept {
    efforts_ += efforts;
    work += efforts_ / efforts_per_unit;
    efforts_ %= efforts_per_unit;
  }
  void clear() noexcept { efforts_ = 0; }

 private:
  int efforts_ = 0;
};

}  // namespace feeler
