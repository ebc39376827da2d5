// A box that comes down on a table, and what the hand feels.
#include <cstdio>

#include <feeler/feeler.hpp>

int main() {
  // The object: corners, one a row [m], and triangles of three corner numbers each. Either side of a triangle stops a tool.
  feeler::Points<double> vertices(4, 3);
  vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  feeler::Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const feeler::TriangleMesh<double> table(vertices, triangles);

  // The tool: a box of 20 × 20 × 40 mm, given by half of its sides [m].
  const feeler::Box<double> box({0.01, 0.01, 0.02});

  // What the hand feels: 800 N/m, and 0.3 N·m/rad about every axis.
  feeler::Settings<double> settings;
  settings.stiffness = feeler::Stiffness<double>::uniform(800, 0.3);

  feeler::HapticRenderer renderer(table, box, settings);  // holds a reference to the table, which must outlive it
  feeler::Pose<double> hand{.translation = {0, 0, 0.03}};
  if (renderer.reset(hand) != feeler::Status::converged) {  // starts where the tool touches nothing
    std::printf("%s\n", to_string(renderer.tick().status));
    return 1;
  }
  for (int i = 0; i < 140; ++i) {  // a tick is a millisecond: down at 0.1 m/s, to 4 mm below where the table stops the box
    hand.translation.z() -= 0.0001;
    const auto& tick = renderer.update(hand);
    if (i % 20 != 19) continue;
    std::printf("hand at %5.1f mm, tool at %5.1f mm, %.1f N, %d contacts\n", 1e3 * hand.translation.z(), 1e3 * tick.graphic_pose.translation.z(),
                tick.wrench.force.z(), tick.contacts.size());
  }
  for (const auto& contact : renderer.tick().contacts) {
    std::printf("a contact at (%.1f, %.1f) mm pushes with %.2f N\n", 1e3 * contact.point_world.x(), 1e3 * contact.point_world.y(), contact.force);
  }
}  // prints: hand at  16.0 mm, tool at  20.0 mm, 3.2 N
