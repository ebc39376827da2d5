// The coordinates of a tool's vertices, laid out so that a compiler answers support queries with SIMD
// instructions.
#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

#include "feeler/core/scalar.hpp"

namespace feeler {

/// Up to 256 points, one by one and in blocks of eight: eight x, then eight y, then eight z. The last point fills up the last
/// block.
template <RealScalar Scalar>
class SupportBlocks {
 public:
  static constexpr int block_size = 8;
  static constexpr int max_count = 256;

  SupportBlocks() = default;
  /// @param points  1 to `max_count` rows
  explicit SupportBlocks(const Points<Scalar>& points) : block_count_((int(points.rows()) + block_size - 1) / block_size) {
    for (int i = 0; i < int(points.rows()); ++i) points_.push_back(points.row(i));
    for (int i = 0; i < block_count_ * block_size; i += block_size)
      for (int k = 0; k < 3; ++k)
        for (int j = i; j < i + block_size; ++j) coordinates_.push_back(points_[std::size_t((std::min)(j, count() - 1))][k]);
  }

  int count() const noexcept { return int(points_.size()); }
  const Vector3<Scalar>& operator[](int i) const noexcept { return points_[std::size_t(i)]; }

  /// Index of a point farthest along a direction; of equal ones, the first of its block. A direction with a
  /// NaN gives a valid index.
  /// @cost  all dot products, eight at a time; no branch depends on them
  int support(const Vector3<Scalar>& direction) const noexcept {
    alignas(64) Scalar dots[max_count];
    Scalar best{};
    int best_block = 0;
    for (int b = 0; b < block_count_; ++b) {
      Eigen::Map<Block, Eigen::Aligned64> block(dots + b * block_size);
      block = heights(b, direction);
      const Scalar block_best = block.maxCoeff();
      const bool is_better = b == 0 || block_best > best;
      best = is_better ? block_best : best;
      best_block = is_better ? b : best_block;
    }
    const Scalar* block = dots + best_block * block_size;
    int index = 0;
    for (int j = block_size - 1; j > 0; --j) index = block[j] == best ? j : index;
    index = block[0] == best ? 0 : index;
    return best_block * block_size + index;
  }

  /// max direction · point: the support function of their hull.
  Scalar highest(const Vector3<Scalar>& direction) const noexcept {
    Block best = heights(0, direction);
    for (int b = 1; b < block_count_; ++b) best = (best.max)(heights(b, direction));
    return best.maxCoeff();
  }

 private:
  using Block = Eigen::Array<Scalar, block_size, 1>;

  /// The dot products of a block.
  Block heights(int block, const Vector3<Scalar>& direction) const noexcept {
    using BlockMap = Eigen::Map<const Block>;
    const Scalar* data = coordinates_.data() + block * 3 * block_size;
    return BlockMap(data) * direction.x() + BlockMap(data + block_size) * direction.y() + BlockMap(data + 2 * block_size) * direction.z();
  }

  std::vector<Vector3<Scalar>> points_;
  int block_count_ = 0;
  std::vector<Scalar> coordinates_;
};

}  // namespace feeler
