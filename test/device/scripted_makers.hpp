// The makers' drivers over their stand-ins in a world whose time is scripted: the loop ticks on whole
// milliseconds, the device on half ones.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "feeler/device/clock.hpp"
#include "feeler/device/force_dimension_device.hpp"
#include "feeler/device/open_haptics_device.hpp"
#include "feeler/device/virtuose_device.hpp"
#include "stand_in/force_dimension_stand_in.hpp"
#include "stand_in/open_haptics_stand_in.hpp"
#include "stand_in/stand_in.hpp"
#include "stand_in/virtuose_stand_in.hpp"

namespace feeler_test {

constexpr std::int64_t half_millisecond = 500'000;  // [ns]

/// A clock that makes the world go on while the loop sleeps or works.
class World final : public feeler::Clock {
 public:
  std::function<void()> frame = [] {};  // of the device, on half milliseconds
  std::function<bool()> is_silent = [] { return true; };
  std::vector<bool> was_silent;  // at each half millisecond since the start

  std::int64_t now() noexcept override { return now_; }
  void sleep_until(std::int64_t moment) noexcept override {
    while (now_ < moment) go_on();
  }
  void spend(int milliseconds) {
    for (int i = 0; i < 2 * milliseconds; ++i) go_on();
  }
  int half_milliseconds() const { return int(was_silent.size()); }

 private:
  void go_on() {
    now_ += half_millisecond;
    if (now_ / half_millisecond % 2 == 1) frame();
    was_silent.push_back(is_silent());
  }
  std::int64_t now_ = 1'000'000'000;
};

/// A maker's device over its stand-in, with its motors watched.
struct Maker {
  std::unique_ptr<feeler::Device> device;
  OpenHapticsStandIn* hd = nullptr;
  ForceDimensionStandIn* dhd = nullptr;
  VirtuoseStandIn* virtuose = nullptr;
};

inline bool is_zero(const double (&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

inline Maker open_haptics(World& world) {
  Maker maker;
  auto& hd = stand_in<OpenHapticsStandIn>(FEELER_OPEN_HAPTICS_STAND_IN);
  maker.hd = &hd;
  maker.device = std::make_unique<feeler::OpenHapticsDevice>(feeler::OpenHapticsSettings{{FEELER_OPEN_HAPTICS_STAND_IN}, ""}, &world);
  world.frame = [&hd] { hd.tick(); };
  world.is_silent = [&hd] { return is_zero(hd.force) && is_zero(hd.torque); };
  return maker;
}

inline Maker force_dimension(World& world) {
  Maker maker;
  auto& dhd = stand_in<ForceDimensionStandIn>(FEELER_FORCE_DIMENSION_STAND_IN);
  maker.dhd = &dhd;
  maker.device = std::make_unique<feeler::ForceDimensionDevice>(feeler::ForceDimensionSettings{{FEELER_FORCE_DIMENSION_STAND_IN}}, &world);
  world.is_silent = [&dhd] { return is_zero(dhd.force) && is_zero(dhd.torque); };
  return maker;
}

inline Maker virtuose(World& world) {
  Maker maker;
  auto& controller = stand_in<VirtuoseStandIn>(FEELER_VIRTUOSE_STAND_IN);
  maker.virtuose = &controller;
  feeler::VirtuoseSettings settings;
  settings.libraries = {FEELER_VIRTUOSE_STAND_IN};
  maker.device = std::make_unique<feeler::VirtuoseDevice>(settings, &world);
  world.is_silent = [&controller] {
    for (const float component : controller.wrench) {
      if (component != 0) return false;
    }
    return true;
  };
  return maker;
}

}  // namespace feeler_test
