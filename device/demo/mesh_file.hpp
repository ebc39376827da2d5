// Triangle meshes from STL, OBJ, PLY and OFF files.
#pragma once

#include <filesystem>

#include "feeler/core/scalar.hpp"

namespace feeler::demo {

/// A mesh as the library takes it.
struct Mesh {
  Points<double> vertices;  ///< in the units of the file, times the scale: [m] if the scale is right
  Triangles triangles;
};

/// Reads all meshes of a file as one, each where its node puts it; polygons are cut into triangles, corners
/// that coincide are joined.
///
/// @param scale  metres a unit of the file
/// @throws BadInput for a file that is missing, empty, unreadable, without triangles, or with a coordinate
/// that is not finite
Mesh load_mesh(const std::filesystem::path& file, double scale);

}  // namespace feeler::demo
