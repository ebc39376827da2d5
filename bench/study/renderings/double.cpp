#include "scenes/renderers.hpp"
#include "study/player_of.hpp"

namespace feeler::study {
namespace {
/// Of one piece or of several: both are compiled for other programs anyway.
std::unique_ptr<Player> make(const StudyScene& scene, const Cell& cell) {
  if (scene.pieces.size() == 1) return make_convex_player<double>(scene, cell);
  using Tool = CompoundTool<ConvexPolytope<double>>;
  return std::make_unique<PlayerOf<HapticRenderer<Tool>>>(scene, Tool::hulls_of(scene.pieces), cell);
}
const Registration registration({"double", "double", "dual active set", "default", make});
}  // namespace
}  // namespace feeler::study
