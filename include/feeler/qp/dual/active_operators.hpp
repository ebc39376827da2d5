// The two operators of an active set: the projection off its rows, and what a force is in their multipliers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "feeler/core/index.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/single_lanes.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/orthonormal_basis.hpp"
#include "feeler/qp/dual/six.hpp"

namespace feeler::detail {

/// P = H⁻¹ − H⁻¹N(NᵀH⁻¹N)⁻¹NᵀH⁻¹ and N* = (NᵀH⁻¹N)⁻¹NᵀH⁻¹ of up to six active rows N, in slots.
///
/// Source: D. Goldfarb, A. Idnani, Mathematical Programming 27 (1983), section 3. Both are kept by columns:
/// one pass gives both images of a vector, and adding or dropping a row changes both by outer products. The
/// slots in use are the first ones, and only their share of N* is computed.
template <RealScalar Scalar, int lanes>
class ActiveOperators {
 public:
  using Group = Lanes<Scalar, lanes>;
  static constexpr int slot_count = 6;
  /// Six numbers, in whole groups and aligned to them.
  ///
  /// To 16 bytes at least: of plain loops over columns g++ 12 makes loads that need as much, even where it can see that they have less.
  struct alignas((std::max)(alignof(Group), std::size_t(16))) Column : std::array<Scalar, lanes <= 2 ? 6 : 8> {};

  /// The images of a vector: `step` is P·v, and `share` is N*·v, one number for each slot; behind the slots in use it
  /// is some number.
  struct Image {
    Column step{};
    Column share{};
  };

  /// Nothing active: P is H⁻¹.
  void reset(const InverseHessian<Scalar>& inverse) noexcept {
    used_ = 0;
    is_behind_ = false;
    is_diagonal_ = inverse.is_diagonal();
    if (is_diagonal_) {
      copy_six(inverse.inverse_pivots().data(), diagonal_.data());
    } else {
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) copy_six(inverse.matrix()[j].data(), projector_[j].data());
    }
  }

  int used() const noexcept { return used_; }
  const Six<Scalar>& normal(int slot) const noexcept { return normals_[as_index(slot)]; }
  /// Row of N*: the step that moves along this active row by one and along no other.
  Six<Scalar> dual(int slot) noexcept {
    catch_up();
    Six<Scalar> row;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) row[j] = duals_[j][as_index(slot)];
    return row;
  }
  SixBySix<Scalar> projector() noexcept {
    catch_up();
    if (used_ == 0 && is_diagonal_) spread_diagonal();
    SixBySix<Scalar> p;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) copy_six(projector_[j].data(), p[j].data());
    return p;
  }

  /// Computes the images of a vector.
  void apply(const Six<Scalar>& v) noexcept {
    if (used_ == 0 && is_diagonal_) {
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) image_.step[j] = product(diagonal_[j], v[j]);
      return;
    }
    catch_up();
    const SixGroups at = spread_six<Group>(v);
    multiply_columns(projector_, 6, at, image_.step);
    multiply_columns(duals_, used_, at, image_.share);
  }
  /// Of the vector last applied to.
  const Image& image() const noexcept { return image_; }

  /// Removes from P·v what rounding left of it along the active rows.
  void project_again() noexcept {
    Six<Scalar> along{};
    for (int i = 0; i < used_; ++i) along[as_index(i)] = dot_of_six<Scalar>(normal(i), image_.step);
    const Six<Scalar> excess = step_of(along);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) image_.step[j] -= excess[j];
  }

  /// N*ᵀ·w: the shortest step that moves along each active row by w.
  Six<Scalar> step_of(const Six<Scalar>& along) noexcept {
    catch_up();
    Six<Scalar> step{};
    for (std::size_t i = 0; i < as_index(used_); ++i) {
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) step[j] += product(along[i], duals_[j][i]);
    }
    return step;
  }

  /// Makes the row last applied to active, in the slot behind those in use.
  ///
  /// What this changes is computed once it is asked for: of the last row to be added it seldom is.
  /// @param slope  row · P · row, positive
  void add(const Six<Scalar>& row, const Scalar& slope) noexcept {
    normals_[as_index(used_)] = row;
    ++used_;
    is_behind_ = true;
    slope_ = slope;
  }

  /// Frees a slot, to which the last one in use moves.
  /// @param dual       its row of N*
  /// @param curvature  dual · H · dual, positive; H·dual is what was last applied to
  void drop(int slot, const InverseHessian<Scalar>& inverse, const Six<Scalar>& dual, const Scalar& curvature) noexcept {
    const int last = used_ - 1;
    if (last == 0) return reset(inverse);
    const Scalar factor = Scalar(1) / curvature;
    Column gained{};
    Six<Scalar> direction;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) {
      gained[j] = -dual[j];  // P gains what N* loses
      direction[j] = dual[j] * factor;
    }
    subtract_outer(projector_, 6, gained, direction);
    subtract_outer(duals_, used_, image_.share, direction);
    for (Column& column : duals_) {
      set_lane<lanes>(column.data(), slot, column[as_index(last)]);
      set_lane<lanes>(column.data(), last, Scalar(0));
    }
    normals_[as_index(slot)] = normals_[as_index(last)];
    used_ = last;
  }

  /// Computes both operators afresh by an orthogonal factor of the active rows: slower, and as good as the
  /// scalar allows.
  ///
  /// With H⁻¹ = WᵀW and W·N = QR, N* = R⁻¹QᵀW and P = (YᵀW)ᵀ(YᵀW), Y an orthonormal complement of Q.
  void rebuild(const InverseHessian<Scalar>& inverse) noexcept {
    if (used_ == 0) return reset(inverse);
    is_behind_ = false;
    const SixBySix<Scalar> w = inverse.root();
    OrthonormalBasis<Scalar> basis;
    SixBySix<Scalar> r{};  // by columns
    for (std::size_t i = 0; i < as_index(used_); ++i) {
      Six<Scalar> v = multiply(w, normals_[i]);
      r[i][i] = basis.orthogonalise(v, r[i]);
      basis.append(v, r[i][i]);
    }
    rebuild_duals(w, basis, r);
    rebuild_projector(w, basis);
  }

 private:
  using SixGroups = std::array<Group, 6>;
  using Columns = std::array<Column, 6>;

  /// Wᵀ·v
  static Six<Scalar> multiply_transposed(const SixBySix<Scalar>& w, const Six<Scalar>& v) noexcept {
    Six<Scalar> image{};
    for (std::size_t j = 0; j < 6; ++j) {
      for (std::size_t k = 0; k < 6; ++k) image[k] += product(w[j][k], v[j]);
    }
    return image;
  }

  /// N* = R⁻¹QᵀW, by back substitution.
  /// @param r  by columns, upper triangular
  void rebuild_duals(const SixBySix<Scalar>& w, const OrthonormalBasis<Scalar>& q, const SixBySix<Scalar>& r) noexcept {
    duals_ = {};
    const std::size_t count = as_index(used_);
    for (std::size_t i = count; i-- > 0;) {
      Six<Scalar> row = multiply_transposed(w, q[i]);
      for (std::size_t k = i + 1; k < count; ++k) {
        for (std::size_t j = 0; j < 6; ++j) row[j] -= product(r[k][i], duals_[j][k]);
      }
      for (std::size_t j = 0; j < 6; ++j) duals_[j][i] = row[j] / r[i][i];
    }
  }

  /// P = (YᵀW)ᵀ(YᵀW).
  /// @param basis  Q, to which Y is appended
  void rebuild_projector(const SixBySix<Scalar>& w, OrthonormalBasis<Scalar>& basis) noexcept {
    for (Column& column : projector_) column = {};
    while (!basis.is_complete()) {
      basis.append_farthest_axis();
      const Six<Scalar> y = multiply_transposed(w, basis.last());
      for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t i = 0; i < 6; ++i) projector_[j][i] += product(y[i], y[j]);
      }
    }
  }

  /// Writes P where nothing is active and H⁻¹ is diagonal.
  void spread_diagonal() noexcept {
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      for (int g = 0; g < 6; g += lanes)
        store(&projector_[as_index(j)][as_index(g)], with_lane<Scalar, lanes>(Group{}, j - g, diagonal_[as_index(j)]));
    }
  }

  /// Adds the last slot to both operators.
  void catch_up() noexcept {
    if (!is_behind_) return;
    is_behind_ = false;
    const int slot = used_ - 1, first = slot - slot % lanes;
    const Scalar factor = Scalar(1) / slope_;
    Six<Scalar> direction;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) direction[j] = image_.step[j] * factor;
    if (slot == 0 && is_diagonal_) spread_diagonal();
    subtract_outer(projector_, 6, image_.step, direction);
    // With a share of −1 the row's own numbers, 0 until now, become the direction.
    Group shares{};
    if (slot == first) {
      for (Column& column : duals_) store(&column[as_index(first)], Group{});
    } else {
      shares = load<Group>(&image_.share[as_index(first)]);
    }
    store(&image_.share[as_index(first)], with_lane<Scalar, lanes>(shares, slot - first, Scalar(-1)));
    subtract_outer(duals_, used_, image_.share, direction);
  }

  /// The first `count` rows of a matrix times a vector.
  static void multiply_columns(const Columns& table, int count, const SixGroups& at, Column& image) noexcept {
    for (std::size_t g = 0; g < as_index(count); g += std::size_t(lanes)) {
      SixGroups column;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) column[j] = load<Group>(&table[j][g]);
      store(&image[g], dot_of_six<Group>(column, at));
    }
  }
  static void subtract_outer(Columns& table, int count, const Column& left, const Six<Scalar>& right) noexcept {
    for (std::size_t g = 0; g < as_index(count); g += std::size_t(lanes)) {
      const Group entries = load<Group>(&left[g]);
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) {
        const Group change = product<Group>(entries, spread<Group>(right[j]));
        store(&table[j][g], Group(load<Group>(&table[j][g]) - change));
      }
    }
  }

  Columns projector_{};  // P; while nothing is active and H⁻¹ is diagonal, some numbers
  Column diagonal_{};    // H⁻¹, where it is diagonal
  Columns duals_{};      // N*; in a group of lanes that is partly used, 0 behind the slots in use
  SixBySix<Scalar> normals_{};
  Image image_{};
  Scalar slope_{};
  int used_ = 0;
  bool is_diagonal_ = false;
  bool is_behind_ = false;  // both operators, by the last slot, whose row the image is of
};

}  // namespace feeler::detail
