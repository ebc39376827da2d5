// A height function over a rectangle as a triangle mesh.
#pragma once

#include "feeler/core/scalar.hpp"

namespace feeler::scenes {

/// A rectangle of the plane cut into cells.
struct Grid {
  double x_begin, x_end;  ///< [m]
  double y_begin, y_end;  ///< [m]
  int x_cells, y_cells;
};

/// Fills `vertices` and `triangles` with z = height(x, y): two triangles a cell, counter-clockwise seen from
/// above.
template <class Height>
void mesh_height_field(const Grid& grid, const Height& height, Points<double>& vertices, Triangles& triangles) {
  const int columns = grid.x_cells + 1;
  const int rows = grid.y_cells + 1;
  vertices.resize(Eigen::Index(columns) * rows, 3);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double x = grid.x_begin + (grid.x_end - grid.x_begin) * i / grid.x_cells;
      const double y = grid.y_begin + (grid.y_end - grid.y_begin) * j / grid.y_cells;
      vertices.row(Eigen::Index(j) * columns + i) << x, y, height(x, y);
    }
  }
  triangles.resize(Eigen::Index(grid.x_cells) * grid.y_cells * 2, 3);
  Eigen::Index row = 0;
  for (int j = 0; j < grid.y_cells; ++j) {
    for (int i = 0; i < grid.x_cells; ++i) {
      const int corner = j * columns + i;
      triangles.row(row++) << corner, corner + 1, corner + columns + 1;
      triangles.row(row++) << corner, corner + columns + 1, corner + columns;
    }
  }
}

}  // namespace feeler::scenes
