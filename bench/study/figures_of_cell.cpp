#include "study/figures_of_cell.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "study/checked_pieces.hpp"
#include "times.hpp"

namespace feeler::study {
namespace {

Pose<double> narrow(const Pose<Wide>& pose) { return pose.cast<double>(); }

/// Just-noticeable differences: 7 % of a force of 2.5 N and more (Pang, Tan and Durlach 1991), 12.7 % of a torque of 60 mN·m (Jandura and Srinivasan 1994).
double force_difference(double error, double force) { return error / (0.07 * std::max(force, 2.5)); }
double torque_difference(double error, double torque) { return error / (0.127 * std::max(torque, 0.06)); }

/// How far the points of a tool are apart at two poses, at most [m].
double largest_distance(const StudyScene& scene, const Pose<Wide>& a, const Pose<Wide>& b) {
  Wide largest = 0;
  for (const auto& piece : scene.pieces)
    for (Eigen::Index i = 0; i < piece.rows(); ++i) {
      const Vector3<Wide> point = piece.row(i).transpose().cast<Wide>();
      largest = std::max(largest, ((a.translation - b.translation) + a.rotation.normalized() * point - b.rotation.normalized() * point).norm());
    }
  return double(largest);
}

}  // namespace

const TruthPath& TruthPaths::of(const StudyScene& scene, const Cell& cell, const Truth& truth, double margin, double kept) {
  constexpr int rate = 4000, most_ticks_held = 100, hopeless = 10;
  const std::tuple key(cell.scene, cell.motion, cell.scale, cell.offset, margin, kept);
  if (const auto found = made_.find(key); found != made_.end()) return found->second;
  TruthPath path;
  Cell unlimited = cell;
  unlimited.rendering = "double";
  unlimited.margin = margin;
  unlimited.budget = 4000;
  unlimited.iterations = 32;
  const auto player = rendering("double").make(scene, unlimited);
  if (player->reset(scene.start) != TickStatus::converged) throw std::invalid_argument("the scene starts in penetration");
  for (int k = 1; k <= int(std::lround(seconds_ * rate)); ++k) {
    const double time = double(k) / rate;
    const Pose<double> hand = scene.motion(time);
    Reading reading = player->update(hand);
    if (k % (rate / TruthPath::samples_a_second) != 0) continue;
    // A fit that is tighter than twice the distance has no pose that keeps it.
    if (path.samples.empty() && path.missing >= hopeless) {
      path.missing = int(std::lround(seconds_ * TruthPath::samples_a_second));
      break;
    }
    for (int i = 0; i < most_ticks_held && !(reading.status == TickStatus::converged && reading.is_at_rest); ++i) reading = player->update(hand);
    const auto nearest = truth.nearest(hand, narrow(reading.pose), margin, kept);
    if (!nearest) {
      ++path.missing;
      continue;
    }
    path.samples.push_back({time, wide(nearest->pose), wide(nearest->force), wide(nearest->torque), !nearest->active.empty()});
  }
  return made_.emplace(key, std::move(path)).first->second;
}

CellFigures figures_of(const Cell& cell, double seconds, unsigned seed, TruthPaths& paths) {
  CellFigures figures;
  const StudyScene scene = make_scene(cell, seed);
  const Truth truth(scene);
  const TruthPath *path = nullptr, *own_path = nullptr;
  std::unique_ptr<Player> player;
  try {
    player = rendering(cell.rendering).make(scene, cell);
    if (player->reset(scene.start) != TickStatus::converged) throw std::invalid_argument("the tool overlaps the object where it starts");
    constexpr double next_to_nothing = 1e-12;  // [m]
    path = &paths.of(scene, cell, truth, Cell().margin, next_to_nothing);
    own_path = &paths.of(scene, cell, truth, cell.margin, cell.margin);
  } catch (const std::invalid_argument& refusal) {
    figures.refusal = refusal.what();
    return figures;
  }
  const test::CheckedObject object(scene.vertices, scene.triangles);
  const auto pieces = checked_pieces(scene);

  std::vector<double> errors, solver_errors, force_errors, force_differences, torque_differences, separations, jitters, work, operations, times;
  // The sample of a path at a time, if there is one.
  const auto sample_at = [](const TruthPath& all, double time, std::size_t& next) -> const TruthPath::Sample* {
    while (next < all.samples.size() && all.samples[next].time < time - 1e-9) ++next;
    return next < all.samples.size() && all.samples[next].time < time + 1e-9 ? &all.samples[next] : nullptr;
  };
  std::size_t next = 0, next_own = 0;
  figures.deepest = 0;
  int converged = 0, unconverged_run = 0, longest_run = 0;
  Vector3<Wide> last_force = Vector3<Wide>::Zero(), last_change = Vector3<Wide>::Zero();
  const int ticks = int(std::lround(seconds * cell.rate));
  for (int k = 1; k <= ticks; ++k) {
    const double time = double(k) / cell.rate;
    const Reading reading = player->update(scene.motion(time));
    const bool has_converged = reading.status == TickStatus::converged;
    converged += has_converged;
    unconverged_run = has_converged ? 0 : unconverged_run + 1;
    longest_run = std::max(longest_run, unconverged_run);
    const Vector3<Wide> change = reading.force - last_force;
    if (k > 2) jitters.push_back(double((change - last_change).norm()));
    last_force = reading.force, last_change = change;
    if (reading.force.norm() > 0) {
      work.push_back(reading.work);
      if (reading.operations > 0) operations.push_back(double(reading.operations));
      times.push_back(reading.microseconds);
    }
    if (k % (cell.rate / TruthPath::samples_a_second) == 0)
      figures.deepest = std::max(figures.deepest, double(test::deepest_penetration(object, pieces, test::checked_pose(reading.pose)).depth));
    if (const auto* own = sample_at(*own_path, time, next_own)) solver_errors.push_back(largest_distance(scene, reading.pose, own->pose));
    const auto* found = sample_at(*path, time, next);
    if (found == nullptr) continue;
    const auto& sample = *found;
    errors.push_back(largest_distance(scene, reading.pose, sample.pose));
    force_errors.push_back(double((reading.force - sample.force).norm()));
    force_differences.push_back(force_difference(force_errors.back(), double(sample.force.norm())));
    torque_differences.push_back(torque_difference(double((reading.torque - sample.torque).norm()), double(sample.torque.norm())));
    if (sample.is_in_contact) {
      const Pose<Real> pose{reading.pose.translation.cast<Real>(), reading.pose.rotation.cast<Real>()};
      const double reach = 10 * cell.margin;
      separations.push_back(std::min(double(truth.gaps().distance(pose, reach)), reach));
    }
  }
  const auto share_within = [&](double most) {
    return errors.empty() ? CellFigures::none
                          : double(std::count_if(errors.begin(), errors.end(), [most](double e) { return e <= most; })) / double(errors.size());
  };
  const auto quantile = [](const std::vector<double>& values, double share) {
    return values.empty() ? CellFigures::none : bench::quantile(values, share);
  };
  figures.samples = int(errors.size());
  figures.samples_without_truth = path->missing;
  figures.converged = double(converged) / std::max(ticks, 1);
  figures.error_median = quantile(errors, 0.5), figures.error_99 = quantile(errors, 0.99), figures.error_most = quantile(errors, 1);
  figures.solver_samples = int(solver_errors.size());
  figures.solver_error_median = quantile(solver_errors, 0.5), figures.solver_error_99 = quantile(solver_errors, 0.99);
  figures.within_tenth_micrometre = share_within(1e-7), figures.within_micrometre = share_within(1e-6);
  figures.separation = quantile(separations, 0.5);
  figures.force_error_median = quantile(force_errors, 0.5), figures.force_error_99 = quantile(force_errors, 0.99);
  figures.force_jnd_99 = quantile(force_differences, 0.99), figures.torque_jnd_99 = quantile(torque_differences, 0.99);
  figures.jitter_99 = quantile(jitters, 0.99);
  figures.lag = double(longest_run) / cell.rate;
  figures.work_median = quantile(work, 0.5), figures.work_99 = quantile(work, 0.99), figures.work_most = quantile(work, 1);
  figures.operations_median = quantile(operations, 0.5), figures.operations_99 = quantile(operations, 0.99);
  figures.time_median = quantile(times, 0.5), figures.time_99 = quantile(times, 0.99), figures.time_999 = quantile(times, 0.999),
  figures.time_most = quantile(times, 1);
  return figures;
}

}  // namespace feeler::study
