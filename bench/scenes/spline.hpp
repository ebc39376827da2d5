// The paper's splined shaft and hole (Fig. 1b): a tool of convex pieces in a hole of the same profile.
#pragma once

#include <numbers>

#include "scenes/motions.hpp"

namespace feeler::scenes {

/// A profile of eight straight teeth, seen along z.
struct SplineProfile {
  static constexpr int teeth = 8;

  double root_radius = 0.008;  ///< of the flats between teeth [m]
  double tip_radius = 0.010;   ///< of the teeth's tops [m]
  double half_width = 0.0016;  ///< of a tooth [m]

  /// The profile with a clearance all around.
  SplineProfile offset_by(double c) const { return {root_radius + c, tip_radius + c, half_width + c}; }

  /// Corner of a tooth: 0 and 3 at the root, 1 and 2 at the tip, counter-clockwise around z.
  Vector corner(int tooth, int which, double z) const {
    const double angle = double(tooth) * 2.0 * std::numbers::pi / double(teeth);
    const double radial = (which == 0 || which == 3) ? root_radius : tip_radius;
    const double tangential = which < 2 ? -half_width : half_width;
    return {radial * std::cos(angle) - tangential * std::sin(angle), radial * std::sin(angle) + tangential * std::cos(angle), z};
  }
};

/// Pieces of the shaft: the hull of the 16 root points at both ends, and a hexahedron for each tooth.
inline std::vector<Points<double>> spline_shaft(const SplineProfile& profile, double half_length) {
  std::vector<Vector> core;
  std::vector<Points<double>> pieces;
  for (int tooth = 0; tooth < SplineProfile::teeth; ++tooth) {
    std::vector<Vector> hexahedron;
    for (int which = 0; which < 4; ++which) {
      for (double z : {-half_length, half_length}) {
        hexahedron.push_back(profile.corner(tooth, which, z));
        if (which == 0 || which == 3) core.push_back(hexahedron.back());
      }
    }
    pieces.push_back(points_from(hexahedron));
  }
  pieces.insert(pieces.begin(), points_from(core));
  return pieces;
}

/// The hole: rings of the profile from z = 0 down to −depth, and a flat collar at z = 0; normals point into
/// the free space.
inline void add_spline_hole(Setting& scene, const SplineProfile& profile, double depth, int bands) {
  constexpr int ring = 4 * SplineProfile::teeth;
  std::vector<Vector> vertices;
  std::vector<Eigen::Vector3i> triangles;
  const auto join = [&](int outer, int inner) {
    for (int i = 0; i < ring; ++i) {
      const int next = (i + 1) % ring;
      triangles.emplace_back(outer + i, outer + next, inner + next);
      triangles.emplace_back(outer + i, inner + next, inner + i);
    }
  };
  const double collar = 2.5 * 0.010;
  for (int i = 0; i < ring; ++i) {
    Vector v = profile.corner(i / 4, i % 4, 0.0);
    vertices.push_back(v * (collar / v.norm()));
  }
  for (int band = 0; band <= bands; ++band) {
    const double z = -depth * double(band) / double(bands);
    for (int i = 0; i < ring; ++i) vertices.push_back(profile.corner(i / 4, i % 4, z));
    join(band * ring, (band + 1) * ring);
  }
  scene.vertices = points_from(vertices);
  scene.triangles = triangles_from(triangles);
}

/// Shaft and hole with a clearance between all their faces.
/// @param clearance  [m]; 0 is a perfect fit, and then the shaft starts inside
inline CompoundScene spline(double clearance = 2e-4) {
  constexpr double half_length = 0.015;
  const SplineProfile profile;
  CompoundScene scene;
  scene.name = "spline";
  scene.description = "A splined shaft slides into a hole of the same profile.";
  scene.pieces = spline_shaft(profile, half_length);
  add_spline_hole(scene, profile.offset_by(clearance), 0.02, 6);
  const bool fits_perfectly = clearance == 0.0;
  scene.motion = [fits_perfectly](double t) {
    const double z = fits_perfectly ? half_length - 0.01 + 0.004 * std::sin(8.0 * t) : half_length + 0.002 - 0.012 * (1.0 - std::cos(3.0 * t));
    return pose_of({0.15 * std::sin(4.0 * t), 0.15 * std::sin(3.3 * t), 0.3 * std::sin(5.0 * t)},
                   {0.003 * std::sin(6.0 * t), 0.003 * std::sin(7.0 * t), z});
  };
  scene.start = scene.motion(0.0);
  scene.length = 0.010;
  return scene;
}

}  // namespace feeler::scenes
