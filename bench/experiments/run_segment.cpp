// Runs with a segment.
#include "experiments/run_with_tool.hpp"

namespace feeler::experiments {
template Run run_with_tool(const scenes::Scene&, const Segment<double>&, const Settings<double>&, Method, double, bool);
}  // namespace feeler::experiments
