// Scripted hands and closed-form scenes of the experiments.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "scenes/cavity.hpp"
#include "scenes/plate.hpp"
#include "scenes/rotation_between.hpp"
#include "scenes/spline.hpp"
#include "scenes/steps.hpp"

namespace feeler::experiments {

using scenes::Vector;

/// Numbers that the hand passes at given times, at rest at each of them.
struct KeyFrame {
  double time = 0;                  ///< [s]
  std::array<double, 4> values{};
};

inline std::array<double, 4> between(const std::vector<KeyFrame>& frames, double t) {
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (t > frames[i].time) continue;
    const double s = std::max(0.0, (t - frames[i - 1].time) / (frames[i].time - frames[i - 1].time));
    const double share = s * s * (3.0 - 2.0 * s);
    std::array<double, 4> result{};
    for (std::size_t k = 0; k < 4; ++k) result[k] = frames[i - 1].values[k] + share * (frames[i].values[k] - frames[i - 1].values[k]);
    return result;
  }
  return frames.back().values;
}

/// The five states of Fig. 11: free, turned clockwise, turned anti-clockwise, translated along a wall, free.
/// @param speed  1 for five seconds; the hand turns at up to 0.9 rad/s times that
inline scenes::Scene cavity_states(double clearance, double speed = 1.0) {
  scenes::Scene scene = scenes::cavity(clearance);
  const std::vector<KeyFrame> frames{{0.0, {0, 0, 0, 0}},          {0.4, {0, 0, 0, 0}},           {0.9, {0, 0, 0, -0.3}},   {1.4, {0, 0, 0, 0}},
                                     {1.6, {0, 0, 0, 0}},          {2.1, {0, 0, 0, 0.3}},         {2.6, {0, 0, 0, 0}},      {3.0, {0, -0.003, 0, 0}},
                                     {3.6, {0.008, -0.003, 0, 0}}, {4.2, {-0.008, -0.003, 0, 0}}, {4.6, {-0.008, 0, 0, 0}}, {5.0, {-0.008, 0, 0, 0}}};
  scene.motion = [frames, speed](double t) {
    const auto v = between(frames, t * speed);
    return scenes::pose_of({0.0, 0.0, v[3]}, {v[0], v[1], v[2]});
  };
  scene.start = scene.motion(0.0);
  scene.duration = 5.0 / speed;
  return scene;
}

/// The five states of Fig. 13 with a line of 30 mm held at its lower end: free, on the top, lightly over its edge (pressed, it would slip off), on the slope behind it, across
/// the valley with both ends, free.
inline scenes::Scene steps_states() {
  scenes::Scene scene = scenes::steps();
  scene.tool = Segment<double>(Vector::Zero(), Vector(0.0, 0.0, 0.030));
  scene.tip = Vector::Zero();
  // x and z of the held end, and the angle of the line seen along y.
  const std::vector<KeyFrame> frames{{0.0, {0.004, 0.026, 157, 0}},   {0.3, {0.004, 0.026, 157, 0}},    {0.6, {0.005, 0.0185, 157, 0}},
                                     {0.8, {0.007, 0.0185, 157, 0}},  {1.1, {0.0095, 0.01999, 157, 0}}, {1.4, {0.0125, 0.01999, 157, 0}},
                                     {1.7, {0.0150, 0.0172, 157, 0}}, {2.0, {0.0150, 0.0172, 157, 0}},  {2.4, {0.0145, 0.0155, 100, 0}},
                                     {2.8, {0.0150, 0.0150, 70, 0}},  {3.6, {0.0150, 0.0150, -14, 0}},  {4.0, {0.0150, 0.0150, -14, 0}},
                                     {4.5, {0.0160, 0.0260, 0, 0}},   {5.0, {0.0160, 0.0300, 0, 0}}};
  scene.motion = [frames](double t) {
    const auto v = between(frames, t);
    const double angle = v[2] * std::numbers::pi / 180.0;
    const Vector along(0.0078 * std::cos(angle), 0.029, 0.0078 * std::sin(angle));
    Pose<double> pose;
    pose.translation = {v[0], -0.0145, v[1]};
    pose.rotation = scenes::rotation_between(Vector::UnitZ(), along);
    return pose;
  };
  scene.start = scene.motion(0.0);
  scene.duration = 5.0;
  return scene;
}

/// A splined shaft that is pushed 11 mm into its hole by a hand that strays from its axis, twisted both ways, and pulled out again.
inline scenes::CompoundScene insertion(double clearance) {
  scenes::CompoundScene scene = scenes::spline(clearance);
  const std::vector<KeyFrame> frames{{0.0, {0.016, 0, 0, 0}},         {0.3, {0.016, 0, 0, 0}},           {1.0, {0.011, 0, 0, 0}},
                                     {1.8, {0.004, 0, 0.0005, 0.02}}, {2.3, {0.004, 0.1, 0.0005, 0.02}}, {2.9, {0.004, -0.1, 0.0005, 0.02}},
                                     {3.3, {0.004, 0, 0, 0}},         {4.5, {0.016, 0, 0, 0}},           {5.0, {0.016, 0, 0, 0}}};
  scene.motion = [frames](double t) {
    const auto v = between(frames, t);
    return scenes::pose_of({v[3], 0.0, v[1]}, {v[2], 0.0, v[0]});
  };
  scene.start = scene.motion(0.0);
  scene.duration = 5.0;
  return scene;
}

/// A cube of 2 mm and a hand that pushes it through a plate of no thickness (Fig. 5a).
inline scenes::Scene push_through_plate() {
  scenes::Scene scene = scenes::plate();
  scene.tool = Box<double>(Vector::Constant(0.001));
  scene.motion = [](double t) { return scenes::pose_of(Vector::Zero(), {0.0137, 0.0071, 0.010 - 0.020 * t}); };
  scene.start = scene.motion(0.0);
  scene.duration = 1.0;
  return scene;
}

constexpr double wedge_half_angle = 0.2;  // [rad]

/// The same cube and a wedge with its ridge along y at the origin; the hand crosses it 5 mm below the ridge (Fig. 5b).
inline scenes::Scene push_through_wedge() {
  scenes::Scene scene = push_through_plate();
  const double depth = 0.04, half = depth * std::tan(wedge_half_angle);
  scene.vertices.resize(6, 3);
  scene.vertices << 0, -0.03, 0, 0, 0.03, 0, -half, -0.03, -depth, -half, 0.03, -depth, half, -0.03, -depth, half, 0.03, -depth;
  scene.triangles.resize(4, 3);
  scene.triangles << 0, 1, 3, 0, 3, 2, 0, 4, 5, 0, 5, 1;
  scene.motion = [](double t) { return scenes::pose_of(Vector::Zero(), {-0.010 + 0.020 * t, 0.0, -0.005}); };
  scene.start = scene.motion(0.0);
  return scene;
}

/// A cube of 10 mm pressed 2 mm into a slope and dragged 10 mm over it, then held.
/// @param slope    of the face about y [rad]
/// @param heading  of the drag on the face: 0 is downhill [rad]
inline scenes::Scene slope_drag(double slope, double heading) {
  scenes::Scene scene;
  scene.name = "slope";
  const Quaternion<double> turn = exp_rotation(Vector(0.0, slope, 0.0));
  scene.vertices.resize(0, 3);
  scene.triangles.resize(0, 3);
  scenes::add_plates(scene, {{turn * Vector(0.0213, 0.0071, 0.0), turn * Vector(0.1, 0.0, 0.0), turn * Vector(0.0, 0.1, 0.0)}});
  scene.tool = Box<double>(Vector::Constant(0.005));
  scene.motion = [turn, heading](double t) {
    const double press = 0.006 - 0.003 * std::min(t / 0.2, 1.0);  // the face of the cube is at 5 mm
    const double way = 0.010 * std::clamp((t - 0.25) / 0.2, 0.0, 1.0);
    return Pose<double>{turn * Vector(way * std::cos(heading), way * std::sin(heading), press), turn};
  };
  scene.start = scene.motion(0.0);
  scene.duration = 0.6;
  return scene;
}

/// A line of 0.2 m, held in the middle, that touches a floor with one end: a contact at an arm of 0.1 m.
inline scenes::Scene long_arm() {
  scenes::Scene scene;
  scene.name = "arm";
  scene.vertices.resize(0, 3);
  scene.triangles.resize(0, 3);
  scenes::add_plates(scene, {{Vector::Zero(), Vector(0.3, 0.0, 0.0), Vector(0.0, 0.3, 0.0)}});
  scene.tool = Segment<double>(Vector(-0.1, 0.0, 0.0), Vector(0.1, 0.0, 0.0));
  scene.motion = [](double t) {
    const double height = 0.1 * std::sin(0.2) + 0.001 - 0.003 * std::min(t / 0.2, 1.0);
    return scenes::pose_of({0.0, 0.2, 0.0}, {0.0, 0.0, height});
  };
  scene.start = scene.motion(0.0);
  scene.duration = 0.4;
  return scene;
}

}  // namespace feeler::experiments
