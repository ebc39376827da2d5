// How much work a tick may take, and when it is spent.
#pragma once

#include <algorithm>

namespace feeler {

/// The work of a tick, in the unit of `Settings::work_budget`, against what it may take.
///
/// What is begun stops where the budget does, and goes on in the next tick. A new iteration is begun where half as much work as the last one took
/// is left; the second where any is left, as what the first one met is known by then.
class WorkBudget {
 public:
  /// @param budget  of this tick
  void begin_tick(int budget) noexcept {
    limit_ = budget;
    begun_ = 0;
    iterations_ = 0;
  }
  /// @param work  of the tick so far, here and below
  void begin_iteration(int work) noexcept {
    begun_ = work;
    ++iterations_;
  }
  /// Work at which everything stops.
  int limit() const noexcept { return limit_; }
  bool is_spent(int work) const noexcept { return work >= limit_; }
  /// Whether enough is left for a step to be solved for: twice what the last one took, or half of a budget.
  bool allows_step(int work) const noexcept { return !is_spent(work + (std::min)((std::max)(work_of_step, 2 * last_step_), limit_ / 2)); }
  /// @param work  that it took to solve for a step
  void note_step(int work) noexcept { last_step_ = work; }
  /// Whether enough is left for it to be solved again with more rows.
  bool allows_solve(int work) const noexcept { return !is_spent(work + work_of_solve); }
  /// Whether another iteration is begun.
  bool allows_another(int work) const noexcept { return !is_spent(iterations_ <= 1 ? work : work + (work - begun_) / 2); }

 private:
  static constexpr int work_of_step = 10, work_of_solve = 3;

  int limit_ = 0;
  int last_step_ = 0;
  int begun_ = 0;       // work when the iteration at hand began
  int iterations_ = 0;  // begun in this tick
};

}  // namespace feeler
