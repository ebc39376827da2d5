// Polyhedra as OFF files, with every digit of a double.
#pragma once

#include <filesystem>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

/// Vertices [m] and, for each face, indices into them.
struct Polyhedron {
  Points<double> vertices;
  std::vector<std::vector<int>> faces;
};

/// The object of a scene: its triangles.
Polyhedron polyhedron_of(const Points<double>& vertices, const Triangles& triangles);

/// A tool in its own frame: its faces, or, where it has none, its edges as faces of two vertices.
Polyhedron polyhedron_of(const scenes::Tool& tool);

/// @throws std::runtime_error when the file cannot be written
void write_off(const std::filesystem::path& file, const Polyhedron& polyhedron);

}  // namespace feeler::demo
