// Puts another stage under a running servo loop, without a lock and without a missed tick.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "live/stage.hpp"

namespace feeler::demo {

/// One thread offers stages, the loop takes them at the start of a tick. What the loop has left is destroyed
/// by the thread that offers.
class StageSwitch {
 public:
  explicit StageSwitch(std::shared_ptr<Stage> first) : on_show_(std::move(first)), offered_(nullptr), taken_(on_show_.get()) {}

  /// By the loop, at the start of a tick. Wait-free.
  Stage& current() noexcept {
    if (Stage* next = offered_.exchange(nullptr, std::memory_order_acquire); next != nullptr) taken_.store(next, std::memory_order_release);
    return *taken_.load(std::memory_order_relaxed);
  }

  /// By the thread that offers: returns when the loop has taken it, or has ended.
  /// @param is_running  whether the loop runs still
  template <class IsRunning>
  void offer(std::shared_ptr<Stage> stage, const IsRunning& is_running) {
    offered_.store(stage.get(), std::memory_order_release);
    while (taken_.load(std::memory_order_acquire) != stage.get() && is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    on_show_ = std::move(stage);
  }

  /// By the thread that offers.
  const std::shared_ptr<Stage>& on_show() const noexcept { return on_show_; }

 private:
  std::shared_ptr<Stage> on_show_;
  std::atomic<Stage*> offered_;
  std::atomic<Stage*> taken_;
};

/// The device of a live view: that of the stage on show.
class StagedDevice final : public Device {
 public:
  StagedDevice(StageSwitch& stages, viewer::LiveFeed& feed) : stages_(stages), feed_(feed) {}

  OpenResult open() override { return {}; }
  DeviceStatus read(DeviceState& state) noexcept override {
    stage_ = &stages_.current();
    if (viewer::HandRequest request; feed_.fetch(request) && request.stage == stage_->number()) stage_->ask(request);
    return stage_->read(state);
  }
  DeviceStatus write(const DeviceWrench& wrench) noexcept override { return stage_ == nullptr ? DeviceStatus::ok : stage_->write(wrench); }
  void close() noexcept override {}
  const DeviceSpecification& specification() const noexcept override { return specification_; }
  bool lives_by_the_clock() const noexcept override { return false; }

  /// The stage of this tick, between its `read` and its `write`.
  Stage& stage() const noexcept { return *stage_; }

 private:
  StageSwitch& stages_;
  viewer::LiveFeed& feed_;
  DeviceSpecification specification_ = phantom_premium_3_0_6dof();
  Stage* stage_ = nullptr;
};

}  // namespace feeler::demo
