// Stages whose renderers model contact as the paper does.
#include <stdexcept>

#include "feeler/paper/candidate_contacts.hpp"
#include "live/rendered_stage.hpp"
#include "live/stage_variants.hpp"

namespace feeler::demo {
namespace {

template <class Tool>
std::unique_ptr<Stage> make(StageParts parts, const Tool& tool) {
  return std::make_unique<RenderedStage<HapticRenderer<Tool, DualActiveSet<double>, CandidateContacts<>>>>(std::move(parts), tool);
}

}  // namespace

std::unique_ptr<Stage> make_paper_stage(StageParts parts) {
  const LiveTool tool = parts.scene.tool;
  if (const auto* box = std::get_if<Box<double>>(&tool)) return make(std::move(parts), polytope_of(*box));
  if (const auto* segment = std::get_if<Segment<double>>(&tool)) return make(std::move(parts), *segment);
  if (const auto* polytope = std::get_if<ConvexPolytope<double>>(&tool)) return make(std::move(parts), *polytope);
  throw std::invalid_argument("The paper's method takes convex tools only: choose the closest features for this one.");
}

}  // namespace feeler::demo
