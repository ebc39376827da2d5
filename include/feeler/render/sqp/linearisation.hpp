// The working set and its rows, at one pose at a time: measured only where a step may meet them, and only where the tool has moved.
#pragma once

#include <limits>
#include <optional>

#include "feeler/contact/contact_patch.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/surface_walk.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/sweep_result.hpp"
#include "feeler/render/constraints/closest_points_of_pair.hpp"
#include "feeler/render/constraints/covering_planes.hpp"
#include "feeler/render/constraints/kept_contacts.hpp"
#include "feeler/render/constraints/working_set.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/sqp/step_problem.hpp"
#include "feeler/render/tick.hpp"

namespace feeler {

/// The pairs near the tool, linearised.
///
/// A motion is linearised where it starts, at a certified pose (`start_carried`, `start_measured`), and again where its steps end (`move_to`).
/// A pair that its last plane parts from the tool by some margins is left out, until a step would take the tool across that plane
/// (`add_crossed`). Of a convex tool, a pair that had no rows of its own is not measured where it lies below the plane of one that has.
/// Where a motion starts no farther than a step tolerance from where the last one was linearised, its rows are carried
/// there: the features that meet are the same. Of rows that ask the same of a step only the first is in the problem: a pair may
/// have none of its own.
/// @cost  noexcept, no allocation; `tick.work` grows by one for each distance query, and for every few planes
template <RigidTool ToolType, QpSolver Solver>
class Linearisation {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using MeshScalar = typename Scene::MeshScalar;
  using Piece = typename Scene::Piece;
  using Row = ContactRowOf<Piece>;
  static constexpr bool is_convex = maximum_pieces<ToolType> == 1;
  using Pairs = WorkingSet<Scalar, 256>;
  using Problem = StepProblem<Solver, 256, Row>;
  static constexpr int unlimited = (std::numeric_limits<int>::max)();

  explicit Linearisation(const Scene& scene) : near_vertices_(largest_vertex_count(scene)) {}

  void clear() noexcept {
    pairs_.clear();
    problem_.forget();
    stops_.clear();
    has_rows_ = false;
    planes_ = 0;
  }

  Pairs& pairs() noexcept { return pairs_; }
  const Pairs& pairs() const noexcept { return pairs_; }
  Problem& problem() noexcept { return problem_; }
  const Problem& problem() const noexcept { return problem_; }
  /// What is nearer touches: any motion may meet it [m].
  static Scalar touching(const Scene& scene) noexcept { return 4 * scene.margin(); }
  /// Whether nothing was near.
  bool is_empty() const noexcept { return problem_.row_count() == 0 && !leaves_out_pairs_; }

  /// Rows where a motion starts, and the planes that its certificate starts from; false where the work ran out, and `go_on` measures the rest.
  /// @param pose   certified
  /// @param reach  what is farther from the tool cannot stop the next step [m]
  /// @param limit  of `tick.work`, here and below
  bool start_measured(const Scene& scene, const Pose<Scalar>& pose, Scalar reach, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    start_at(pose, reach);
    begin_to_measure();
    return go_on(scene, tick, limit);
  }
  /// Measures what a start, a move or this had no work for; false where the work ran out again. Those pairs come last that may be covered by others.
  /// In a fit all around a tool of several pieces the next step may take any of many, and each is measured.
  bool go_on(const Scene& scene, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    for (; next_pair_ < pairs_.size(); ++next_pair_) {
      if (is_convex && pairs_[next_pair_].is_quiet()) quiet_.push_back(next_pair_);
      else if (!measure_if_near(scene, pairs_[next_pair_], tick, limit)) return false;
    }
    for (; next_quiet_ < quiet_.size(); ++next_quiet_) {
      Pair& pair = pairs_[quiet_[next_quiet_]];
      if (!is_covered(scene, pair) && !measure_if_near(scene, pair, tick, limit)) return false;
    }
    has_rows_ = measure_nearer(scene, tick, limit);
    tick.rows = problem_.row_count();
    return has_rows_;
  }

  /// The same with the rows of the last linearisation; false where that was not near, or a plane of it parts its pair by less than a certificate
  /// requires, or the work ran out: called again at that pose it goes on.
  bool start_carried(const Scene& scene, const Pose<Scalar>& pose, Scalar reach, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    if (!has_rows_ || problem_.rests_on_kept()) return false;  // rows of the features that the tool was to leave
    const Twist<Scalar> motion = scene.idle_turns().motion_between(pose_, pose);
    if (scene.length_of(motion, pose) > Scalar(scene.settings().step_tolerance)) return false;
    start_at(pose, reach);
    for (Pair& pair : pairs_) {
      if (pair.state == PairState::left_out) continue;
      if (!holds_at_start(scene, pair, pair.last_normal, scene.clearance().required(pair.slack), tick)) return false;
      pair.is_ghost = pair.state == PairState::ghost;
    }
    const bool are_carried = carry_rows(scene, motion, tick, [&](const Row& row, const Pair& pair) {
      if (pair.state != PairState::has_rows) return false;
      keep_if_touching(scene, row, pair);
      return true;
    });
    if (!are_carried) return false;
    for (Pair& pair : pairs_) {
      if (pair.state == PairState::left_out && !measure_if_near(scene, pair, tick, limit)) return false;
    }
    has_rows_ = measure_nearer(scene, tick, limit);
    tick.rows = problem_.row_count();
    return has_rows_;
  }

  /// Rows where a step ended; false where the work ran out, and `go_on` measures the rest.
  /// @param assumes_valleys  as `ContactPatch` has it
  bool move_to(const Scene& scene, const Pose<Scalar>& pose, bool assumes_valleys, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    put_at(pose);
    is_at_start_ = false;
    assumes_valleys_ = assumes_valleys;
    begin_to_measure();
    return go_on(scene, tick, limit);
  }

  /// The rows of the last pose where a capped step ended: what holds the tool there is known, and the next motion measures it. False where
  /// they cannot be carried.
  bool carry_to(const Scene& scene, const Pose<Scalar>& pose, Tick<MeshScalar>& tick) noexcept {
    if (problem_.rests_on_kept()) return false;
    const Twist<Scalar> motion = scene.idle_turns().motion_between(pose_, pose);
    put_at(pose);
    is_at_start_ = false;
    for (const Pair& pair : pairs_) leaves_out_pairs_ = leaves_out_pairs_ || pair.state == PairState::left_out;
    return carry_rows(scene, motion, tick, [](const Row&, const Pair&) { return true; });
  }

  /// Adds the rows of pairs left out whose planes a step crosses, as far as the work goes; false if there are none.
  bool add_crossed(const Scene& scene, const Twist<Scalar>& step, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    if (!leaves_out_pairs_) return false;
    const Pose<Scalar> end = scene.idle_turns().moved(pose_, step);
    const Matrix3<Scalar> axes = end.rotation.toRotationMatrix();
    bool adds = false;
    for (Pair& pair : pairs_) {
      if (pair.state != PairState::left_out || pair.is_beyond(reach_)) continue;
      if (tick.work >= limit) break;
      if (slack_along(scene, pair, pair.normal, end, axes, tick) > scene.margin()) continue;
      measure(scene, pair, tick);
      adds = true;
    }
    measure_nearer(scene, tick, limit);
    tick.rows = problem_.row_count();
    return adds;
  }

  /// Before rows of the start are kept: none is in the problem.
  void release_kept() noexcept { kept_.release(); }
  /// Whether there are rows that a motion from the start may break.
  bool may_break() const noexcept { return !kept_.empty(); }
  /// Adds the rows of the start that a motion from there would break; false if it breaks none.
  bool keep_broken(const Scene& scene, const Twist<Scalar>& motion) noexcept {
    const auto so_far = [&] { return scene.idle_turns().motion_between(start_, pose_); };
    return kept_.keep_broken(so_far, motion, scene.margin(), problem_);
  }

  /// What stopped a step.
  struct Stop {
    Row row;  // where the step began
    Scalar multiplier;  // of the metric [m]
    Scalar gap;  // after the step [m]
  };

  /// Remembers what stopped a step.
  void remember_stops(const Twist<Scalar>& step) noexcept {
    stops_.clear();
    stopped_ = step;
    for (const auto& active : problem_.solution().active) {
      stops_.push_back({problem_.row(active.row), active.multiplier, problem_.gap_after(active.row)});
    }
  }
  const auto& stops() const noexcept { return stops_; }
  /// The step last remembered.
  const Twist<Scalar>& stopped() const noexcept { return stopped_; }
  /// Adds what stopped the last step, but for what was assumed, to the rows where it ended; false if they have it all.
  bool keep_stops(const Scene& scene) noexcept {
    bool adds = false;
    const Displacement<Scalar> stopped = stopped_;
    for (const Stop& stop : stops_) {
      const Row row = stop.row.carried(stopped);
      if (row.is_assumed || problem_.repeats(row)) continue;
      adds = problem_.keep(row, certified_gap(scene, pairs_[pairs_.find(row.piece, row.triangle)])) || adds;
    }
    return adds;
  }

  /// Takes the triangles that the contacts of a solution pass over to into the working set, as far as the work goes: the row of one they have left
  /// hides them.
  void learn_passed(const Scene& scene, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    std::optional<Displacement<Scalar>> step;
    for (const auto& active : problem_.solution().active) {
      const Row& row = problem_.row(active.row);
      if (row.kind != FeaturePair::vertex_face || problem_.is_relaxed() || pairs_.full() || tick.work >= limit) continue;
      if (!step) step.emplace(Twist<Scalar>::from_vector(problem_.solution().step));
      const Vector3<Scalar> point = pose_.translation + step->linear + row.carried(*step).arm;
      const int triangle = triangle_under(scene.object(), row.triangle, point);
      if (triangle < 0 || pairs_.find(row.piece, triangle) >= 0) continue;
      take_in_as_at_start(scene, row.piece, triangle, pairs_[pairs_.find(row.piece, row.triangle)].features, tick);
    }
  }

  /// Takes what is near where a motion ended into the working set; false if all of it was there.
  bool notice(const Scene& scene, const NoticedTriangles& all) noexcept {
    bool is_new = false;
    for (const Noticed& noticed : all) {
      if (pairs_.find(noticed.piece, noticed.triangle) >= 0) continue;
      take_in(scene, noticed.piece, noticed.triangle, noticed.features);
      is_new = true;
    }
    return is_new;
  }

  /// Takes what blocked a motion into the working set; false when another linearisation would find no more than the last, as all of it was
  /// there already with rows of its own, and it is the way that meets it.
  bool admit(const Scene& scene, const SweepResult<Scalar>& result) noexcept {
    bool is_new = false, meets_left_out = false, meets_touching = false;
    for (const auto& blocker : result.blockers) {
      const int i = pairs_.find(blocker.piece, blocker.triangle);
      if (i < 0) {
        take_in(scene, blocker.piece, blocker.triangle, blocker.features);
        is_new = true;
        continue;
      }
      Pair& pair = pairs_[i];
      pair.note_use();
      if (pair.state == PairState::ghost) {
        is_new = pair.keeps_ghost = true;
        pair.state = PairState::left_out;  // to be measured again, where all else is carried
      } else if (pair.slack < touching(scene)) {
        meets_touching = true;
        if (is_convex && pair.state == PairState::repeats) pair.state = PairState::left_out;  // to be measured, whatever covers it
      } else if (pair.state == PairState::left_out) {
        meets_left_out = true;
      }
    }
    // What touches stops the tool before what was left out comes near.
    return is_new || (meets_left_out && !meets_touching);
  }

 private:
  using Pair = typename Pairs::Pair;
  using Standing = typename Problem::Standing;

  static constexpr int planes_per_work = 16;

  void put_at(const Pose<Scalar>& pose) noexcept {
    pose_ = pose;
    axes_ = pose.rotation.toRotationMatrix();
    leaves_out_pairs_ = false;
    covers_.clear();
  }

  void start_at(const Pose<Scalar>& pose, Scalar reach) noexcept {
    put_at(pose);
    start_ = pose;
    is_at_start_ = true;
    assumes_valleys_ = true;
    reach_ = reach;
    has_rows_ = false;
    kept_.clear();
    forget_nearer();
  }

  void begin_to_measure() noexcept {
    problem_.clear();
    walls_.clear();
    forget_nearer();
    quiet_.clear();
    next_pair_ = next_quiet_ = 0;
  }

  /// Moves all rows by a motion; false where `may_carry(row, its pair)` is, or where a pair has left, and others may repeat it.
  template <class MayCarry>
  bool carry_rows(const Scene& scene, const Displacement<Scalar>& motion, Tick<MeshScalar>& tick, const MayCarry& may_carry) noexcept {
    has_rows_ = problem_.carry(motion, [&](const Row& row) -> std::optional<Standing> {
      const int i = pairs_.find(row.piece, row.triangle);
      if (i < 0 || !may_carry(row, pairs_[i])) return {};
      return standing_of(scene, pairs_[i]);
    });
    tick.rows = problem_.row_count();
    return has_rows_;
  }

  /// The corners of a pair, seen from the tool's reference point in world axes.
  Matrix3<Scalar> from_tool(const Pair& pair) const noexcept { return pair.corners_world.colwise() - pose_.translation; }

  /// Whether the plane of a pair just measured parts this one too: the other's rows hold the tool for both.
  bool is_covered(const Scene& scene, Pair& pair) noexcept {
    const auto cover = covers_.above(from_tool(pair), scene.margin() / 1000, touching(scene));
    if (!cover) return false;
    pair.last_normal = cover->normal;
    if (is_at_start_) pair.set_plane(cover->normal, cover->distance);
    return true;
  }

  /// False where there is no work left for it.
  bool measure_if_near(const Scene& scene, Pair& pair, Tick<MeshScalar>& tick, int limit) noexcept {
    if (tick.work >= limit) return false;
    if (is_far(scene, pair, tick)) {
      pair.state = PairState::left_out;
      leaves_out_pairs_ = true;
    } else {
      measure(scene, pair, tick);
    }
    return true;
  }

  /// Whether the plane of a pair parts it from the tool by more than what touches.
  bool is_far(const Scene& scene, Pair& pair, Tick<MeshScalar>& tick) noexcept {
    if (pair.is_beyond(reach_)) return true;
    if (!pair.has_plane()) return false;
    if (is_at_start_) return holds_at_start(scene, pair, pair.normal, touching(scene), tick);
    return slack_along(scene, pair, pair.normal, pose_, axes_, tick) > touching(scene);
  }

  /// Whether a plane parts a pair where the motion starts by more than a distance; then it is the pair's.
  bool holds_at_start(const Scene& scene, Pair& pair, const Vector3<Scalar>& normal, Scalar least, Tick<MeshScalar>& tick) noexcept {
    const Scalar slack = slack_along(scene, pair, normal, pose_, axes_, tick);
    if (!(slack > least)) return false;
    pair.set_plane(normal, slack);
    return true;
  }

  /// Separation of a pair along a world normal at a pose with the axes given [m].
  FEELER_FLATTEN Scalar slack_along(const Scene& scene, const Pair& pair, const Vector3<Scalar>& normal, const Pose<Scalar>& pose,
                                    const Matrix3<Scalar>& axes, Tick<MeshScalar>& tick) noexcept {
    if (++planes_ >= planes_per_work) {
      planes_ = 0;
      ++tick.work;
    }
    const Piece& piece = scene.piece(pair.piece);
    const Scalar lowest = lowest_above(piece, scene.reference(), Vector3<Scalar>(axes.transpose() * normal)) - swept_radius(piece);
    return lowest - highest_corner<Scalar>(pair.corners_world.colwise() - pose.translation, normal);
  }

  /// Measures a pair where the rows are, and adds its rows.
  FEELER_FLATTEN void measure(const Scene& scene, Pair& pair, Tick<MeshScalar>& tick) noexcept {
    const Matrix3<Scalar> corners = scene.in_tool(pair.corners_world, pose_, axes_);
    const auto closest = query(scene, pair, corners, axes_, is_at_start_, tick);
    ContactPatch<Piece, MeshScalar> patch(scene.piece(pair.piece), scene.incidence(pair.piece), scene.object(), axes_, scene.reference(),
                                          scene.trust_radius() / 8, assumes_valleys_, near_vertices_);
    pair.state = patch.find(pair.triangle, corners, closest, pair.keeps_ghost, patch_rows_) ? PairState::repeats : PairState::ghost;
    pair.is_filler = patch.is_filler();
    if (is_at_start_) pair.is_ghost = pair.state == PairState::ghost;
    const auto bring = [&](int triangle, const WitnessFeatures& features) {
      if (pairs_.find(pair.piece, triangle) < 0) nearer_.push_back({pair.piece, triangle, features});
    };
    if (pair.state == PairState::ghost && closest.distance < touching(scene)) {
      const int nearer = patch.nearer_triangle(closest);
      if (nearer >= 0) bring(nearer, pair.features);
    }
    const Scalar too_near = scene.noticed();
    // Without clearance all walls touch, and the certificate tells which of them hold.
    if (closest.distance < too_near && !pairs_.has_no_clearance(scene.clearance().none())) {
      patch.visit_continuations(too_near, [&](int triangle) { bring(triangle, {}); });
    }
    if (closest.distance < touching(scene) && !pairs_.has_no_clearance(scene.clearance().none()) && is_first_on_wall(scene, pair)) {
      patch.visit_rim([&](int triangle) { return pairs_.find(pair.piece, triangle) >= 0; }, [&](int triangle) { bring(triangle, {}); });
    }
    for (Row& row : patch_rows_) {
      row.piece = pair.piece;
      row.triangle = pair.triangle;
      if (problem_.repeats(row)) continue;
      pair.state = PairState::has_rows;
      problem_.add(row, standing_of(scene, pair));
      if (is_at_start_) keep_if_touching(scene, row, pair);
    }
    if constexpr (is_convex) {
      if (pair.state == PairState::has_rows && !pair.keeps_ghost && !closest.is_touching)
        covers_.add(pair.last_normal, from_tool(pair), closest.distance);
    }
  }

  /// Whether a pair is the first of its wall and piece since the rows were last cleared.
  bool is_first_on_wall(const Scene& scene, const Pair& pair) noexcept {
    const OnWall at{pair.piece, scene.object().walls().of_triangle(pair.triangle)};
    if (at.wall < 0 ||
        std::any_of(walls_.begin(), walls_.end(), [&](const OnWall& other) { return other.piece == at.piece && other.wall == at.wall; }))
      return false;
    return walls_.push_back(at);
  }

  /// Takes in, and measures, the neighbours of ghosts that are to hold the tool in their place, and those that continue a face that touches. They
  /// never blocked a motion: it may come closer than the margin. So the tool would, and turn back where the ghost is none any more, or rest on an
  /// edge of a tool that is all but flat on the face. False where the work ran out.
  bool measure_nearer(const Scene& scene, Tick<MeshScalar>& tick, int limit) noexcept {
    for (; next_nearer_ < nearer_.size() && !pairs_.full(); ++next_nearer_) {  // one of them may be a ghost, and add another
      const Nearer nearer = nearer_[next_nearer_];
      if (pairs_.find(nearer.piece, nearer.triangle) >= 0) continue;
      if (tick.work >= limit) return false;
      Pair& pair = is_at_start_ ? take_in(scene, nearer.piece, nearer.triangle, nearer.features)
                                : take_in_as_at_start(scene, nearer.piece, nearer.triangle, nearer.features, tick);
      measure(scene, pair, tick);
    }
    forget_nearer();
    return true;
  }
  void forget_nearer() noexcept {
    nearer_.clear();
    next_nearer_ = 0;
  }

  /// Separation of a pair where the motion starts, 0 where that is none [m].
  static Scalar certified_gap(const Scene& scene, const Pair& pair) noexcept {
    return pair.slack > scene.clearance().negligible() ? pair.slack : Scalar(0);
  }
  static Standing standing_of(const Scene& scene, const Pair& pair) noexcept { return {certified_gap(scene, pair), pair.is_spare()}; }

  /// Closest points of a pair, as `closest_points_of`, and what is remembered of them.
  static ClosestPoints<Scalar> query(const Scene& scene, Pair& pair, const Matrix3<Scalar>& corners, const Matrix3<Scalar>& axes, bool is_at_start,
                                     Tick<MeshScalar>& tick) noexcept {
    const auto closest = closest_points_of(pair, scene, corners, axes, is_at_start);
    ++tick.work;
    pair.last_normal = axes * closest.normal;
    if (is_at_start) pair.set_plane(pair.last_normal, closest.distance);
    return closest;
  }

  /// A contact so close that any motion may break it is kept; where there is no clearance at all, rounding decides which is.
  void keep_if_touching(const Scene& scene, const Row& row, const Pair& pair) noexcept {
    const bool touches = row.gap > scene.margin() / 1000 && row.gap < touching(scene);
    if (touches && !problem_.is_relaxed() && !row.is_assumed) kept_.add(row, certified_gap(scene, pair));
  }

  /// @param features  to start its first query from
  Pair& take_in(const Scene& scene, int piece, int triangle, WitnessFeatures features) noexcept {
    Pair& pair = pairs_.add(piece, triangle, scene.object().corners(triangle).template cast<Scalar>());
    pair.features = features;
    return pair;
  }
  /// The same on the way of a motion, with the plane that the pair had where that starts.
  Pair& take_in_as_at_start(const Scene& scene, int piece, int triangle, WitnessFeatures features, Tick<MeshScalar>& tick) noexcept {
    Pair& pair = take_in(scene, piece, triangle, features);
    const Matrix3<Scalar> axes = start_.rotation.toRotationMatrix();
    query(scene, pair, scene.in_tool(pair.corners_world, start_, axes), axes, true, tick);
    return pair;
  }

  /// A neighbour of a pair's triangle, that is to hold the tool in its place or beside it.
  struct Nearer {
    int piece, triangle;
    WitnessFeatures features;  // to start its first query from
  };

  struct OnWall {
    int piece, wall;
  };

  static int largest_vertex_count(const Scene& scene) noexcept {
    int largest = 0;
    for (int i = 0; i < scene.piece_count(); ++i) largest = (std::max)(largest, scene.piece(i).vertex_count());
    return largest;
  }

  Pairs pairs_;
  Problem problem_;
  FixedVector<OnWall, 64> walls_;  // that pieces touch where the rows are
  KeptContacts<Row, Problem::row_capacity> kept_;
  CoveringPlanes<Scalar> covers_;  // of the pairs measured where the rows are
  FixedVector<Nearer, 16> nearer_;  // that are no pairs yet
  FixedVector<int, Pairs::capacity> quiet_;  // pairs that others may cover
  int next_pair_ = 0, next_quiet_ = 0, next_nearer_ = 0;  // to be measured
  FixedVector<Stop, QpSolution<Scalar>::active_capacity> stops_;  // of the last step
  Twist<Scalar> stopped_;  // that step
  PatchRows<Scalar, Row> patch_rows_;  // of the pair at hand
  VertexSet near_vertices_;  // likewise
  Pose<Scalar> start_;  // where the motion starts
  Pose<Scalar> pose_;  // where the rows are
  Matrix3<Scalar> axes_;  // there
  Scalar reach_ = Scalar(0);
  bool is_at_start_ = false;
  bool assumes_valleys_ = true;
  bool has_rows_ = false;  // since the last `clear`
  bool leaves_out_pairs_ = false;
  int planes_ = 0;  // looked along since `tick.work` last grew for them
};

}  // namespace feeler
