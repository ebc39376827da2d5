// Stages whose renderers compute with float poses.
#include "live/rendered_stage.hpp"
#include "live/stage_variants.hpp"

namespace feeler::demo {
namespace {

template <class Tool>
std::unique_ptr<Stage> make(StageParts parts, const Tool& tool) {
  const auto narrow = tool.template cast<float>();
  return std::make_unique<RenderedStage<HapticRenderer<std::remove_cv_t<decltype(narrow)>>>>(std::move(parts), narrow);
}

}  // namespace

std::unique_ptr<Stage> make_float_stage(StageParts parts) {
  const LiveTool tool = parts.scene.tool;
  if (const auto* segment = std::get_if<Segment<double>>(&tool)) return make(std::move(parts), *segment);
  if (const auto* compound = std::get_if<Compound>(&tool)) return make(std::move(parts), *compound);
  const auto* const box = std::get_if<Box<double>>(&tool);
  const ConvexPolytope<double> piece = box != nullptr ? polytope_of(*box) : std::get<ConvexPolytope<double>>(tool);
  return make(std::move(parts), Compound({piece}));  // a compound of one piece, so that fewer renderers need compiling
}

}  // namespace feeler::demo
