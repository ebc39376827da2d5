// Builds on threads of its own, so that a newer choice need not wait until an older one is built.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

namespace feeler::demo {

/// Ends a task whose result nobody wants any more.
struct Abandoned {};

/// By a task, between its steps.
inline void go_on_unless(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Abandoned();
}

/// Runs one task whose result is wanted. One that another takes the place of is asked to end, and forgotten; a single such may run on beside
/// the wanted one. All functions are one thread's.
template <class Result>
class Workshop {
 public:
  using Task = std::function<Result(const std::stop_token&)>;

  ~Workshop() { abandon(); }

  void begin(Task task) {
    abandon();
    next_ = std::move(task);
    advance();
  }
  /// Nothing is wanted any more.
  void abandon() {
    next_ = nullptr;
    stop_.request_stop();
    if (wanted_.valid()) unwanted_.push_back(std::move(wanted_));
  }
  bool is_busy() const { return next_ || wanted_.valid(); }

  /// What the wanted task came to, once. @throws what the task threw
  std::optional<Result> result() {
    advance();
    if (!wanted_.valid() || !is_done(wanted_)) return {};
    return wanted_.get();
  }

 private:
  static bool is_done(const std::future<Result>& task) { return task.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }

  void advance() {
    std::erase_if(unwanted_, is_done);
    if (!next_ || unwanted_.size() > 1) return;
    stop_ = std::stop_source();
    wanted_ = std::async(std::launch::async, std::exchange(next_, nullptr), stop_.get_token());
  }

  Task next_;
  std::stop_source stop_;
  std::future<Result> wanted_;
  std::vector<std::future<Result>> unwanted_;
};

}  // namespace feeler::demo
