// The renderers of the scenes' tools and their derivatives, compiled in renderers.cpp alone: a file with three of them takes a third of the time.
#pragma once

#include "feeler/render/haptic_renderer.hpp"
#include "feeler/render/wrench_derivative.hpp"
#include "feeler/tool/box.hpp"
#include "feeler/tool/compound_tool.hpp"
#include "feeler/tool/convex_polytope.hpp"
#include "feeler/tool/point.hpp"
#include "feeler/tool/segment.hpp"

namespace feeler {

extern template class HapticRenderer<Point<double>>;
extern template class HapticRenderer<Segment<double>>;
extern template class HapticRenderer<Box<double>>;
extern template class HapticRenderer<ConvexPolytope<double>>;
extern template class HapticRenderer<CompoundTool<ConvexPolytope<double>>>;

extern template WrenchDerivative<double> wrench_derivative(const HapticRenderer<Segment<double>>&);
extern template WrenchDerivative<double> wrench_derivative(const HapticRenderer<Box<double>>&);
extern template WrenchDerivative<double> wrench_derivative(const HapticRenderer<ConvexPolytope<double>>&);

}  // namespace feeler
