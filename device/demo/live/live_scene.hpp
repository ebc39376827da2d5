// A scene as the live view takes it: any tool of the scenes, one of convex pieces too.
#pragma once

#include <utility>
#include <variant>

#include "feeler/tool/compound_tool.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

using Compound = CompoundTool<ConvexPolytope<double>>;
using LiveTool = std::variant<Segment<double>, Box<double>, ConvexPolytope<double>, Compound>;

/// An object, a motion and a tool.
struct LiveScene {
  scenes::Setting setting;
  LiveTool tool;
};

inline LiveScene live(scenes::Scene scene) {
  LiveTool tool = std::visit([](auto& shape) { return LiveTool(std::move(shape)); }, scene.tool);
  return {std::move(static_cast<scenes::Setting&>(scene)), std::move(tool)};
}
inline LiveScene live(scenes::CompoundScene scene) {
  Compound tool = Compound::hulls_of(scene.pieces);
  return {std::move(static_cast<scenes::Setting&>(scene)), std::move(tool)};
}

/// Calls `visit(piece)` for each convex piece of a tool.
template <class Visit>
void for_each_piece(const LiveTool& tool, const Visit& visit) {
  std::visit(
      [&]<class Tool>(const Tool& shape) {
        if constexpr (std::is_same_v<Tool, Compound>) {
          for (int i = 0; i < shape.piece_count(); ++i) visit(shape.piece(i));
        } else {
          visit(shape);
        }
      },
      tool);
}

}  // namespace feeler::demo
