// The renderer of a ball, compiled here alone.
#include "feeler/feeler.hpp"

namespace feeler {
template class HapticRenderer<Sphere<double>>;
}
