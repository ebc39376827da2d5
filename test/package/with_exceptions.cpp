// A program of a file with exceptions, this one, and one without. Whoever refuses, it is caught here, in whatever order they are linked.
#include <cstdio>
#include <stdexcept>

#include <feeler/object/triangle_mesh.hpp>

void make_a_mesh_of_nothing_here();
bool makes_what_can_be_made();

static void make_a_mesh_of_nothing() { feeler::TriangleMesh<double>(feeler::Points<double>(0, 3), feeler::Triangles(0, 3)); }

int main() {
  for (const auto make : {make_a_mesh_of_nothing, make_a_mesh_of_nothing_here}) {
    try {
      make();
      return 1;
    } catch (const std::invalid_argument& refusal) {
      std::puts(refusal.what());
    }
  }
  return makes_what_can_be_made() ? 0 : 2;
}
