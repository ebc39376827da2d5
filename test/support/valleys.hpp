// Tools pressed into valleys and corners, where poses and forces have a closed form.
#pragma once

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "feeler/feeler.hpp"

namespace feeler::test::valleys {

/// The margin of the default settings, and the length that weighs a turn [m].
constexpr double margin = 1e-6;
constexpr double length = 0.008;

/// Settings with a reference point of the tool.
inline Settings<double> settings_about(const Vector3<double>& reference) {
  Settings<double> settings;
  settings.reference_point = reference;
  settings.stiffness = Stiffness<double>::uniform(1000, 1000 * length * length);
  return settings;
}

/// Two planes that meet in the y axis and rise from it by a slope, negative for a roof.
inline TriangleMesh<double> valley(double slope) {
  const double x = 0.1 * std::cos(slope), z = 0.1 * std::sin(slope);
  return {Points<double>{{-x, -0.1, z}, {-x, 0.1, z}, {0, -0.1, 0}, {0, 0.1, 0}, {x, -0.1, z}, {x, 0.1, z}},
          Triangles{{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}}};
}

/// Three squares that meet at right angles in the origin.
inline TriangleMesh<double> corner() {
  const double a = 0.1;
  return {Points<double>{{0, 0, 0}, {a, 0, 0}, {0, a, 0}, {0, 0, a}, {a, a, 0}, {a, 0, a}, {0, a, a}},
          Triangles{{0, 1, 4}, {0, 4, 2}, {0, 3, 5}, {0, 5, 1}, {0, 2, 6}, {0, 6, 3}}};
}

/// From clear of the object to the device's pose in so many ticks, and some more there.
template <class Renderer>
const Tick<double>& come_down(Renderer& renderer, const Pose<double>& haptic, const Vector3<double>& from, int ticks = 80) {
  BOOST_TEST_REQUIRE((renderer.reset({haptic.translation + from, haptic.rotation}) == Status::converged));
  for (int i = 0; i <= ticks; ++i) renderer.update({haptic.translation + from * (double(ticks - i) / ticks), haptic.rotation});
  for (int i = 0; i < 20; ++i) renderer.update(haptic);
  return renderer.tick();
}

/// Sum of the contact forces along a unit normal [N].
inline double force_along(const Tick<double>& tick, const Vector3<double>& normal) {
  double force = 0;
  for (const auto& contact : tick.contacts)
    if (contact.normal_world.dot(normal) > 1 - 1e-6) force += contact.force;
  return force;
}

}  // namespace feeler::test::valleys
