// The working set and its rows, at one pose at a time: measured only where a step may meet them, and only where the tool has moved.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "feeler/contact/contact_patch.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/surface_walk.hpp"
#include "feeler/render/constraints/kept_contacts.hpp"
#include "feeler/render/constraints/neighbour_queue.hpp"
#include "feeler/render/constraints/pair_separation.hpp"
#include "feeler/render/constraints/working_set.hpp"
#include "feeler/render/constraints/working_set_growth.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/sqp/active_rows.hpp"
#include "feeler/render/sqp/step_problem.hpp"
#include "feeler/render/tick.hpp"

namespace feeler {

/// The pairs near the tool, linearised where a motion starts (`start_carried`, `start_measured`), and where its steps end (`move_to`, `carry_to`).
///
/// A pair that its last plane parts from the tool by some margins is left out, until a step would take the tool across that plane
/// (`add_crossed`). Of a convex tool, a pair that had no rows of its own is not measured where it lies below the plane of one that has.
/// Of rows that ask the same of a step only the first is in the problem: a pair may have none of its own.
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

  explicit Linearisation(const Scene& scene) : problem_(scene.unit_of_solver()), near_vertices_(scene.largest_vertex_count()) {}

  void clear() noexcept {
    pairs_.clear();
    problem_.forget();
    stops_.clear();
    has_rows_ = false;
    separation_.clear();
  }

  Pairs& pairs() noexcept { return pairs_; }
  const Pairs& pairs() const noexcept { return pairs_; }
  Problem& problem() noexcept { return problem_; }
  const Problem& problem() const noexcept { return problem_; }
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
      if (!separation_.try_cover(scene, pair) && !measure_if_near(scene, pair, tick, limit)) return false;
    }
    return finish(scene, tick, limit);
  }

  /// The same with the rows of the last linearisation, carried here: the same features meet. False if that was farther away than a step tolerance, if
  /// the plane of a pair parts it by less than a certificate requires, or if the work ran out; a later call then goes on.
  bool start_carried(const Scene& scene, const Pose<Scalar>& pose, Scalar reach, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    if (!has_rows_ || problem_.rests_on_kept()) return false;  // rows of the features that the tool was to leave
    const Twist<Scalar> motion = scene.idle_turns().motion_between(separation_.pose(), pose);
    if (scene.length_of(motion, pose) > scene.step_tolerance()) return false;
    start_at(pose, reach);
    for (Pair& pair : pairs_) {
      if (pair.state == PairState::left_out) continue;
      if (!separation_.try_plane_at_start(scene, pair, pair.last_normal, scene.clearance().required(pair.slack), tick.work)) return false;
      pair.is_ghost = pair.state == PairState::ghost;
    }
    const bool are_carried = carry_rows(scene, motion, tick, [&](const Row& row, Pair& pair) {
      if (pair.state != PairState::has_rows) return false;
      separation_.try_plane_of_row(scene, pair, row.normal, tick.work);
      keep_if_touching(scene, row, pair);
      return true;
    });
    if (!are_carried) return false;
    for (Pair& pair : pairs_)
      if (pair.state == PairState::left_out && !measure_if_near(scene, pair, tick, limit)) return false;
    return finish(scene, tick, limit);
  }

  /// Rows where a step ended; false where the work ran out, and `go_on` measures the rest.
  /// @param may_assume  as `ContactPatch` has it
  bool move_to(const Scene& scene, const Pose<Scalar>& pose, bool may_assume, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    separation_.put_at(pose, false);
    leaves_out_pairs_ = false;
    may_assume_ = may_assume;
    begin_to_measure();
    return go_on(scene, tick, limit);
  }

  /// The rows of the last pose where a capped step ended: what holds the tool there is known, and the next motion measures it. False where
  /// they cannot be carried.
  bool carry_to(const Scene& scene, const Pose<Scalar>& pose, Tick<MeshScalar>& tick) noexcept {
    if (problem_.rests_on_kept()) return false;
    const Twist<Scalar> motion = scene.idle_turns().motion_between(separation_.pose(), pose);
    separation_.put_at(pose, false);
    leaves_out_pairs_ = std::any_of(pairs_.begin(), pairs_.end(), [](const Pair& pair) { return pair.state == PairState::left_out; });
    return carry_rows(scene, motion, tick, [](const Row&, const Pair&) { return true; });
  }

  /// Adds the rows of pairs left out whose planes a step crosses, as far as the work goes; false if there are none.
  bool add_crossed(const Scene& scene, const Twist<Scalar>& step, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    if (!leaves_out_pairs_) return false;
    const Pose<Scalar> end = scene.idle_turns().moved(separation_.pose(), step);
    const Matrix3<Scalar> axes = end.rotation.toRotationMatrix();
    bool adds = false;
    for (Pair& pair : pairs_) {
      if (pair.state != PairState::left_out || pair.is_beyond(reach_)) continue;
      if (tick.work >= limit) break;
      if (separation_.slack_along(scene, pair, pair.normal, end, axes, tick.work) > scene.margin()) continue;
      measure(scene, pair, tick);
      adds = true;
    }
    measure_neighbours(scene, tick, limit);
    tick.rows = problem_.row_count();
    return adds;
  }

  /// As `PairSeparation::keeps`, for all pairs that a step may meet.
  bool keeps(const Scene& scene, Scalar distance, const Pose<Scalar>& at, int& work) noexcept {
    return separation_.keeps(scene, pairs_, distance, at, reach_, work);
  }
  /// Before rows of the start are kept: none is in the problem.
  void release_kept() noexcept { kept_.release(); }
  /// Adds the rows of the start that a motion from there would break; false if it breaks none.
  bool keep_broken(const Scene& scene, const Twist<Scalar>& motion) noexcept {
    return kept_.keep_broken([&] { return scene.idle_turns().motion_between(start_, separation_.pose()); }, motion, scene.margin(), problem_);
  }
  /// What stopped the last step that was remembered.
  auto& stops() noexcept { return stops_; }
  /// Adds what stopped the last step, but for what was assumed, to the rows where it ended; false if they have it all.
  bool keep_stops(const Scene& scene) noexcept {
    return stops_.keep_in(problem_, [&](const Row& row) { return scene.clearance().to_leave(pair_of(row).slack); });
  }

  /// Takes in the triangles that the contacts of a solution pass over to, as far as the work goes: the row of one they have left hides them.
  void learn_passed(const Scene& scene, Tick<MeshScalar>& tick, int limit = unlimited) noexcept {
    std::optional<Displacement<Scalar>> step;
    for (const auto& active : problem_.solution().active) {
      const Row& row = problem_.row(active.row);
      if (row.kind != FeaturePair::vertex_face || problem_.is_relaxed() || pairs_.full() || tick.work >= limit) continue;
      if (!step) step.emplace(Twist<Scalar>::from_vector(problem_.solution().step));
      const Vector3<Scalar> point = separation_.pose().translation + step->linear + row.carried(*step).arm;
      const int triangle = triangle_under(scene.object(), row.triangle, point);
      if (triangle < 0 || pairs_.find(row.piece, triangle) >= 0) continue;
      take_in_as_at_start(scene, row.piece, triangle, pair_of(row).features, tick);
    }
  }

 private:
  using Pair = typename Pairs::Pair;
  using Standing = typename Problem::Standing;

  /// The pair of a row in the problem, or of the last step: none is dropped amid a motion.
  const Pair& pair_of(const Row& row) const noexcept { return pairs_[pairs_.find(row.piece, row.triangle)]; }

  void start_at(const Pose<Scalar>& pose, Scalar reach) noexcept {
    separation_.put_at(pose, true);
    leaves_out_pairs_ = false;
    start_ = pose;
    may_assume_ = true;
    reach_ = reach;
    has_rows_ = false;
    kept_.clear();
    neighbours_.clear();
  }

  void begin_to_measure() noexcept {
    problem_.clear();
    neighbours_.forget_all();
    quiet_.clear();
    next_pair_ = next_quiet_ = 0;
  }

  /// Moves all rows by a motion, but for those whose pair has left; false where `may_carry(row, its pair)` is, or where others repeat such a row.
  template <class MayCarry>
  bool carry_rows(const Scene& scene, const Displacement<Scalar>& motion, Tick<MeshScalar>& tick, const MayCarry& may_carry) noexcept {
    has_rows_ = true;
    problem_.carry(motion, [&](const Row& row) -> std::optional<Standing> {
      const int i = pairs_.find(row.piece, row.triangle);
      if (i >= 0 && may_carry(row, pairs_[i])) return standing_of(scene, pairs_[i]);
      has_rows_ = has_rows_ && i < 0 && !row.is_repeated;
      return {};
    });
    tick.rows = problem_.row_count();
    return has_rows_;
  }

  /// False where there is no work left for it.
  bool measure_if_near(const Scene& scene, Pair& pair, Tick<MeshScalar>& tick, int limit) noexcept {
    if (tick.work >= limit) return false;
    const bool is_parted = separation_.try_own_plane(scene, pair, reach_, tick.work);
    leaves_out_pairs_ = leaves_out_pairs_ || is_parted;
    if (is_parted) pair.state = PairState::left_out;
    else measure(scene, pair, tick);
    return true;
  }

  /// False where the work ran out before all rows were there.
  bool finish(const Scene& scene, Tick<MeshScalar>& tick, int limit) noexcept {
    has_rows_ = measure_neighbours(scene, tick, limit);
    tick.rows = problem_.row_count();
    return has_rows_;
  }

  /// Measures a pair where the rows are, and adds its rows.
  FEELER_FLATTEN void measure(const Scene& scene, Pair& pair, Tick<MeshScalar>& tick) noexcept {
    const Matrix3<Scalar> corners = separation_.corners_in_tool(scene, pair);
    const auto closest = separation_.query(scene, pair, corners, tick.work);
    ContactPatch<Piece, MeshScalar> patch(scene.piece(pair.piece), scene.incidence(pair.piece), scene.object(), separation_.axes(), scene.reference(),
                                          scene.patch_height(), may_assume_, near_vertices_);
    pair.state = patch.find(pair.triangle, corners, closest, pair.keeps_ghost, patch_rows_) ? PairState::repeats : PairState::ghost;
    pair.is_filler = patch.is_filler();
    if (separation_.is_at_start()) pair.is_ghost = pair.state == PairState::ghost;
    neighbours_.append(scene, pairs_, pair, patch, closest);
    for (Row& row : patch_rows_) {
      row.piece = pair.piece;
      row.triangle = pair.triangle;
      if (problem_.repeats(row)) continue;
      if (!problem_.add(row, standing_of(scene, pair))) break;
      pair.state = PairState::has_rows;
      if (separation_.is_at_start()) keep_if_touching(scene, row, pair);
    }
    if (is_convex && pair.state == PairState::has_rows && !pair.keeps_ghost && !closest.is_touching) separation_.add_cover(pair, closest.distance);
  }

  /// Takes in, and measures, the neighbours of what was measured; false where the work ran out.
  bool measure_neighbours(const Scene& scene, Tick<MeshScalar>& tick, int limit) noexcept {
    for (; !neighbours_.empty() && !pairs_.full(); neighbours_.pop()) {  // one of them may be a ghost, and add another
      const NeighbourQueue::Neighbour next = neighbours_.front();
      if (pairs_.find(next.piece, next.triangle) >= 0) continue;
      if (tick.work >= limit) return false;
      Pair& pair = separation_.is_at_start() ? take_in(pairs_, scene, next.piece, next.triangle, next.features)
                                             : take_in_as_at_start(scene, next.piece, next.triangle, next.features, tick);
      measure(scene, pair, tick);
    }
    neighbours_.clear();
    return true;
  }

  static Standing standing_of(const Scene& scene, const Pair& pair) noexcept { return {scene.clearance().to_leave(pair.slack), pair.is_spare()}; }

  /// A contact so close that any motion may break it is kept; where there is no clearance at all, rounding decides which is.
  void keep_if_touching(const Scene& scene, const Row& row, const Pair& pair) noexcept {
    const bool touches = row.gap > scene.margin() / 1000 && row.gap < scene.contact_distance();
    if (touches && !problem_.is_relaxed() && !row.is_assumed) kept_.add(row, scene.clearance().to_leave(pair.slack));
  }

  /// Takes in a triangle on the way of a motion, with the plane that the pair had where that starts.
  Pair& take_in_as_at_start(const Scene& scene, int piece, int triangle, WitnessFeatures features, Tick<MeshScalar>& tick) noexcept {
    Pair& pair = take_in(pairs_, scene, piece, triangle, features);
    separation_.query_at_start(scene, pair, start_, tick.work);
    return pair;
  }

  Pairs pairs_;
  Problem problem_;
  KeptContacts<Row, Problem::row_capacity> kept_;
  PairSeparation<Scene> separation_;  // where the rows are
  NeighbourQueue neighbours_;
  FixedVector<int, Pairs::capacity> quiet_;  // pairs that others may cover
  int next_pair_ = 0, next_quiet_ = 0;  // to be measured
  ActiveRows<Row, QpSolution<Scalar>::active_capacity> stops_;  // of the last step
  PatchRows<Scalar, Row> patch_rows_;  // of the pair at hand
  VertexSet near_vertices_;  // likewise
  Pose<Scalar> start_;  // where the motion starts
  Scalar reach_ = Scalar(0);
  bool may_assume_ = true;
  bool has_rows_ = false;  // since the last `clear`
  bool leaves_out_pairs_ = false;
};

}  // namespace feeler
