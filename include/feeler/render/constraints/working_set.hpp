// The few pairs of tool piece and triangle that hold the tool or lately did, from tick to tick.
#pragma once

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/gjk.hpp"

namespace feeler {

/// What became of a pair in the last linearisation.
enum class PairState : unsigned char {
  left_out,  ///< not measured: too far to matter, or new
  repeats,   ///< without rows, as those of other pairs are the same
  ghost,     ///< without rows, as a neighbour is nearer
  has_rows,
};

/// A triangle near a piece of the tool and what is known of the two at the last certified pose.
template <class Scalar>
struct WorkingPair {
  int piece = 0;
  int triangle = -1;
  Matrix3<Scalar> corners_world = Matrix3<Scalar>::Zero();  ///< one corner in each column [m]
  WitnessFeatures features;       ///< where the last query ended
  Vector3<Scalar> last_normal = Vector3<Scalar>::Zero();  ///< world normal that it found
  Vector3<Scalar> normal = Vector3<Scalar>::Zero();  ///< world normal that separates at the certified pose, or zero
  Scalar slack = Scalar(0);                          ///< separation there [m]
  Scalar moved = Scalar(0);                          ///< length of motions since that was measured [m]
  int unused_ticks = 0;     ///< ticks since it held the tool or blocked a motion
  PairState state = PairState::left_out;
  bool is_ghost = false;    ///< at the certified pose a neighbour was nearer, and its plane means nothing
  bool keeps_ghost = false; ///< it blocked although its row looked like a ghost: give it a row all the same
  bool wants_rim = false;   ///< without clearance: it touches, had its rows, and blocked all the same, so the rim of its wall holds the tool
  bool is_filler = false;   ///< its wall is held elsewhere as well: `ContactPatch::is_filler`

  /// It holds the tool, or blocks a motion.
  void note_use() noexcept { unused_ticks = 0; }
  /// It has done neither for long: others may hold the tool in its place.
  bool is_spare() const noexcept { return unused_ticks > 100; }
  /// It had no rows of its own when it was last measured.
  bool is_quiet() const noexcept { return (state == PairState::ghost || state == PairState::repeats) && !keeps_ghost; }
  bool has_plane() const noexcept { return normal.squaredNorm() > Scalar(0); }
  /// @param separation  along the normal at the certified pose [m]
  void set_plane(const Vector3<Scalar>& normal_world, Scalar separation) noexcept {
    normal = normal_world;
    slack = separation;
    moved = Scalar(0);
  }
  /// Whether the separation is certainly more than a distance [m].
  bool is_beyond(Scalar distance) const noexcept { return slack - moved > distance; }
};

/// The working set: constraints enter when they block a motion or are near where it ends, and leave as `age` says. Each is looked at wherever a
/// motion starts or a step ends, which costs more than to meet a few of them again.
template <class ScalarType, int pair_capacity = 48>
class WorkingSet {
 public:
  using Scalar = ScalarType;
  using Pair = WorkingPair<Scalar>;
  static constexpr int capacity = pair_capacity;
  /// Ticks for which a pair that touches may stay in the set unused: a shaft that fits touches its hole all around, and a few of those triangles hold it.
  static constexpr int longest_unused = 1000;
  static constexpr int longest_unused_filler = 8;

  int size() const noexcept { return pairs_.size(); }
  Pair& operator[](int i) noexcept { return pairs_[i]; }
  const Pair& operator[](int i) const noexcept { return pairs_[i]; }
  Pair* begin() noexcept { return pairs_.begin(); }
  Pair* end() noexcept { return pairs_.end(); }
  const Pair* begin() const noexcept { return pairs_.begin(); }
  const Pair* end() const noexcept { return pairs_.end(); }
  bool full() const noexcept { return pairs_.full(); }
  /// Whether a pair touches, with a separation below `none` [m]: without clearance all walls do. Of pairs that were not measured yet nothing is known.
  bool has_no_clearance(Scalar none) const noexcept {
    for (const Pair& pair : pairs_) {
      if (pair.has_plane() && pair.slack < none) return true;
    }
    return false;
  }
  void clear() noexcept { pairs_.clear(); }

  /// Position of a pair, or -1.
  int find(int piece, int triangle) const noexcept {
    for (int i = 0; i < pairs_.size(); ++i) {
      if (pairs_[i].triangle == triangle && pairs_[i].piece == piece) return i;
    }
    return -1;
  }

  /// Adds a pair, in place of the longest unused one when full, and returns it.
  Pair& add(int piece, int triangle, const Matrix3<Scalar>& corners_world) noexcept {
    if (pairs_.full()) {
      int longest = 0;
      for (int i = 1; i < pairs_.size(); ++i) {
        if (pairs_[i].unused_ticks > pairs_[longest].unused_ticks) longest = i;
      }
      pairs_.swap_remove(longest);
    }
    Pair pair;
    pair.piece = piece;
    pair.triangle = triangle;
    pair.corners_world = corners_world;
    pairs_.push_back(pair);
    return pairs_[pairs_.size() - 1];
  }

  /// The tool has moved, no point of it by more than a length.
  void approach(Scalar length) noexcept {
    for (Pair& pair : pairs_) pair.moved += length;
  }

  /// Counts a tick, and drops each pair that has been unused for more than one. A pair that touches, and whose rows do not repeat those of others, is
  /// dropped after `longest_unused` ticks, a filler after `longest_unused_filler`. A pair that would be noticed again stays.
  /// @param contact_distance  what is nearer touches [m]
  /// @param noticed           what is nearer would be noticed [m]; 0 where nothing is, as there is no clearance
  /// @param is_motion_left           the last tick left motion for this one, and ghosts that blocked it keep their rows
  void age(Scalar contact_distance, Scalar noticed, bool is_motion_left) noexcept {
    for (int i = pairs_.size() - 1; i >= 0; --i) {
      Pair& pair = pairs_[i];
      if (!is_motion_left) pair.keeps_ghost = pair.wants_rim = false;
      ++pair.unused_ticks;
      if (noticed > Scalar(0) && pair.slack < noticed) continue;
      const bool touches = pair.slack < contact_distance && pair.state != PairState::repeats;
      const int longest = !touches ? 1 : pair.is_filler ? longest_unused_filler : longest_unused;
      if (pair.unused_ticks > longest) pairs_.swap_remove(i);
    }
  }

 private:
  FixedVector<Pair, capacity> pairs_;
};

}  // namespace feeler
