// A fork whose prongs straddle a wall: a tool of three convex pieces, which one touches, and what is free.
#include <array>
#include <cstdio>

#include <feeler/feeler.hpp>

namespace {

using Vector = feeler::Vector3<double>;

/// The corners of an upright cuboid [m].
feeler::Points<double> cuboid(const Vector& lower, const Vector& upper) {
  feeler::Points<double> corners(8, 3);
  for (int i = 0; i < 8; ++i) corners.row(i) << (i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(), (i & 4 ? upper : lower).z();
  return corners;
}

/// A wall of 2 mm along y, as a closed mesh.
feeler::TriangleMesh<double> wall() {
  feeler::Triangles triangles(12, 3);
  triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5;
  return {cuboid({-0.001, -0.1, -0.05}, {0.001, 0.1, 0}), triangles};
}

}  // namespace

int main() {
  const auto object = wall();
  // Two prongs 2.1 mm apart, which leaves 0.05 mm to each side of the wall, and a bridge over them.
  const std::array pieces{cuboid({-0.0030, -0.002, -0.01}, {-0.00105, 0.002, 0}), cuboid({0.00105, -0.002, -0.01}, {0.0030, 0.002, 0}),
                          cuboid({-0.0030, -0.002, 0}, {0.0030, 0.002, 0.003})};
  const auto fork = feeler::CompoundTool<feeler::ConvexPolytope<double>>::hulls_of(pieces);

  feeler::HapticRenderer renderer(object, fork);
  feeler::Pose<double> hand{.translation = {0, 0, 0.005}};
  if (renderer.reset(hand) != feeler::Status::converged) return 1;
  for (int i = 0; i < 200; ++i) {  // down until the bridge sits, then 3 mm to the side, which the wall forbids, and along it, which it does not
    if (i < 80) {
      hand.translation.z() -= 0.0001;
    } else {
      hand.translation.x() += 0.000025;
      hand.translation.y() += 0.0002;
    }
    renderer.update(hand);
  }
  const auto& tick = renderer.tick();
  std::printf("hand (%.2f, %.2f, %.2f) mm\n", 1e3 * hand.translation.x(), 1e3 * hand.translation.y(), 1e3 * hand.translation.z());
  for (const auto& contact : tick.contacts)
    std::printf("piece %d pushes with %.2f N along (%.1f, %.1f, %.1f)\n", contact.piece, contact.force, contact.normal_world.x(),
                contact.normal_world.y(), contact.normal_world.z());
  const Vector at = 1e3 * tick.graphic_pose.translation;
  std::printf("the fork is at (%.2f, %.2f, %.2f) mm\n", at.x(), at.y(), at.z());
}  // prints: the fork is at (0.05, 24.00, 0.00) mm
