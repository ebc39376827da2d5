// The hands that hold the device: from barely to firmly.
#pragma once

#include <array>

#include "feeler/device/simulated_hand.hpp"

namespace feeler::stability {

struct NamedGrip {
  const char* name;
  Grip grip;
};

/// Assumed, all four: fingers on a handle are reported at 500 to 1500 N/m and near critical damping where
/// they grip, so the middle two bracket that; "barely" and "soft" are hands that hardly damp, which is where
/// a loop that gives energy shows it.
constexpr std::array<NamedGrip, 4> grips = {{
    {"barely", {.stiffness = 50, .rotational_stiffness = 0.02, .damping_ratio = 0.1}},
    {"soft", {.stiffness = 200, .rotational_stiffness = 0.1, .damping_ratio = 0.3}},
    {"relaxed", {.stiffness = 1000, .rotational_stiffness = 0.5, .damping_ratio = 1.0}},
    {"firm", {.stiffness = 2000, .rotational_stiffness = 1.0, .damping_ratio = 1.0}},
}};

}  // namespace feeler::stability
