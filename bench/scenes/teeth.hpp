// A scanned lower jaw, and a slender probe that feels its way along the teeth and between tooth and gum.
#pragma once

#include <array>
#include <utility>

#include "scenes/mesh_scene.hpp"
#include "scenes/sulcus.hpp"

namespace feeler::scenes {

/// The middle line of the dental arch, seen from above: a smooth curve through the crowns from the left
/// molars to the right.
class DentalArch {
 public:
  /// Place on the arch [m], z = 0. @param u  from −1 (left molar) through 0 (incisors) to 1
  Vector at(double u) const {
    const double position = std::clamp(std::abs(u), 0.0, 1.0) * double(knots_.size() - 1);
    const int i = std::min(int(position), int(knots_.size()) - 2);
    const double s = position - double(i);
    const auto from = knot(i), to = knot(i + 1);
    const Eigen::Vector2d tangent_from = (to - knot(i - 1)) / 2.0;
    const Eigen::Vector2d tangent_to = (knot(i + 2) - from) / 2.0;
    const double s2 = s * s, s3 = s2 * s;
    const Eigen::Vector2d p =
        (2.0 * s3 - 3.0 * s2 + 1.0) * from + (s3 - 2.0 * s2 + s) * tangent_from + (3.0 * s2 - 2.0 * s3) * to + (s3 - s2) * tangent_to;
    return {u < 0.0 ? -p.x() : p.x(), p.y(), 0.0};
  }

  /// Unit normal of the arch, from the tongue to the cheek.
  Vector cheekward(double u) const {
    const Vector along = at(std::min(u + 1e-3, 1.0)) - at(std::max(u - 1e-3, -1.0));
    return Vector(along.y(), -along.x(), 0.0).normalized();
  }

 private:
  // Read off the scan, in millimetres, from the middle incisors to the second molar; the other side mirrors
  // it.
  static constexpr std::array<std::array<double, 2>, 12> knots_{{{0.0, -20.4},
                                                                 {4.2, -20.2},
                                                                 {8.4, -18.8},
                                                                 {11.5, -16.5},
                                                                 {14.0, -13.0},
                                                                 {15.6, -9.2},
                                                                 {17.0, -4.8},
                                                                 {18.2, -0.3},
                                                                 {19.7, 4.2},
                                                                 {21.0, 7.6},
                                                                 {22.1, 13.0},
                                                                 {23.5, 18.5}}};

  Eigen::Vector2d knot(int i) const {
    const auto& k = knots_[std::size_t(std::clamp(std::abs(i), 0, int(knots_.size()) - 1))];
    return {(i < 0 ? -k[0] : k[0]) * 1e-3, k[1] * 1e-3};
  }
};

/// Turns the scan (y up, z to the front, 2.1e-4 m a unit) into metres with z up and the incisors at −y.
inline Points<double> teeth_vertices(const Points<double>& scan) {
  Points<double> vertices(scan.rows(), 3);
  vertices << scan.col(0), -scan.col(2), scan.col(1);
  return vertices * 2.1e-4;
}

/// The probe sweeps along the arch, weaves across the crowns from gum to gum, and presses 1 to 3 mm.
/// @param vertices, triangles  the jaw in metres, z up, as from `teeth_vertices`
inline Scene lower_teeth(Points<double> vertices, Triangles triangles) {
  Scene scene;
  scene.name = "teeth";
  scene.description = "A slender probe feels its way along the teeth and between tooth and gum.";
  scene.vertices = std::move(vertices);
  scene.triangles = std::move(triangles);
  scene.tool = slender_probe();
  scene.tip = probe_tip;

  const DentalArch arch;
  const auto place = [arch](double t) {
    const double u = 0.95 * std::sin(0.45 * t);
    // Incisors are narrow, molars wide.
    const double across = 0.0002 + (0.0014 + 0.0024 * std::abs(u)) * std::sin(5.3 * t);
    return Vector(arch.at(u) + across * arch.cheekward(u));
  };
  const double above = bounds(scene.vertices, scene.triangles).max().z() + 0.004;
  const SurfacePath surface(scene.vertices, scene.triangles, [=](double t) { return Ray{place(t), Vector::UnitZ()}; }, above, 10.0);

  scene.motion = [=](double t) {
    const double s = surface.folded(t);
    const double u = 0.95 * std::sin(0.45 * s);
    // The handle leans to the cheek, as a hand outside the mouth holds it, and turns as it goes.
    const Vector cheek = arch.cheekward(u);
    const Vector along(-cheek.y(), cheek.x(), 0.0);
    const Vector lean = (0.25 + 0.25 * std::sin(2.9 * t)) * along + 0.2 * std::sin(3.7 * t) * cheek;
    const Quaternion<double> rotation = exp_rotation(lean) * exp_rotation(Vector(0.0, 0.0, 0.5 * std::sin(2.0 * t)));
    const double depth = 0.002 + 0.001 * std::sin(6.1 * t);
    const double a = approach(t);
    const double share = a * a * (3.0 - 2.0 * a);
    Vector point = place(s);
    point.z() = above + share * (surface(s) - depth - above);
    return Pose<double>{point - rotation * probe_tip, rotation};
  };
  scene.start = scene.motion(0.0);
  scene.length = 0.0055;
  return scene;
}

}  // namespace feeler::scenes
