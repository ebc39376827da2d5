// The trials of the thin plate.
#include "rivals/thin_plates.hpp"

#include <array>
#include <cmath>

#include "rivals/arena.hpp"
#include "rivals/side_of_object.hpp"
#include "scenes/plate.hpp"
#include "scenes/steps.hpp"
#include "scenes/sulcus.hpp"

namespace feeler::rivals {
namespace {

using scenes::Vector;

constexpr int orientations = 5;
constexpr std::array speeds{0.1, 0.3, 1.0};       // [m/s]
constexpr std::array jumps{0.015, 0.030, 0.060};  // [m]
constexpr double beyond = 0.02;  // where the device ends below the plate, but for short jumps [m]
constexpr double held = 0.2;     // [s]

/// The device's way down: at a speed, or in one tick.
struct Push {
  double top;      ///< where it begins, if the box does not touch the plate there [m]
  double way;      ///< [m]
  double seconds;  ///< until it is down; 0 for a jump
};

std::vector<Push> pushes() {
  std::vector<Push> list;
  for (const double speed : speeds) list.push_back({0.02, 0.02 + beyond, (0.02 + beyond) / speed});
  for (const double jump : jumps) list.push_back({jump - beyond, jump, 0.0});
  return list;
}

/// The lowest that a tool reaches below the origin of its frame [m].
double reach(const CoupledScene& scene, const Quaternion<double>& rotation) {
  double deepest = 0.0;
  for (const auto& piece : scene.pieces) {
    for (Eigen::Index i = 0; i < piece.rows(); ++i) {
      deepest = std::max(deepest, -(rotation * Vector(piece.row(i).transpose())).z());
    }
  }
  return deepest;
}

/// Whether the middle of the tool is below the plate after a push.
bool is_pushed_through(CoupledTool& tool, const Contest& contest, const Pose<double>& start, const Push& push, double rate) {
  const Vector middle = middle_of(contest.pieces);
  tool.reset(start);
  SideOfObject side(contest.object, start * middle);
  for (int i = 1; i <= int((push.seconds + held) * rate); ++i) {
    const double t = double(i) / rate;
    Pose<double> device = start;
    device.translation.z() -= push.way * (t >= push.seconds ? 1.0 : t / push.seconds);
    for (const Pose<double>& pose : tool.update(device).path) side.move_to(pose * middle);
  }
  return side.is_other();
}

template <RigidTool Tool>
void push_through(const Tool& tool, double rate, scenes::RandomBits& random, std::vector<PlateScore>& scores) {
  scenes::Scene plate = scenes::plate();
  plate.start.translation.z() = 0.1;  // free for every tool
  Arena arena(plate, tool, std::numeric_limits<double>::infinity(), 1.0 / rate);
  Contest& contest = arena.contest();
  scores.resize(contest.tools.size());
  for (int k = 0; k < orientations; ++k) {
    const Vector turn = random.unit() * random.direction();
    const Vector place(0.02 * (random.unit() - 0.5), 0.02 * (random.unit() - 0.5), 0.0);
    for (const Push& push : pushes()) {
      Pose<double> start = scenes::pose_of(turn, place);
      start.translation.z() = std::max(push.top, reach(arena.scene(), start.rotation) + 1e-4);
      for (std::size_t c = 0; c < scores.size(); ++c) {
        scores[c].name = contest.tools[c]->name();
        ++scores[c].trials;
        scores[c].crossed += is_pushed_through(*contest.tools[c], contest, start, push, rate) ? 1 : 0;
      }
    }
  }
}

}  // namespace

std::vector<PlateScore> push_through_plates(double rate) {
  std::vector<PlateScore> scores;
  scenes::RandomBits random(1);
  push_through(Box<double>(Vector(0.010, 0.006, 0.003)), rate, random, scores);
  push_through(scenes::slender_probe(), rate, random, scores);
  push_through(std::get<Segment<double>>(scenes::steps().tool), rate, random, scores);
  return scores;
}

}  // namespace feeler::rivals
