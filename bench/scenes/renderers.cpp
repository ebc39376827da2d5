#include "scenes/renderers.hpp"

namespace feeler {

template class HapticRenderer<Segment<double>>;
template class HapticRenderer<Box<double>>;
template class HapticRenderer<ConvexPolytope<double>>;
template class HapticRenderer<CompoundTool<ConvexPolytope<double>>>;

#ifndef FEELER_RENDERERS_OF_THE_DEMO_ALONE
template class HapticRenderer<Point<double>>;

template WrenchDerivative<double> wrench_derivative(const HapticRenderer<Segment<double>>&);
template WrenchDerivative<double> wrench_derivative(const HapticRenderer<Box<double>>&);
template WrenchDerivative<double> wrench_derivative(const HapticRenderer<ConvexPolytope<double>>&);
#endif

}  // namespace feeler
