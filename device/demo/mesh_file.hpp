// Triangle meshes from STL, OBJ, PLY and OFF files.
#pragma once

#include <filesystem>
#include <string>

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

/// The same of a file that somebody sent. It makes nobody open another file.
///
/// @param name  of the file; its ending says what it is
Mesh read_mesh(const std::string& bytes, const std::string& name);

}  // namespace feeler::demo
