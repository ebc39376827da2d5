// Makes stages, and moves the simulated hand of one.
#include "live/stage.hpp"

#include <stdexcept>
#include <utility>

#include "live/rendered_stage.hpp"
#include "live/stage_variants.hpp"
#include "scenes/renderers.hpp"

namespace feeler::demo {
namespace {

/// A steady hand: without tremor nothing moves that nobody moves.
SimulatedPhantomSettings steady_phantom(double period) {
  SimulatedPhantomSettings settings;
  settings.period = period;
  settings.specification.minimum_rate = std::min(settings.specification.minimum_rate, 1 / period);
  return settings;
}

/// Half the diagonal of all that is on show, and a hand's breadth.
double reach_of(const scenes::Setting& setting) {
  const Vector3<double> low = setting.vertices.colwise().minCoeff().transpose();
  const Vector3<double> high = setting.vertices.colwise().maxCoeff().transpose();
  return (high - low).norm() + 0.1;
}

}  // namespace

Stage::Stage(StageParts parts)
    : parts_(std::move(parts)),
      object_(std::make_shared<const TriangleMesh<double>>(scene().setting.vertices, scene().setting.triangles)),
      watch_(unless_stopped(object_), scene().tool, settings().margin),
      guide_(scene().setting.start, scene().setting.motion, reach_of(scene().setting), parts_.period),
      phantom_([this](double time) { return guide_.at(time); }, steady_phantom(parts_.period)) {
  phantom_.open();
}

DeviceStatus Stage::read(DeviceState& state) noexcept {
  if (has_begun_) guide_.advance();
  has_begun_ = true;
  return phantom_.read(state);
}

ConvexPolytope<double> polytope_of(const Box<double>& box) {
  Points<double> corners(box.vertex_count(), 3);
  for (int i = 0; i < box.vertex_count(); ++i) corners.row(i) = Vector3<double>(box.vertex(i)).transpose();
  return ConvexPolytope<double>::hull_of(corners);
}

std::unique_ptr<Stage> make_stage(StageParts parts) {
  const auto& [method, scalar] = parts.choice;
  const bool is_paper = method == "paper", is_float = scalar == "float";
  if ((!is_paper && method != "closest") || (!is_float && scalar != "double"))
    throw std::invalid_argument("There is no such contact method or scalar.");
  if (is_paper && is_float) throw std::invalid_argument("The paper's method is built for double only.");
  if (is_paper) return make_paper_stage(std::move(parts));
  if (is_float) return make_float_stage(std::move(parts));
  const LiveTool tool = parts.scene.tool;
  return std::visit(
      [&]<class Tool>(const Tool& shape) -> std::unique_ptr<Stage> {
        return std::make_unique<RenderedStage<HapticRenderer<Tool>>>(std::move(parts), shape);
      },
      tool);
}

}  // namespace feeler::demo
