#include "scenes/round_renderers.hpp"

namespace feeler {

template class HapticRenderer<Sphere<double>>;
template class HapticRenderer<Capsule<double>>;

}  // namespace feeler
