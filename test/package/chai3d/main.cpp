// The adapter for CHAI3D keeps its promise: whatever the hand does, the device gets no more than it may give.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "chai3d_tool.hpp"
#include "scenes/round_renderers.hpp"

namespace {

using chai3d::cVector3d;

struct Device : chai3d::cGenericHapticDevice {
  Device() {
    m_specifications.m_maxLinearForce = 12;
    m_specifications.m_maxLinearStiffness = 5000;
    m_specifications.m_maxLinearDamping = 40;
  }
  bool getPosition(cVector3d& at) override { return at = position, true; }
  bool setForceAndTorqueAndGripperForce(const cVector3d& force, const cVector3d& torque, double gripper) override {
    last = force.length();
    most = std::max(most, last);
    is_limited = is_limited && last <= 12 * (1 + 1e-12) && torque.length() == 0 && gripper == 0;  // false of a NaN
    return true;
  }
  cVector3d position;
  double last = 0, most = 0;
  bool is_limited = true;
};

int failures = 0;
void expect(bool holds, const char* what) {
  if (holds) return;
  std::printf("not so: %s\n", what);
  ++failures;
}

}  // namespace

int main() {
  chai3d::cMesh block;  // its top at z = 0
  for (int i = 0; i < 8; ++i) block.m_vertices->positions.push_back({(i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 1.0});
  block.m_triangles->indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  const auto object = feeler_mesh(block);
  expect(object.report().is_closed_manifold(), "a block is closed");
  chai3d::cWorld world;
  const auto device = std::make_shared<Device>();
  FeelerTool<feeler::Sphere<double>> tool(&world, device, object, feeler::Sphere<double>(0.005), 1);
  tool.setUseForceRise(true);

  device->position = cVector3d(0, 0, -0.01);
  expect(tool.start(), "it starts");
  expect(tool.renderer().tick().graphic_pose.translation.z() > 0.004, "a start in the block is put on top of it");
  double wanted = 0;
  const auto run = [&](int ticks, const auto& path, bool has_clock = true) {
    device->most = 0;
    for (int i = 0; i < ticks; ++i) {
      if (has_clock) chai3d::cPrecisionClock::seconds += 1e-3;
      device->position = path(i);
      tool.updateFromDevice();
      tool.computeInteractionForces();
      tool.updateToolImagePosition();
      tool.applyToDevice();
      wanted = std::max(wanted, tool.renderer().tick().wrench.force.norm());
    }
  };
  const auto held = [](double z) { return [z](int) { return cVector3d(0, 0, z); }; };
  run(500, held(-0.01));
  expect(device->most == 0, "a start in contact pushes nothing");
  run(500, held(0.02));
  run(1000, [](int i) { return cVector3d(0, 0, std::max(0.02 - 1e-4 * i, 0.0035)); });
  expect(device->last > 7 && device->last < 8, "1.5 mm of 5000 N/m are felt");
  run(500, held(-0.5));
  expect(wanted > 2000 && device->last > 2, "a hand that is thrown half a metre down wants far too much, and gets some");
  run(50, held(-0.5), false);
  expect(device->last == 0, "a clock that stands holds no force");
  run(50, held(std::numeric_limits<double>::quiet_NaN()));
  run(50, held(-0.5));
  expect(device->last == 0, "after a NaN nothing is pushed");
  expect(device->is_limited, "no more than 12 N, no torque, no NaN");
  return failures;
}
