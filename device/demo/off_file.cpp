// OFF files by hand: the format is three lines of rules.
#include "off_file.hpp"

#include "text_file.hpp"

namespace feeler::demo {

Polyhedron polyhedron_of(const Points<double>& vertices, const Triangles& triangles) {
  Polyhedron polyhedron{vertices, {}};
  polyhedron.faces.reserve(std::size_t(triangles.rows()));
  for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
    polyhedron.faces.push_back({triangles(i, 0), triangles(i, 1), triangles(i, 2)});
  }
  return polyhedron;
}

Polyhedron polyhedron_of(const scenes::Tool& tool) {
  return std::visit(
      [](const auto& shape) {
        Polyhedron polyhedron;
        polyhedron.vertices.resize(shape.vertex_count(), 3);
        for (int i = 0; i < shape.vertex_count(); ++i) {
          polyhedron.vertices.row(i) = Vector3<double>(shape.vertex(i)).transpose();
        }
        for (int i = 0; i < shape.face_count(); ++i) {
          const auto face = shape.face(i);
          polyhedron.faces.emplace_back(face.vertices.begin(), face.vertices.end());
        }
        if (polyhedron.faces.empty()) {
          for (int i = 0; i < shape.edge_count(); ++i) {
            polyhedron.faces.push_back({shape.edge(i).start, shape.edge(i).end});
          }
        }
        return polyhedron;
      },
      tool);
}

void write_off(const std::filesystem::path& file, const Polyhedron& polyhedron) {
  TextFile text(file);
  text.print("OFF\n%ld %zu 0\n", long(polyhedron.vertices.rows()), polyhedron.faces.size());
  for (Eigen::Index i = 0; i < polyhedron.vertices.rows(); ++i) {
    text.print("%.17g %.17g %.17g\n", polyhedron.vertices(i, 0), polyhedron.vertices(i, 1), polyhedron.vertices(i, 2));
  }
  for (const std::vector<int>& face : polyhedron.faces) {
    text.print("%zu", face.size());
    for (int vertex : face) text.print(" %d", vertex);
    text.print("\n");
  }
  text.close();
}

}  // namespace feeler::demo
