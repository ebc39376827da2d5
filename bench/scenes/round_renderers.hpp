// The renderers of the round tools that tests and examples use, compiled in round_renderers.cpp alone.
#pragma once

#include "feeler/render/haptic_renderer.hpp"
#include "feeler/tool/point.hpp"
#include "feeler/tool/segment.hpp"
#include "feeler/tool/sphere_swept.hpp"

namespace feeler {

extern template class HapticRenderer<Sphere<double>>;
extern template class HapticRenderer<Capsule<double>>;

}  // namespace feeler
