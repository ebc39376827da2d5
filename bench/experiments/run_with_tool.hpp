// How a run is made for one type of tool; each type is compiled in a file of its own.
#pragma once

#include <algorithm>
#include <cmath>

#include "experiments/run.hpp"
#include "feeler/feeler.hpp"
#include "feeler/paper/candidate_contacts.hpp"
#include "feeler/recognition/contact_recogniser.hpp"
#include "support/penetration_checker.hpp"
#include "times.hpp"

namespace feeler::experiments {

/// The default solver, which adds up the time it takes.
class TimedSolver {
 public:
  using Scalar = double;
  QpStatus solve(const QpProblem<double>& problem, QpSolution<double>& solution) noexcept {
    const double begin = bench::thread_time();
    const QpStatus status = solver_.solve(problem, solution);
    microseconds += bench::thread_time() - begin;
    return status;
  }
  inline static thread_local double microseconds = 0;

 private:
  DualActiveSet<double> solver_;
};

namespace detail {

constexpr CandidateOptions with_box(LocalSolution local_solution) {
  CandidateOptions options;
  options.local_solution = local_solution;
  return options;
}
constexpr CandidateOptions with_linearisations(int count) {
  CandidateOptions options;
  options.linearisations = count;
  return options;
}
constexpr CandidateOptions with_rotation_vectors() {
  CandidateOptions options;
  options.increments = Increments::rotation_vector;
  return options;
}
constexpr CandidateOptions with_certificate() {
  CandidateOptions options;
  options.collision_detection = CollisionDetection::certificate;
  return options;
}
constexpr CandidateOptions corrected() {
  CandidateOptions options = with_certificate();
  options.local_solution = LocalSolution::free;
  options.increments = Increments::rotation_vector;
  options.linearisations = 4;
  return options;
}

/// Error of the linear model over a step that an active contact made, and its bound.
template <class Tick>
void note_truncation(const Pose<double>& before, const Tick& tick, Record& record) {
  const Twist<double> step = motion_between(before, tick.graphic_pose);
  for (const auto& contact : tick.contacts) {
    const Vector3<double> after = contact.point_world - tick.graphic_pose.translation;
    const Vector3<double> arm = exp_rotation(Vector3<double>(-step.angular)) * after;
    const double error = contact.normal_world.dot(after - arm - step.angular.cross(arm));
    record.truncation = std::max(record.truncation, std::abs(error));
    record.truncation_bound = std::max(record.truncation_bound, arm.norm() * step.angular.squaredNorm() / 2);
  }
}

/// Recognises the contact formation of each tick.
template <class Tool>
class Observer {
 public:
  Observer(const TriangleMesh<double>& object, const Tool& tool) : surface_(object), recogniser_(object, surface_, tool) {}
  void observe(const Tick<double>& tick, Record& record) {
    const auto& formation = recogniser_.recognise(tick.graphic_pose);
    record.is_switch = tracker_.observe(formation) != nullptr;
    record.contacts = formation.size();
    record.regions = formation.region_count;
    record.vertex_face = formation.count(PrincipalContactType::vertex_face);
    record.edge_edge = formation.count(PrincipalContactType::edge_convex_edge);
  }

 private:
  SurfaceFeatures<double> surface_;
  ContactRecogniser<Tool> recogniser_;
  FormationTracker<double> tracker_;
};

/// Formations are those of a convex tool; of several pieces the rows that hold them are counted.
template <CompoundShape Tool>
class Observer<Tool> {
 public:
  Observer(const TriangleMesh<double>&, const Tool&) {}
  void observe(const Tick<double>& tick, Record& record) { record.contacts = tick.contacts.size(); }
};

template <class MethodType, class Tool>
Run run_method(const scenes::Setting& scene, const Tool& tool, const Settings<double>& settings, double seconds, bool is_checked) {
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  Observer<Tool> observer(object, tool);
  HapticRenderer<Tool, TimedSolver, MethodType> renderer(object, tool, settings);
  const test::CheckedObject checked_object(scene.vertices, scene.triangles);
  const auto checked_pieces = test::checked_pieces(tool);
  Run result;
  result.start = renderer.reset(scene.start);
  if (result.start != Status::converged) return result;
  Pose<double> last = scene.start;
  const int ticks = int(seconds * 1000.0);
  for (int k = 1; k <= ticks; ++k) {
    Record record;
    record.t = double(k) / 1000.0;
    record.haptic = scene.motion(record.t);
    TimedSolver::microseconds = 0;
    const double begin = bench::thread_time();
    const auto& tick = renderer.update(record.haptic);
    record.microseconds = bench::thread_time() - begin;
    record.optimisation_microseconds = TimedSolver::microseconds;
    record.graphic = tick.graphic_pose;
    record.wrench = tick.wrench;
    record.status = tick.status;
    observer.observe(tick, record);
    note_truncation(last, tick, record);
    if (is_checked) {
      Pose<double> from = last;
      for (const auto& to : tick.path) {
        for (const auto& piece : checked_pieces) {
          const auto found = test::deepest_penetration_on_path(checked_object, piece, test::checked_pose(from), test::checked_pose(to), 4);
          record.depth = std::max(record.depth, double(found.depth));
        }
        from = to;
      }
    }
    last = tick.graphic_pose;
    result.ticks.push_back(record);
  }
  return result;
}

}  // namespace detail

template <class Tool>
Run run_with_tool(const scenes::Scene& scene, const Tool& tool, const Settings<double>& settings, Method method, double seconds, bool is_checked) {
  const auto with = [&]<class MethodType>(MethodType) { return detail::run_method<MethodType>(scene, tool, settings, seconds, is_checked); };
  switch (method) {
    case Method::hard_box: return with(CandidateContacts<detail::with_box(LocalSolution::inside_box)>{});
    case Method::no_box: return with(CandidateContacts<detail::with_box(LocalSolution::free)>{});
    case Method::linearisations: return with(CandidateContacts<detail::with_linearisations(4)>{});
    case Method::rotation_vectors: return with(CandidateContacts<detail::with_rotation_vectors()>{});
    case Method::certificate: return with(CandidateContacts<detail::with_certificate()>{});
    case Method::all_corrections: return with(CandidateContacts<detail::corrected()>{});
    case Method::standard: return with(ClosestFeatures{});
    case Method::paper:
    case Method::shared_metric: break;
  }
  return with(CandidateContacts<>{});
}

extern template Run run_with_tool(const scenes::Scene&, const Segment<double>&, const Settings<double>&, Method, double, bool);
extern template Run run_with_tool(const scenes::Scene&, const Box<double>&, const Settings<double>&, Method, double, bool);

}  // namespace feeler::experiments
