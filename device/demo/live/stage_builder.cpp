// From a wish to a stage, its description and its mesh.
#include "live/stage_builder.hpp"

#include <utility>

#include "feeler/viewer/wire.hpp"
#include "live/stage_description.hpp"
#include "live/tool_choice.hpp"
#include "live/workshop.hpp"

namespace feeler::demo {

Shown StageBuilder::build(const GalleryEntry& entry, const viewer::SceneRequest& wish, const std::stop_token& stop) {
  LiveScene scene = make_scene(entry, wish.variant, wish.clearance);
  go_on_unless(stop);
  choose_tool(scene, wish.tool);
  Settings<double> settings = scene.setting.settings();
  if (wish.stiffness) {
    const double length = scene.setting.length;
    settings.stiffness = Stiffness<double>::uniform(*wish.stiffness, *wish.stiffness * length * length);
  }
  if (wish.margin) settings.margin = *wish.margin;
  if (device_ != nullptr) {
    const double share = renderable_share(settings.stiffness, device_->specification(), WorkspaceMap(workspace_));
    settings.stiffness.translational *= share;
    settings.stiffness.rotational *= share;
  }
  const RenderChoice choice{wish.method.empty() ? "closest" : wish.method, wish.scalar.empty() ? "double" : wish.scalar};
  Shown shown;
  shown.stage = make_stage({++number_, std::move(scene), settings, choice, period_, device_ != nullptr, stop});
  go_on_unless(stop);
  const std::string variant = wish.clearance ? "" : wish.variant.empty() ? entry.variants.front().label : wish.variant;
  shown.text = shared_text(stage_text(number_, shown.stage->scene(), {settings, choice},
                                      {entry.id, entry.title, entry.hint, variant, wish.clearance, wish.tool.empty() ? "own" : wish.tool}));
  const scenes::Setting& setting = shown.stage->scene().setting;
  shown.mesh = shared_text(viewer::encoded_mesh(number_, setting.vertices, setting.triangles));
  return shown;
}

}  // namespace feeler::demo
