// What of a force is faster than the hand: a high pass and the root mean square behind it.
#pragma once

#include <cmath>
#include <numbers>

#include "feeler/core/scalar.hpp"

namespace feeler::stability {

/// Butterworth high pass of second order, by the bilinear transform; starts at rest on its first sample.
class HighPass {
 public:
  /// @param cutoff  −3 dB [Hz], below half the rate
  HighPass(double cutoff, double rate) noexcept {
    const double w = std::tan(std::numbers::pi * cutoff / rate);
    const double norm = 1 / (1 + std::numbers::sqrt2 * w + w * w);
    gain_ = norm;
    a1_ = 2 * (w * w - 1) * norm;
    a2_ = (1 - std::numbers::sqrt2 * w + w * w) * norm;
  }

  Vector3<double> step(const Vector3<double>& x) noexcept {
    if (!is_started_) x1_ = x2_ = x;
    is_started_ = true;
    const Vector3<double> y = gain_ * (x - 2 * x1_ + x2_) - a1_ * y1_ - a2_ * y2_;
    x2_ = x1_, x1_ = x;
    y2_ = y1_, y1_ = y;
    return y;
  }

 private:
  double gain_, a1_, a2_;
  bool is_started_ = false;
  Vector3<double> x1_ = Vector3<double>::Zero(), x2_ = x1_, y1_ = x1_, y2_ = x1_;
};

/// Root mean square of the length of vectors.
class RootMeanSquare {
 public:
  void add(const Vector3<double>& v) noexcept {
    sum_ += v.squaredNorm();
    ++count_;
  }
  double value() const noexcept { return count_ > 0 ? std::sqrt(sum_ / count_) : 0; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

}  // namespace feeler::stability
