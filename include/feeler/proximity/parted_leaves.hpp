// Leaves of a hierarchy that planes parted from the tool, and still do after it has moved a little.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "feeler/object/bvh.hpp"
#include "feeler/spatial/pose.hpp"

namespace feeler {

/// The front of a traversal, kept from motion to motion: of each leaf that it came to, a plane for each triangle and how far the tool was above that.
///
/// A tool in free play of a fit has triangles on all sides, and no few planes part it from all of them. But what was some way off is so yet: a
/// translation d lowers the tool along a normal n by −n·d, and a turn by no more than its angle times the radius. So one product for each triangle
/// tells, and where it does of all leaves under a node, that need not be visited (J. Klosowski et al., "Efficient collision detection using bounding
/// volume hierarchies of k-DOPs", 1998, on fronts). In single precision, rounded so that it parts less, never more.
///
/// It is kept where it pays: where many triangles are near, and most of its leaves stay parted.
template <class ScalarType>
class PartedLeaves {
 public:
  using Scalar = ScalarType;

  /// @param capacity       leaves
  /// @param worth_keeping  triangles that a motion comes to, from which on a front is kept as long as it pays; 0 for ever
  explicit PartedLeaves(int capacity = 0, int worth_keeping = 64)
      : leaves_(std::size_t(capacity)),
        bad_(std::size_t(capacity) + 1),
        notes_(BvhLeaf::width * std::size_t(capacity)),
        worth_keeping_(std::size_t(worth_keeping)) {}

  /// As it was made.
  void clear() noexcept {
    forget_leaves();
    asked_ = told_ = noted_ = 0;
    gain_ = motions_ = paused_ = 0;
    is_kept_ = false;
    rotation_ = Quaternion<Scalar>::Identity();
    origin_ = reference_ = Vector3<Scalar>::Zero();
    turned_ = Scalar(0);
  }
  bool empty() const noexcept { return count_ == 0; }
  /// Whether planes are worth a note.
  bool is_kept() const noexcept { return is_kept_; }

  /// Before a motion: finds which leaves are parted from the tool by a distance over all of it.
  /// @param kept  that distance [m]
  /// @return how many were looked at
  template <class Moving>
  int begin(const Moving& moving, const Scalar& kept) noexcept {
    if (!decide()) return 0;
    follow(moving);
    take_notes();
    const auto float_of = [](const Scalar& x) { return static_cast<float>(x); };
    const Vector3<float> start = Vector3<Scalar>(moving.origin() - reference_).template cast<float>(),
                         way = moving.motion().linear.template cast<float>();
    const float needed =
        above(float_of(kept) + float_of(turned_ + moving.turning()) + rounding(float_of(moving.radius()) + start.norm() + way.norm()));
    std::size_t count = 0;
    for (std::size_t l = 0; l < count_; ++l) {
      Leaf& leaf = leaves_[l];
      if (leaf.age++ > most_age) continue;
      leaf.parted = 0;
      for (std::size_t i = 0; i < width; ++i) {
        const float at_start = leaf.normal[0][i] * start[0] + leaf.normal[1][i] * start[1] + leaf.normal[2][i] * start[2];
        const float along = leaf.normal[0][i] * way[0] + leaf.normal[1][i] * way[1] + leaf.normal[2][i] * way[2];
        leaf.parted |= std::uint8_t((leaf.room[i] + at_start + (along < 0 ? along : 0) >= needed) << i);
      }
      bad_[count + 1] = bad_[count] + int(leaf.parted != all_lanes);
      places_[std::size_t(leaf.leaf) % place_count] = std::int16_t(count);
      if (count != l) leaves_[count] = leaf;
      ++count;
    }
    count_ = count;
    return int(count);
  }

  /// Whether all triangles of the leaves [first, last) are parted; these leaves have been asked for.
  bool are_parted(std::int32_t first, std::int32_t last) noexcept {
    const auto count = std::size_t(last - first);
    if (count > count_) return false;
    const std::size_t at = find(first);
    if (at + count > count_ || leaves_[at + count - 1].leaf != last - 1) return false;
    for (std::size_t i = at; i < at + count; ++i) leaves_[i].age = 0;
    if (bad_[at + count] != bad_[at]) return false;
    told_ += width * count;
    return true;
  }
  /// Whether one triangle of a leaf is parted; the leaf has been asked for.
  bool is_parted(std::int32_t leaf, std::size_t lane) noexcept {
    ++asked_;
    if (count_ == 0) return false;
    const std::size_t at = find(leaf);
    if (at == count_) return false;
    leaves_[at].age = 0;
    const unsigned parted = (leaves_[at].parted >> lane) & 1U;
    told_ += parted;
    return parted != 0;
  }

  /// A plane above a triangle of a leaf, for the motions to come.
  /// @param lanes  those of the leaf with a triangle, a bit each
  /// @param room   height of the tool above the triangle at the start of the motion at hand [m]
  void note(std::int32_t leaf, unsigned lanes, std::size_t lane, const Vector3<Scalar>& normal, const Scalar& room) noexcept {
    ++noted_;
    if (note_count_ == notes_.size()) return;
    const std::array<float, 3> n{static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])};
    const auto rest = static_cast<float>(Scalar(room - normal.dot(origin_ - reference_) + turned_));
    notes_[note_count_++] = {leaf, std::uint8_t(lane), std::uint8_t(lanes), n, rest - rounding(rest < 0 ? -rest : rest)};
  }

 private:
  static constexpr std::size_t width = BvhLeaf::width;
  static constexpr unsigned all_lanes = (1U << width) - 1U;
  static constexpr std::size_t place_count = 1024;
  static constexpr int most_age = 3;  // motions since it was asked for
  static constexpr int note_cost = 6;  // in triangles that need not be looked at
  static constexpr int trial = 3;  // motions after which it must have paid
  static constexpr int pause = 128;  // motions without a front where it has not

  struct Leaf {
    alignas(16) std::array<std::array<float, width>, 3> normal;
    std::array<float, width> room;  // at the reference, before any turn; −∞ where there is no plane, ∞ where there is no triangle [m]
    std::int32_t leaf = 0;
    std::uint8_t parted = 0;  // triangles, a bit each
    std::uint8_t age = 0;
  };
  struct Note {
    std::int32_t leaf;
    std::uint8_t lane, lanes;
    std::array<float, 3> normal;
    float room;
  };

  void forget_leaves() noexcept { count_ = note_count_ = 0; }

  /// Whether the front is kept for the motion to come: where many triangles are near, and it has told of more than it had to be told.
  bool decide() noexcept {
    const std::size_t met = std::exchange(asked_, 0) + width * count_;
    gain_ = gain_ / 2 + int(std::exchange(told_, 0)) - note_cost * int(std::exchange(noted_, 0));
    if (is_kept_ && ++motions_ >= trial && gain_ < 0 && worth_keeping_ > 0) paused_ = pause;
    const bool was_kept = std::exchange(is_kept_, !leaves_.empty() && paused_ == 0 && met >= worth_keeping_);
    if (paused_ > 0) --paused_;
    if (was_kept && !is_kept_) {
      forget_leaves();
      gain_ = motions_ = 0;
    }
    return is_kept_;
  }

  /// What rounding to single precision, some times, can gain of a length.
  static float rounding(float length) noexcept { return 8 * std::numeric_limits<float>::epsilon() * length; }
  static float above(float x) noexcept { return x + rounding(x); }

  /// Where a leaf is since the motion began, or past all where it is not, or another took its place in the table.
  std::size_t find(std::int32_t leaf) const noexcept {
    const auto at = std::size_t(places_[std::size_t(leaf) % place_count]);
    return at < count_ && leaves_[at].leaf == leaf ? at : count_;
  }
  /// Where a leaf is, or would be.
  std::size_t place_of(std::int32_t leaf) const noexcept {
    const auto at =
        std::lower_bound(leaves_.begin(), leaves_.begin() + std::ptrdiff_t(count_), leaf, [](const Leaf& a, std::int32_t b) { return a.leaf < b; });
    return std::size_t(at - leaves_.begin());
  }

  /// Where the tool has come to. What is as far from the reference as the tool is large is forgotten: it would lose digits.
  template <class Moving>
  void follow(const Moving& moving) noexcept {
    const Quaternion<Scalar>& rotation = moving.pose().rotation;
    if (count_ + note_count_ > 0) turned_ += moving.radius() * rotation.angularDistance(rotation_);
    rotation_ = rotation;
    origin_ = moving.origin();
    if (!((origin_ - reference_).norm() + turned_ < moving.radius())) {
      forget_leaves();
      reference_ = origin_;
      turned_ = Scalar(0);
    }
  }

  /// Merges the notes with the leaves, from the last to the first.
  void take_notes() noexcept {
    const auto notes = notes_.begin();
    std::sort(notes, notes + std::ptrdiff_t(note_count_),
              [](const Note& a, const Note& b) { return std::tie(a.leaf, a.lane, a.room) < std::tie(b.leaf, b.lane, b.room); });
    std::size_t old = count_;
    count_ += new_leaves();
    for (std::size_t at = count_, n = note_count_; n > 0;) {
      const std::int32_t leaf = notes_[n - 1].leaf;
      while (old > 0 && leaves_[old - 1].leaf > leaf) leaves_[--at] = leaves_[--old];
      Leaf& taker = leaves_[--at];
      taker = old > 0 && leaves_[old - 1].leaf == leaf ? leaves_[--old] : without_planes(notes_[n - 1]);
      taker.age = 0;
      for (; n > 0 && notes_[n - 1].leaf == leaf; --n) {
        const Note& note = notes_[n - 1];
        for (std::size_t k = 0; k < 3; ++k) taker.normal[k][note.lane] = note.normal[k];
        taker.room[note.lane] = note.room;
      }
    }
    note_count_ = 0;
  }
  /// How many leaves the notes add. Notes of leaves for which there is no place are dropped.
  std::size_t new_leaves() noexcept {
    std::size_t added = 0, kept = 0;
    for (std::size_t n = 0, l = 0; n < note_count_; ++n) {
      while (l < count_ && leaves_[l].leaf < notes_[n].leaf) ++l;
      const bool is_old = l < count_ && leaves_[l].leaf == notes_[n].leaf;
      const bool is_added = kept > 0 && notes_[kept - 1].leaf == notes_[n].leaf;
      if (!is_old && !is_added) {
        if (count_ + added == leaves_.size()) break;
        ++added;
      }
      notes_[kept++] = notes_[n];
    }
    note_count_ = kept;
    return added;
  }
  static Leaf without_planes(const Note& note) noexcept {
    Leaf leaf{};
    leaf.leaf = note.leaf;
    for (std::size_t i = 0; i < width; ++i)
      leaf.room[i] = ((note.lanes >> i) & 1U) != 0 ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity();
    return leaf;
  }

  std::vector<Leaf> leaves_;  // by number
  std::vector<int> bad_;  // of the leaves before each, those that are not parted
  std::array<std::int16_t, place_count> places_{};  // in which leaves were last found, by their number
  std::vector<Note> notes_;
  std::size_t worth_keeping_;
  std::size_t count_ = 0, note_count_ = 0;
  std::size_t asked_ = 0, told_ = 0, noted_ = 0;  // in the motion at hand: triangles asked for, found parted, and given a plane
  int gain_ = 0, motions_ = 0, paused_ = 0;
  bool is_kept_ = false;
  Quaternion<Scalar> rotation_ = Quaternion<Scalar>::Identity();  // of the tool at the last motion
  Vector3<Scalar> origin_ = Vector3<Scalar>::Zero();  // then
  Vector3<Scalar> reference_ = Vector3<Scalar>::Zero();
  Scalar turned_ = Scalar(0);  // bound on how far a point has turned since the reference was set [m]
};

}  // namespace feeler
