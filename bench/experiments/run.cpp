// Picks the type of tool that a scene has.
#include "experiments/run.hpp"

#include <stdexcept>

#include "experiments/run_with_tool.hpp"

namespace feeler::experiments {

Run run(const scenes::Scene& scene, const Settings<double>& settings, Method method, double seconds, bool is_checked) {
  return std::visit(
      [&]<class Tool>(const Tool& tool) {
        if constexpr (std::is_same_v<Tool, ConvexPolytope<double>>) {
          if (method == Method::standard) return detail::run_method<ClosestFeatures>(scene, tool, settings, seconds, is_checked);
          if (method == Method::paper) return detail::run_method<CandidateContacts<>>(scene, tool, settings, seconds, is_checked);
          throw std::invalid_argument("A hull is rendered by the paper's method or the default one; choose one of these.");
        } else {
          return run_with_tool(scene, tool, settings, method, seconds, is_checked);
        }
      },
      scene.tool);
}

Run run(const scenes::CompoundScene& scene, const Settings<double>& settings, double seconds, bool is_checked) {
  const auto tool = CompoundTool<ConvexPolytope<double>>::hulls_of(scene.pieces);
  return detail::run_method<ClosestFeatures>(scene, tool, settings, seconds, is_checked);
}

}  // namespace feeler::experiments
