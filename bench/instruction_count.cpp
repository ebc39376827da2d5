// Ticks on terrain and nothing else, to count their instructions: with the optional parts of the library left
// out, included, and used.
//
// valgrind --tool=callgrind --callgrind-out-file=/dev/null feeler-instructions-<which> <ticks>; the
// difference of two numbers of ticks is free of what the start costs.
#include <cstdio>
#include <cstdlib>

#include "feeler/feeler.hpp"
#include "scenes/terrain.hpp"
#ifdef FEELER_INCLUDES_OPTIONAL_PARTS
#include "feeler/paper/candidate_contacts.hpp"
#include "feeler/qp/reference/interior_point.hpp"
#include "feeler/qp/reference/projected_gauss_seidel.hpp"
#include "feeler/qp/reference/textbook_active_set.hpp"
#include "feeler/qp/warm_start.hpp"
#include "feeler/recognition/contact_recogniser.hpp"
#endif

int main(int argc, char** argv) {
  const int ticks = argc == 2 ? std::atoi(argv[1]) : 0;
  if (ticks <= 0) {
    std::fprintf(stderr, "feeler-instructions: give the number of ticks, such as 2000.\n");
    return 2;
  }
  const auto scene = feeler::scenes::terrain(71);
  const auto& tool = std::get<feeler::ConvexPolytope<double>>(scene.tool);
  const feeler::TriangleMesh<double> object(scene.vertices, scene.triangles);
#ifdef FEELER_USES_RECOGNISER
  const feeler::SurfaceFeatures<double> surface(object);
  feeler::ContactRecogniser recogniser(object, surface, tool);
#endif
  feeler::HapticRenderer renderer(object, tool, scene.settings());
  renderer.reset(scene.start);
  double force = 0.0;
  int contacts = 0;
  for (int i = 1; i <= ticks; ++i) {
    const auto& tick = renderer.update(scene.motion(double(i) / 1000.0));
    force += tick.wrench.force.norm();
#ifdef FEELER_USES_RECOGNISER
    contacts += recogniser.recognise(tick.graphic_pose).size();
#endif
  }
  std::printf("%d ticks, mean force %.17g N, %d contacts recognised\n", ticks, force / ticks, contacts);
  return 0;
}
