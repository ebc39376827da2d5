// Turns of 200 ticks, and the judgement of what was done in them.
#include "rivals/contest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "feeler/spatial/metric.hpp"
#include "rivals/side_of_object.hpp"
#include "scenes/motions.hpp"
#include "times.hpp"

namespace feeler::rivals {
namespace {

using bench::quantile;
using bench::thread_time;

constexpr int ticks_per_turn = 200;
constexpr double contact_energy = 1e-14;  // [m²]

/// The ticks of one contender, as many as it made.
struct Track {
  std::vector<Pose<double>> poses;
  std::vector<std::vector<Pose<double>>> paths;  // to each pose
  std::vector<double> microseconds;
};

/// Keeps the first run's poses and the least time of every tick of the runs.
/// @return whether the poses of the runs are the same
bool merge(Track& kept, Track&& run) {
  if (kept.poses.empty()) {
    kept = std::move(run);
    return true;
  }
  const std::size_t both = std::min(kept.poses.size(), run.poses.size());
  for (std::size_t i = 0; i < both; ++i) kept.microseconds[i] = std::min(kept.microseconds[i], run.microseconds[i]);
  return std::equal(run.poses.begin(), run.poses.begin() + std::ptrdiff_t(both), kept.poses.begin());
}

/// One run of all contenders; the last track is that of the distance query, with its answers.
/// @param first_turn  ticks of it; all others are of `ticks_per_turn`
std::vector<Track> run_in_turns(Contest& contest, const std::vector<Pose<double>>& device, int first_turn, double patience,
                                std::vector<double>& distances) {
  const std::size_t contenders = contest.tools.size() + (contest.distance ? 1 : 0);
  std::vector<Track> tracks(contenders);
  std::vector<double> spent(contenders, 0.0);
  for (const auto& tool : contest.tools) tool->reset(contest.start);
  distances.clear();
  for (std::size_t begin = 0, length = std::size_t(first_turn); begin < device.size(); begin += length, length = std::size_t(ticks_per_turn)) {
    const std::size_t end = std::min(begin + length, device.size());
    for (std::size_t c = 0; c < contenders; ++c) {
      Track& track = tracks[c];
      if (spent[c] > 1e6 * patience) continue;
      const bool is_query = c == contest.tools.size();
      for (std::size_t i = begin; i < end; ++i) {
        const Pose<double> pose = is_query ? tracks[0].poses[i] : device[i];
        CoupledTick tick;
        const double start = thread_time();
        if (is_query) {
          distances.push_back(contest.distance(pose));
        } else {
          tick = contest.tools[c]->update(pose);
        }
        track.microseconds.push_back(thread_time() - start);
        if (!is_query) {
          track.poses.push_back(tick.graphic_pose);
          track.paths.emplace_back(tick.path.begin(), tick.path.end());
        }
        spent[c] += track.microseconds.back();
      }
      // The first tool's poses are what the query and the choice of ticks need: it does not drop out.
      if (c == 0) spent[c] = 0.0;
    }
  }
  return tracks;
}

/// Points of the tool that no surface may pass: its middle, and of a long one a point 1 mm inside its tip.
/// The depth in a triangle cannot tell how far a tip is through, since sideways it is soon out of a small
/// one.
std::vector<Vector3<double>> marks_of(const Contest& contest) {
  constexpr double inside = 1e-3;  // [m]
  std::vector<Vector3<double>> marks{middle_of(contest.pieces)};
  const Vector3<double> way = marks.front() - contest.tip;
  if (way.norm() > 2.0 * inside) marks.emplace_back(contest.tip + inside * way.normalized());
  return marks;
}

void judge(const Contest& contest, const Track& track, int check_every, Score& score) {
  const std::vector<Vector3<double>> marks = marks_of(contest);
  std::vector<SideOfObject> sides;
  for (const auto& mark : marks) sides.emplace_back(contest.object, contest.start * mark);
  for (std::size_t i = 0; i < track.poses.size(); ++i) {
    for (const Pose<double>& pose : track.paths[i]) {
      for (std::size_t k = 0; k < marks.size(); ++k) sides[k].move_to(pose * marks[k]);
    }
    if (int(i) % check_every != check_every - 1) continue;
    ++score.samples;
    const auto found = test::deepest_penetration(contest.object, contest.pieces, test::checked_pose(track.poses[i]));
    score.deepest = std::max(score.deepest, double(found.depth));
    score.crossed += std::any_of(sides.begin(), sides.end(), [](const auto& side) { return side.is_other(); }) ? 1 : 0;
  }
}

/// The motion with a stop after each second; gives up when the contender has taken too long, with NaN before
/// the first stop.
double jitter(CoupledTool& tool, const Contest& contest, const ContestOptions& options) {
  const auto metric = Metric<double>::with_length(contest.length);
  const int second = int(options.rate), held = second / 2, settling = held * 3 / 5;
  const double begin = thread_time();
  double worst = std::numeric_limits<double>::quiet_NaN();
  tool.reset(contest.start);
  for (int moved = 1; moved <= int(options.seconds * options.rate); ++moved) {
    const Pose<double> device = contest.motion(double(moved) / options.rate);
    tool.update(device);
    if (moved % second == 0) {
      Pose<double> settled;
      if (std::isnan(worst)) worst = 0.0;
      for (int i = 0; i < held; ++i) {
        const Pose<double> pose = tool.update(device).graphic_pose;
        if (i <= settling) settled = pose;
        worst = std::max(worst, std::sqrt(2.0 * metric.energy(motion_between(settled, pose))));
      }
    }
    if (thread_time() - begin > 1e6 * options.patience) break;
  }
  return worst;
}

double lag(CoupledTool& tool, const Contest& contest, double rate) {
  constexpr double catching_up = 0.7,
                   seconds = 3.0;  // the hands of many scenes come down with a jolt at 0.5 s
  double worst = 0.0;
  tool.reset(contest.start);
  for (int i = 1; i <= int(seconds * rate); ++i) {
    const Pose<double> device = contest.motion(double(i) / rate);
    const Pose<double> pose = tool.update(device).graphic_pose;
    if (double(i) > catching_up * rate) worst = std::max(worst, (pose.translation - device.translation).norm());
  }
  return worst;
}

}  // namespace

std::vector<Score> hold(Contest& contest, const ContestOptions& options) {
  const auto device = scenes::sampled(contest.motion, options.rate, int(options.seconds * options.rate) + 1);
  const std::vector<Pose<double>> ticks(device.begin() + 1, device.end());
  std::vector<Track> tracks;
  std::vector<Score> scores(contest.tools.size() + (contest.distance ? 1 : 0));
  std::vector<double> distances;
  for (int run = 0; run < options.repeats; ++run) {
    // No tick is in every run the first of a turn, which finds the caches full of what others need.
    const int first_turn = ticks_per_turn - ticks_per_turn * run / options.repeats;
    auto now = run_in_turns(contest, ticks, first_turn, options.patience, distances);
    tracks.resize(now.size());
    for (std::size_t c = 0; c < now.size(); ++c) scores[c].is_repeatable &= merge(tracks[c], std::move(now[c]));
  }

  const auto metric = Metric<double>::with_length(contest.length);
  for (std::size_t c = 0; c < scores.size(); ++c) {
    Score& score = scores[c];
    score.is_query = c == contest.tools.size();
    std::vector<double> in_contact;
    for (std::size_t i = 0; i < tracks[c].microseconds.size(); ++i) {
      if (!(metric.energy(motion_between(ticks[i], tracks[0].poses[i])) > contact_energy)) continue;
      in_contact.push_back(tracks[c].microseconds[i]);
      if (score.is_query && !(distances[i] > 0.0)) ++score.touching;
    }
    score.ticks = int(in_contact.size());
    score.p50 = quantile(in_contact, 0.5);
    score.p99 = quantile(in_contact, 0.99);
    score.p999 = quantile(in_contact, 0.999);
    if (score.is_query) {
      score.name = "FCL distance";
      continue;
    }
    score.name = contest.tools[c]->name();
    if (!options.is_judged) continue;
    judge(contest, tracks[c], options.check_every, score);
    score.jitter = jitter(*contest.tools[c], contest, options);
    score.lag = lag(*contest.free_tools[c], contest, options.rate);
  }
  return scores;
}

}  // namespace feeler::rivals
