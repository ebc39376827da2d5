// The renderers of the comparison.
#include "rivals/make_feeler_tool.hpp"

#include "rivals/feeler_tool.hpp"

namespace feeler::rivals {

template <RigidTool Tool>
std::unique_ptr<CoupledTool> make_feeler_tool(const TriangleMesh<double>& object, const Tool& tool, const scenes::Setting& setting) {
  return std::make_unique<FeelerTool<Tool>>(object, tool, setting);
}

using Object = TriangleMesh<double>;
template std::unique_ptr<CoupledTool> make_feeler_tool(const Object&, const Segment<double>&, const scenes::Setting&);
template std::unique_ptr<CoupledTool> make_feeler_tool(const Object&, const Box<double>&, const scenes::Setting&);
template std::unique_ptr<CoupledTool> make_feeler_tool(const Object&, const ConvexPolytope<double>&, const scenes::Setting&);
template std::unique_ptr<CoupledTool> make_feeler_tool(const Object&, const CompoundTool<ConvexPolytope<double>>&, const scenes::Setting&);

}  // namespace feeler::rivals
