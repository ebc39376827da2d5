// A scalar of your own, in a renderer like any other: a double that counts its operations.
#include <cmath>
#include <cstdio>

#include <feeler/feeler.hpp>

#include "counting_scalar.hpp"

int main() {
  using counting::Counted;
  feeler::Points<double> vertices(6, 3);  // a ramp that ends at a wall [m]
  vertices << -0.1, -0.1, 0.0577, -0.1, 0.1, 0.0577, 0, -0.1, 0, 0, 0.1, 0, 0.02, -0.1, 0.1, 0.02, 0.1, 0.1;
  feeler::Triangles triangles(4, 3);
  triangles << 0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5;
  const feeler::TriangleMesh<Counted> object(vertices.cast<Counted>(), triangles);
  const feeler::Box<Counted> tool(feeler::Vector3<double>(0.008, 0.006, 0.01).cast<Counted>());
  feeler::HapticRenderer renderer(object, tool);

  const auto hand = [](int i) { return feeler::Pose<double>{.translation = {-0.03 + 2e-5 * i, 0.005, 0.024 + 0.014 * std::cos(2e-3 * i)}}; };
  if (renderer.reset(hand(0).cast<Counted>()) != feeler::Status::converged) return 1;
  Counted::sums = Counted::products = Counted::quotients = Counted::functions = 0;
  constexpr int ticks = 1500;
  int converged = 0;
  for (int i = 1; i <= ticks; ++i) converged += renderer.update(hand(i).cast<Counted>()).converged() ? 1 : 0;
  std::printf("a tick: %ld sums, %ld products, %ld quotients, %ld functions\n", Counted::sums / ticks, Counted::products / ticks,
              Counted::quotients / ticks, Counted::functions / ticks);
  std::printf("converged in %d %%\n", 100 * converged / ticks);
}  // prints: converged in 100 %
