// Everything a renderer needs: object, tools, solver and renderer. Includes only.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/core/status.hpp"
#include "feeler/core/version.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/qp/dual_active_set.hpp"
#include "feeler/render/haptic_renderer.hpp"
#include "feeler/render/settings.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/spatial/metric.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/twist.hpp"
#include "feeler/spatial/wrench.hpp"
#include "feeler/tool/box.hpp"
#include "feeler/tool/convex_polytope.hpp"
#include "feeler/tool/segment.hpp"
