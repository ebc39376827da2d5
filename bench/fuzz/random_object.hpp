// Objects that are hard on a renderer: slivers, soups, spikes, wires, shallow grooves, slots and rooms.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "scenes/scene.hpp"
#include "support/random_geometry.hpp"

namespace feeler::fuzz {

using Vector = Eigen::Vector3d;
using feeler_test::below;
using feeler_test::fraction;
using feeler_test::magnitude;
using feeler_test::random_direction;
using feeler_test::random_rotation;
using feeler_test::random_vector;
using feeler_test::unit;

/// An object of about 0.1 m, and where a tool may begin.
class RandomObject {
 public:
  const char* name = "";
  Vector start{0, 0, 0.2};
  double reach = 0.06;  ///< of a hand that is to meet it, from its origin along each axis [m]

  /// One of the kinds below.
  explicit RandomObject(std::mt19937& bits) {
    using Kind = void (RandomObject::*)(std::mt19937&);
    constexpr std::array<Kind, 12> kinds{&RandomObject::plate,  &RandomObject::soup,   &RandomObject::slivers, &RandomObject::terrain,
                                         &RandomObject::spikes, &RandomObject::groove, &RandomObject::boxes,   &RandomObject::plate_of_slivers,
                                         &RandomObject::slot,   &RandomObject::room,   &RandomObject::wires,   &RandomObject::edge};
    (this->*kinds[std::size_t(below(bits, int(kinds.size())))])(bits);
  }

  void place(const Eigen::Quaterniond& rotation, const Vector& translation) {
    for (Vector& corner : corners_) corner = rotation * corner + translation;
    start = rotation * start + translation;
  }

  Points<double> vertices() const { return scenes::points_from(corners_); }
  /// No two share a vertex.
  Triangles triangles() const {
    Triangles rows(Eigen::Index(corners_.size() / 3), 3);
    for (int i = 0; i < int(rows.rows()); ++i) rows.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
    return rows;
  }

 private:
  void triangle(const Vector& a, const Vector& b, const Vector& c) { corners_.insert(corners_.end(), {a, b, c}); }
  void quad(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  void box(const Vector& low, const Vector& high) {
    const auto corner = [&](int i) {
      return Vector((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(), (i & 4) != 0 ? high.z() : low.z());
    };
    for (const auto& side : std::array<std::array<int, 4>, 6>{{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}})
      quad(corner(side[0]), corner(side[1]), corner(side[2]), corner(side[3]));
  }
  void floor() { quad({-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0}, {-0.1, 0.1, 0}); }

  void plate(std::mt19937&) {
    name = "plate";
    floor();
  }
  void soup(std::mt19937& bits) {
    name = "soup of triangles";
    for (int i = 0; i < 150; ++i) {
      const Vector a = 0.08 * random_vector(bits);
      const double size = magnitude(bits, -3, -1.2);
      const Vector b = a + size * random_direction(bits);
      triangle(a, b, a + size * random_direction(bits));
    }
  }
  void slivers(std::mt19937& bits) {
    name = "soup of slivers";
    for (int i = 0; i < 150; ++i) {
      const Vector a = 0.08 * random_vector(bits), b = a + magnitude(bits, -2, -1) * random_direction(bits);
      const double along = 1.4 * fraction(bits) - 0.2;
      triangle(a, b, a + along * (b - a) + magnitude(bits, -18, -4) * random_direction(bits));
      if (i % 10 == 0) triangle(a, b, b);
      if (i % 10 == 1) triangle(a, a, a);
      if (i % 10 == 2) triangle(a, b, (a + b) / 2);
      if (i % 10 == 3) {  // the same three times, once turned over
        const Vector c = a + 0.01 * random_direction(bits);
        triangle(a, b, c);
        triangle(a, b, c);
        triangle(a, c, b);
      }
    }
  }
  void terrain(std::mt19937& bits) {
    name = "terrain";
    constexpr int cells = 16;
    const double height = magnitude(bits, -4, -1.7);
    std::vector<Vector> grid;
    for (int i = 0; i <= cells; ++i)
      for (int j = 0; j <= cells; ++j) grid.emplace_back(-0.1 + 0.2 * i / cells, -0.1 + 0.2 * j / cells, height * unit(bits));
    const auto at = [&](int i, int j) { return grid[std::size_t(i * (cells + 1) + j)]; };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  void spikes(std::mt19937& bits) {
    name = "spikes";
    for (int i = 0; i < 20; ++i) {
      const Vector foot(0.08 * unit(bits), 0.08 * unit(bits), 0);
      const Vector tip = foot + Vector(0.01 * unit(bits), 0.01 * unit(bits), 0.005 + 0.045 * fraction(bits));
      const double width = magnitude(bits, -6, -2);
      const auto corner = [&](int k) {
        const double angle = 2 * std::numbers::pi * k / 3;
        return Vector(foot + width * Vector(std::cos(angle), std::sin(angle), 0));
      };
      for (int k = 0; k < 3; ++k) triangle(corner(k), corner(k + 1), tip);
    }
    floor();
  }
  void groove(std::mt19937& bits) {
    name = "groove or ridge";
    const double slope = magnitude(bits, -3, 0) * (below(bits, 2) == 0 ? 1 : -1);
    for (const double side : {-0.1, 0.1}) quad({0, -0.1, 0}, {side, -0.1, 0.1 * slope}, {side, 0.1, 0.1 * slope}, {0, 0.1, 0});
  }
  void boxes(std::mt19937& bits) {
    name = "boxes";
    for (int i = 0; i < 6; ++i) {
      const Vector centre = 0.06 * random_vector(bits);
      const Vector half = Vector::Constant(0.005) + 0.035 * (random_vector(bits) + Vector::Ones()) / 2;
      box(centre - half, centre + half);
    }
    box({-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02});  // these touch
    box({0.02, -0.02, -0.02}, {0.06, 0.02, 0.02});
    box({-0.02, -0.02, 0.02}, {0.02, 0.02, 0.05});
  }
  void plate_of_slivers(std::mt19937& bits) {
    name = "plate of slivers";
    std::vector<double> xs{-0.1, 0.1};
    for (int i = 0; i < 12; ++i) {
      xs.push_back(0.09 * unit(bits));
      xs.push_back(xs.back() + magnitude(bits, -16, -4));
    }
    std::sort(xs.begin(), xs.end());
    const double height = below(bits, 2) == 0 ? 0 : magnitude(bits, -12, -3);
    std::vector<double> zs;
    for (std::size_t i = 0; i < xs.size(); ++i) zs.push_back(height * unit(bits));
    for (std::size_t i = 0; i + 1 < xs.size(); ++i)
      quad({xs[i], -0.1, zs[i]}, {xs[i + 1], -0.1, zs[i + 1]}, {xs[i + 1], 0.1, zs[i + 1]}, {xs[i], 0.1, zs[i]});
  }
  void slot(std::mt19937& bits) {
    name = "slot";
    start.setZero();
    const double half = 0.002 + 0.018 * fraction(bits);
    const bool is_shaft = below(bits, 2) == 0;
    for (const double side : {-half, half}) {
      quad({side, -0.1, -0.1}, {side, 0.1, -0.1}, {side, 0.1, 0.1}, {side, -0.1, 0.1});
      if (is_shaft) quad({-0.1, side, -0.1}, {0.1, side, -0.1}, {0.1, side, 0.1}, {-0.1, side, 0.1});
    }
  }
  void room(std::mt19937& bits) {
    name = "room";
    start.setZero();
    const Vector half = Vector::Constant(0.02 + 0.03 * fraction(bits));
    box(-half, half);
  }
  void wires(std::mt19937& bits) {
    name = "wires and dots";
    const auto somewhere = [&] { return Vector(random_vector(bits).cwiseProduct(Vector(0.08, 0.08, 0.05))); };
    for (int i = 0; i < 12; ++i) {
      const Vector a = somewhere(), b = somewhere(), c = somewhere();
      triangle(a, b, b);
      triangle(c, c, c);
    }
  }
  void edge(std::mt19937& bits) {
    name = "step with a gap";
    const double gap = below(bits, 2) == 0 ? 0 : magnitude(bits, -12, -3);
    box({-0.1, -0.1, -0.1}, {0, 0.1, 0});
    box({gap, -0.1, -0.1}, {0.1, 0.1, -0.004});
  }

  std::vector<Vector> corners_;
};

}  // namespace feeler::fuzz
