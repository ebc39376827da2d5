// Stages with another scalar or contact method than the library's defaults; each kind is compiled in a file
// of its own.
#pragma once

#include <memory>

#include "live/stage.hpp"

namespace feeler::demo {

/// With poses and meshes of `float`.
std::unique_ptr<Stage> make_float_stage(StageParts parts);

/// With the contact method of the paper, as written: nothing proves that its poses are free of collision.
/// @throws std::invalid_argument for a tool that is not convex
std::unique_ptr<Stage> make_paper_stage(StageParts parts);

/// A box with the features of any polytope, so that fewer renderers need compiling.
ConvexPolytope<double> polytope_of(const Box<double>& box);

}  // namespace feeler::demo
