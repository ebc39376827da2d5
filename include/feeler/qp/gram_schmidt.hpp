// An orthogonal basis of a few vectors, and the coefficients of another vector in them.
#pragma once

#include <array>

#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler {

/// Gram–Schmidt, each vector projected twice, without square roots: a_i = v_i + Σ μ_ij v_j over j < i, the
/// v_j orthogonal.
///
/// Orthogonal with regard to a metric that the caller applies: every vector a comes with its image w = H⁻¹a,
/// and (a, b) is aᵀH⁻¹b. For the usual inner product give the vector itself as its image. Source: L. Giraud,
/// J. Langou, M. Rozložník, "The loss of orthogonality in the Gram–Schmidt orthogonalization process" (2005):
/// twice is enough.
template <RealScalar Scalar>
class GramSchmidt {
 public:
  using Vector = Vector6<Scalar>;
  static constexpr int capacity = 6;

  /// A vector by the basis: a = free + Σ coefficients_i a_i, with `free` orthogonal to all a_i.
  struct Expansion {
    Vector free, free_image;
    Scalar free_squared{};                     ///< (free, free)
    Scalar squared{};                          ///< (a, a)
    std::array<Scalar, capacity> projections;  ///< on the v_i
    std::array<Scalar, capacity> coefficients;
  };

  int size() const noexcept { return size_; }
  void clear() noexcept { size_ = 0; }

  Expansion expand(const Vector& a, const Vector& image) const noexcept {
    Expansion e{a, image, Scalar(0), a.dot(image), {}, {}};
    e.projections.fill(Scalar(0));
    for (int pass = 0; pass < 2; ++pass) {
      for (int j = 0; j < size_; ++j) {
        const Scalar part = e.free.dot(images_[as_index(j)]) / squares_[as_index(j)];
        e.projections[as_index(j)] += part;
        e.free -= part * vectors_[as_index(j)];
        e.free_image -= part * images_[as_index(j)];
      }
    }
    e.free_squared = e.free.dot(e.free_image);
    e.coefficients = e.projections;
    solve_upper(e.coefficients);
    return e;
  }

  /// Adds a vector with its expansion, which must have a free part.
  void add(const Expansion& e) noexcept {
    vectors_[as_index(size_)] = e.free;
    images_[as_index(size_)] = e.free_image;
    squares_[as_index(size_)] = e.free_squared;
    projections_[as_index(size_)] = e.projections;
    ++size_;
  }

  /// u with (Σ u_j a_j, a_i) = c_i for all i.
  std::array<Scalar, capacity> solve(std::array<Scalar, capacity> c) const noexcept {
    for (int i = 0; i < size_; ++i) {
      for (int j = 0; j < i; ++j) c[as_index(i)] -= projections_[as_index(i)][as_index(j)] * c[as_index(j)];
    }
    for (int i = 0; i < size_; ++i) c[as_index(i)] /= squares_[as_index(i)];
    solve_upper(c);
    return c;
  }

 private:
  void solve_upper(std::array<Scalar, capacity>& c) const noexcept {
    for (int i = size_ - 2; i >= 0; --i) {
      for (int j = i + 1; j < size_; ++j) c[as_index(i)] -= projections_[as_index(j)][as_index(i)] * c[as_index(j)];
    }
  }

  int size_ = 0;
  std::array<Vector, capacity> vectors_, images_;  // v_i and H⁻¹v_i
  std::array<Scalar, capacity> squares_;
  std::array<std::array<Scalar, capacity>, capacity> projections_;  // μ
};

}  // namespace feeler
