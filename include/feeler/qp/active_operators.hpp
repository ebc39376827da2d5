// The two operators of an active set: the projection off its rows, and what a force is in their multipliers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "feeler/core/scalar.hpp"
#include "feeler/qp/inverse_hessian.hpp"
#include "feeler/qp/lanes.hpp"

namespace feeler::detail {

/// P = H⁻¹ − H⁻¹N(NᵀH⁻¹N)⁻¹NᵀH⁻¹ and N* = (NᵀH⁻¹N)⁻¹NᵀH⁻¹ of the active rows N, in up to six slots.
///
/// Source: D. Goldfarb, A. Idnani, Mathematical Programming 27 (1983), section 3. The two are kept as one
/// matrix of twelve rows, P over N*: one product gives both images of a vector, and adding or dropping a row
/// changes it by one outer product. Rows of N* in free slots are zero.
template <RealScalar Scalar, int lanes>
class ActiveOperators {
 public:
  static constexpr int slot_count = 6;

  /// The images of a vector: `step` is P·v, and `share` is N*·v, a number a slot.
  struct Image {
    const Scalar& step(int j) const noexcept { return entries[index(j)]; }
    const Scalar& share(int slot) const noexcept { return entries[index(6 + slot)]; }
    Six<Scalar> step() const noexcept {
      return {entries[0], entries[1], entries[2], entries[3], entries[4], entries[5]};
    }
    alignas(64) std::array<Scalar, 16> entries;
  };

  /// Nothing active: P is H⁻¹.
  void reset(const InverseHessian<Scalar>& inverse) noexcept {
    is_used_.fill(false);
    used_ = 0;
    clear(inverse);
  }

  int used() const noexcept { return used_; }
  bool is_used(int slot) const noexcept { return is_used_[index(slot)]; }
  int free_slot() const noexcept {
    int slot = 0;
    while (is_used(slot)) ++slot;
    return slot;
  }
  const Six<Scalar>& normal(int slot) const noexcept { return normals_[index(slot)]; }
  /// Row of N*: the step that moves along this active row by one and along no other.
  Six<Scalar> dual(int slot) const noexcept {
    Six<Scalar> row;
    for (std::size_t j = 0; j < 6; ++j) row[j] = columns_[j][index(6 + slot)];
    return row;
  }
  SixBySix<Scalar> projector() const noexcept {
    SixBySix<Scalar> p;
    for (std::size_t j = 0; j < 6; ++j) std::copy_n(columns_[j].begin(), 6, p[j].begin());
    return p;
  }

  void apply(const Six<Scalar>& v, Image& image) const noexcept {
    SixGroups at;
    for (std::size_t j = 0; j < 6; ++j) at[j] = spread<Group>(v[j]);
    for (std::size_t g = 0; g < rows; g += std::size_t(lanes)) {
      SixGroups column;
      for (std::size_t j = 0; j < 6; ++j) column[j] = load<Group>(&columns_[j][g]);
      store(&image.entries[g], dot_of_six<Group>(column, at));
    }
  }

  /// Removes from P·v what rounding left of it along the active rows.
  void project_again(Image& image) const noexcept {
    const Six<Scalar> z = image.step();
    Six<Scalar> along{};
    for (int i = 0; i < slot_count; ++i) {
      if (is_used(i)) along[index(i)] = dot(normal(i), z);
    }
    const Six<Scalar> excess = step_of(along);
    for (std::size_t j = 0; j < 6; ++j) image.entries[j] -= excess[j];
  }

  /// N*ᵀ·w: the shortest step that moves along each active row by w.
  Six<Scalar> step_of(const Six<Scalar>& along) const noexcept {
    Six<Scalar> step;
    for (std::size_t j = 0; j < 6; ++j) step[j] = dot_of_six<Scalar>(&columns_[j][6], along);
    return step;
  }

  /// Makes a row active in a free slot.
  /// @param image  of the row; spent
  /// @param slope  row · P · row, positive
  void add(int slot, const Six<Scalar>& row, Image& image, const Scalar& slope) noexcept {
    normals_[index(slot)] = row;
    is_used_[index(slot)] = true;
    ++used_;
    Six<Scalar> direction = image.step();
    const Scalar factor = Scalar(1) / slope;
    for (Scalar& entry : direction) entry *= factor;
    image.entries[index(6 + slot)] = Scalar(-1);  // so that the new row of N* becomes the direction
    subtract_outer(image, direction);
  }

  /// Frees a slot.
  /// @param dual       its row of N*
  /// @param image      of H·dual
  /// @param curvature  dual · H · dual, positive
  void drop(int slot, const InverseHessian<Scalar>& inverse, const Six<Scalar>& dual, Image& image,
            const Scalar& curvature) noexcept {
    is_used_[index(slot)] = false;
    if (--used_ == 0) return clear(inverse);
    std::copy_n(dual.begin(), 6, image.entries.begin());
    Six<Scalar> direction = dual;
    const Scalar factor = Scalar(1) / curvature;
    for (std::size_t j = 0; j < 6; ++j) {
      image.entries[j] = -image.entries[j];  // P gains what N* loses
      direction[j] *= factor;
    }
    subtract_outer(image, direction);
    for (auto& column : columns_) column[index(6 + slot)] = Scalar(0);
  }

  /// Computes both operators afresh by an orthogonal factor of the active rows: slower, and as good as the
  /// scalar allows.
  ///
  /// With H⁻¹ = WᵀW and W·N = QR, N* = R⁻¹QᵀW and P = (YᵀW)ᵀ(YᵀW), Y an orthonormal complement of Q. Columns
  /// are made orthogonal twice (W. Kahan, in B. Parlett, "The Symmetric Eigenvalue Problem", section 6-9).
  void rebuild(const InverseHessian<Scalar>& inverse) noexcept {
    using std::sqrt;
    clear(inverse);
    if (used_ == 0) return;
    const SixBySix<Scalar> w = inverse.root();
    const auto root_times = [&w](const Six<Scalar>& v) { return multiply(w, v); };
    const auto transposed_root_times = [&w](const Six<Scalar>& v) {
      Six<Scalar> image{};
      for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t k = 0; k < 6; ++k) image[k] += product(w[j][k], v[j]);
      }
      return image;
    };
    SixBySix<Scalar> q{}, r{};
    std::array<std::size_t, 6> slots{};
    std::size_t count = 0;
    const auto orthogonalise = [&q](Six<Scalar>& v, Six<Scalar>& coefficients, std::size_t against) {
      for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t i = 0; i < against; ++i) {
          const Scalar part = dot(q[i], v);
          coefficients[i] += part;
          for (std::size_t j = 0; j < 6; ++j) v[j] -= product(part, q[i][j]);
        }
      }
      return Scalar(sqrt(dot(v, v)));
    };
    const auto keep = [&q](const Six<Scalar>& v, const Scalar& length, std::size_t at) {
      for (std::size_t j = 0; j < 6; ++j) q[at][j] = length > Scalar(0) ? Scalar(v[j] / length) : Scalar(0);
    };
    for (int slot = 0; slot < slot_count; ++slot) {
      if (!is_used(slot)) continue;
      Six<Scalar> v = root_times(normal(slot));
      r[count][count] = orthogonalise(v, r[count], count);
      keep(v, r[count][count], count);
      slots[count++] = index(slot);
    }
    for (std::size_t i = count; i-- > 0;) {
      Six<Scalar> row = transposed_root_times(q[i]);
      for (std::size_t k = i + 1; k < count; ++k) {
        for (std::size_t j = 0; j < 6; ++j) row[j] -= product(r[k][i], columns_[j][6 + slots[k]]);
      }
      for (std::size_t j = 0; j < 6; ++j) columns_[j][6 + slots[i]] = row[j] / r[i][i];
    }
    for (auto& column : columns_) std::fill_n(column.begin(), 6, Scalar(0));
    for (std::size_t at = count; at < 6; ++at) {
      Six<Scalar> longest{};
      Scalar length(0);
      for (std::size_t axis = 0; axis < 6; ++axis) {
        Six<Scalar> v{}, unused{};
        v[axis] = Scalar(1);
        const Scalar left = orthogonalise(v, unused, at);
        if (left > length) length = left, longest = v;
      }
      keep(longest, length, at);
      const Six<Scalar> y = transposed_root_times(q[at]);
      for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t i = 0; i < 6; ++i) columns_[j][i] += product(y[i], y[j]);
      }
    }
  }

 private:
  using Group = Lanes<Scalar, lanes>;
  using SixGroups = std::array<Group, 6>;
  static constexpr std::size_t rows = 12;  // and four of padding, where 12 is no multiple of the lanes

  static std::size_t index(int i) noexcept { return std::size_t(i); }

  void clear(const InverseHessian<Scalar>& inverse) noexcept {
    for (std::size_t j = 0; j < 6; ++j) {
      columns_[j].fill(Scalar(0));
      std::copy_n(inverse.matrix()[j].begin(), 6, columns_[j].begin());
    }
  }

  void subtract_outer(const Image& image, const Six<Scalar>& direction) noexcept {
    for (std::size_t g = 0; g < rows; g += std::size_t(lanes)) {
      const Group entries = load<Group>(&image.entries[g]);
      for (std::size_t j = 0; j < 6; ++j) {
        const Group change = product<Group>(entries, spread<Group>(direction[j]));
        store(&columns_[j][g], Group(load<Group>(&columns_[j][g]) - change));
      }
    }
  }

  alignas(64) std::array<std::array<Scalar, 16>, 6> columns_{};  // of P over N*
  SixBySix<Scalar> normals_{};
  std::array<bool, slot_count> is_used_{};
  int used_ = 0;
};

}  // namespace feeler::detail
