// How much work a tick may take, and when it is spent.
#pragma once

#include <algorithm>

namespace feeler {

/// The work of a tick, in the unit of `Settings::work_budget`, against what it may take.
///
/// A new iteration is begun where half as much work as the last one took is left, so that a tick ends about where its budget does; the second
/// where any is left, as what the first one met is known by then. A fit all around a tool may take more to look at once than a tick has: while
/// that keeps the tool from moving, the budget grows by half from tick to tick.
class WorkBudget {
 public:
  void reset() noexcept { starved_ = patience_ = 0; }

  /// @param budget  of every tick
  void begin_tick(int budget) noexcept {
    allowed_ = budget;
    for (int i = 0; i < patience_; ++i) allowed_ += (std::max)(allowed_ / 2, least_growth);
    begun_ = 0;
    iterations_ = 0;
  }
  /// @param work  of the tick so far, here and below
  void begin_iteration(int work) noexcept {
    begun_ = work;
    ++iterations_;
  }
  /// Of the tick: it may have the most work.
  bool is_first_iteration() const noexcept { return iterations_ <= 1; }
  /// Whether there is not enough for another iteration that is like the last one.
  bool is_spent(int work) const noexcept { return work + (work - begun_) / 2 > allowed_; }
  /// Whether another iteration is begun.
  bool allows_another(int work) const noexcept { return !is_spent(work) || (is_first_iteration() && work < allowed_); }
  /// Whether a motion has to do with the linearisations that it has had; the first motion of a tick may have two of them.
  bool ends_motion(int work, int linearisations) const noexcept {
    return work >= allowed_ && linearisations >= (is_first_iteration() ? 2 : 1);
  }
  /// Work at which a certificate gives up. The first of a tick has half a budget at least.
  int limit_of_certificate(int work) const noexcept {
    return (std::max)(work + allowed_ / (is_first_iteration() ? 2 : 8), allowed_);
  }
  /// Lets the budget grow when it ran out before the tool moved, or before a second iteration, in some ticks in a row; and shrink where less
  /// would do.
  void end_tick(int work, bool has_moved) noexcept {
    constexpr int most_patience = 7, most_starved = 1;
    const bool is_starved = is_spent(work) && (!has_moved || iterations_ < 2);
    starved_ = is_starved ? starved_ + 1 : 0;
    if (starved_ > most_starved) patience_ = (std::min)(patience_ + 1, most_patience);
    if (work < allowed_ / 2) patience_ = (std::max)(patience_ - 1, 0);
  }

 private:
  static constexpr int least_growth = 20;  // about what an iteration takes

  int allowed_ = 0;     // in this tick
  int begun_ = 0;       // work when the iteration at hand began
  int iterations_ = 0;  // begun in this tick
  int starved_ = 0;     // ticks in a row
  int patience_ = 0;    // times that it grows
};

}  // namespace feeler
